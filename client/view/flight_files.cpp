#include "client/view/flight_files.h"

#include "common/base/text_file.h"
#include "common/flight/path_toml.h"

namespace shearwater::ui {

void FlightFiles::save(const std::string& file, const flight::Path& path) {
    errands_.ask([file, path] {
        const auto written = base::write_text_file(file, flight::to_toml(path));
        return std::optional(written ? Outcome{"Saved to " + file, false, {}}
                                     : Outcome{written.error().message(), true, {}});
    });
}

void FlightFiles::open(const std::string& file) {
    errands_.ask([file] {
        auto path = flight::read_path(file);
        return std::optional(path ? Outcome{"Opened " + file, false, *std::move(path)}
                                  : Outcome{path.error().message(), true, {}});
    });
}

}  // namespace shearwater::ui
