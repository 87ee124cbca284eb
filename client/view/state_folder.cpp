#include "client/view/state_folder.h"

#include <cstdlib>

namespace shearwater::ui {

namespace fs = std::filesystem;

std::optional<fs::path> state_folder() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && fs::path(state).is_absolute()) {
        return fs::path(state) / "shearwater";
    }
    const char* const home = std::getenv("HOME");
    return home != nullptr && fs::path(home).is_absolute()
               ? std::optional(fs::path(home) / ".local/state/shearwater")
               : std::nullopt;
}

}  // namespace shearwater::ui
