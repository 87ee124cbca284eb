#pragma once
// World coordinates along a cube's axes: what is measured along each, and its value anywhere in the cube.
//
// Whatever a header's formulas are, a value is kept at the nodes of a coarse grid over the cube and is
// multilinear between them: two nodes for what is linear, more for a projection of the sky.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/volume/box.h"

namespace shearwater::wcs {

// A position in the cube, in voxels.
using Place = std::array<double, 3>;

enum class Notation {
    plain,
    hours,    // of degrees: 20h34m52s
    degrees,  // +60°09'14"
};

struct Axis {
    static constexpr int max_nodes = 33;                // along each of the cube's axes
    static constexpr std::size_t max_values = 33 * 33;  // of all nodes
    static constexpr double max_size = 1e100;           // of a value

    std::string name;   // "right ascension"
    std::string label;  // for where there is little room: "RA"
    std::string unit;   // of plain values: "km/s", "deg"
    Notation notation = Notation::plain;
    bool circle = false;  // degrees that begin anew after 360
    // Node k of m along a cube's axis of n voxels lies at voxel k (n - 1) / (m - 1); of one node the value
    // does not depend on that axis.
    std::array<int, 3> nodes{1, 1, 1};
    std::vector<double> values;  // of the nodes, the first axis fastest; not a number where there is none

    // Whether there is anything but voxels.
    bool known() const { return !values.empty(); }
    bool operator==(const Axis&) const = default;
};
// By the cube's axes: what changes most along each.
using Axes = std::array<Axis, 3>;

// In a cube of n voxels; on a circle in [0, 360). Not a number outside of what the header's formulas reach,
// and about the poles of a circle.
double value_at(const Axis& axis, const volume::Index3& n, const Place& place);
// From `from` to `to`; on a circle the shorter way.
double difference(const Axis& axis, double from, double to);

// Whether values grow with voxels along the cube's axis, in the cube's middle.
bool rises(const Axis& axis, int along, const volume::Index3& n);

// An axis that counts its voxels from 0.
Axis voxel_axis(int along, const volume::Index3& n);
// The one along a cube's axis: the header's where it is known, else voxels.
Axis shown_axis(const Axes& axes, int along, const volume::Index3& n);

// Refuses what the above does not allow, in an axis along one of the cube's. One that is not known is fine.
base::Status validate(const Axis& axis, int along);

}  // namespace shearwater::wcs
