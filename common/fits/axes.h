#pragma once
// Which axes of an image are the cube's.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/fits/hdu.h"
#include "common/volume/box.h"

namespace shearwater::fits {

struct CubeAxes {
    std::array<int, 3> axis{};  // FITS axis numbers, from 1, rising
    volume::Index3 n{};
    int plane_axis = 0;  // a fourth axis longer than 1; 0 where there is none
    std::int64_t planes = 1;
    std::int64_t plane = 0;
    std::string note;  // empty where nothing was assumed
};

// Axes of length 1 are dropped. Of four longer ones the polarisation axis (CTYPE STOKES or POL...) is
// cut at one plane, or else the time axis, or else the last.
base::Result<CubeAxes> choose_axes(const Hdu& hdu, const std::optional<std::int64_t>& plane,
                                   const std::string& operation);

}  // namespace shearwater::fits
