#pragma once
// World values as text, as astronomers write them.

#include <string>

#include "common/wcs/axis.h"

namespace shearwater::wcs {

// With as many digits as tell values apart that differ by `resolution`, and the signs of angles, but without
// any other unit: "20h34m52.3s", "+60\u00b009'14\"", "359.5\u00b0", "1.4204". "-" where there is no value.
std::string number_text(const Axis& axis, double value, double resolution);
// With its unit: "42.5 km/s".
std::string value_text(const Axis& axis, double value, double resolution);
// What stands beside ticks: "right ascension", "velocity (km/s)"; in short "RA", "Vel (km/s)".
std::string title_text(const Axis& axis);
std::string short_title_text(const Axis& axis);

// "RA 20h34m52.3s  Dec +60\u00b009'14\"  V 42.5 km/s" at a place: of the axes that are known, a little finer
// than voxels; empty where none is.
std::string place_text(const Axes& axes, const volume::Index3& n, const Place& place);
// At a plane of voxels across one of the cube's axes, in the cube's middle; empty where the axis is not
// known.
std::string plane_text(const Axes& axes, int along, const volume::Index3& n, double plane);

}  // namespace shearwater::wcs
