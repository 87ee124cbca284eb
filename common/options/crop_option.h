#pragma once
// The option that says which voxels of a cube are shown.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cli_fwd.h"
#include "common/view/factorisation.h"

namespace shearwater::options {

// --crop X0 X1 Y0 Y1 Z0 Z1
struct CropOption {
    std::vector<std::int64_t> ends;  // first and last voxel along each axis; empty: the whole cube

    void add_to(CLI::App& app, const std::string& group = "Options");

    std::vector<std::string> arguments() const;  // as it is given
    void take(const volume::Box& box);

    // Whether or not a cube has such voxels.
    std::optional<volume::Box> box() const;
    // Of that cube, checked.
    base::Result<std::optional<volume::Box>> box_of(const view::Lattice& lattice) const;
};

}  // namespace shearwater::options
