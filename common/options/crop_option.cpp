#include "common/options/crop_option.h"

#include <CLI/CLI.hpp>

namespace shearwater::options {

void CropOption::add_to(CLI::App& app, const std::string& group) {
    app.add_option("--crop", ends,
                   "show these voxels only: the first and the last along x, y and z, from 0 on")
        ->expected(6)
        ->type_name("X0 X1 Y0 Y1 Z0 Z1")
        ->group(group);
}

std::vector<std::string> CropOption::arguments() const {
    std::vector<std::string> words;
    if (!ends.empty()) {
        words.emplace_back("--crop");
    }
    for (const std::int64_t voxel : ends) {
        words.push_back(std::to_string(voxel));
    }
    return words;
}

void CropOption::take(const volume::Box& box) {
    ends.clear();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ends.insert(ends.end(), {box.lo[axis], box.hi[axis]});
    }
}

std::optional<volume::Box> CropOption::box() const {
    if (ends.size() != 6) {
        return std::nullopt;
    }
    return volume::Box{{ends[0], ends[2], ends[4]}, {ends[1], ends[3], ends[5]}};
}

base::Result<std::optional<volume::Box>> CropOption::box_of(const view::Lattice& lattice) const {
    const std::optional<volume::Box> given = box();
    if (given) {
        if (const auto valid = view::validate_crop(*given, lattice.n); !valid) {
            return valid.error();
        }
    }
    return given;
}

}  // namespace shearwater::options
