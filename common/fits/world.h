#pragma once
// The world coordinates of a cube's axes, from the header through wcslib.

#include <cstdint>
#include <string>
#include <vector>

#include "common/fits/axes.h"
#include "common/fits/header.h"
#include "common/wcs/axis.h"

namespace shearwater::fits {

// What is measured along the axes that were chosen, at the middle of each voxel (FITS pixel 1 is voxel 0).
// Keywords are judged here and handed to wcslib one by one: it is shown no text but types and units that are
// known, and no tables or distortions. Axes that the header says nothing of, or nothing usable, are left
// unknown; the latter with a note.
wcs::Axes read_world(const Header& header, const std::vector<std::int64_t>& lengths, const CubeAxes& axes,
                     std::vector<std::string>& notes);

}  // namespace shearwater::fits
