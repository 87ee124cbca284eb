#pragma once
// Where windows keep what outlives them and is no person's own file.

#include <filesystem>
#include <optional>

namespace shearwater::ui {

// $XDG_STATE_HOME/shearwater, else ~/.local/state/shearwater; nothing where nobody has a home.
std::optional<std::filesystem::path> state_folder();

}  // namespace shearwater::ui
