#include "common/volume/box.h"

#include <limits>

namespace shearwater::volume {

bool Box::contains(const Box& inner) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (inner.lo[axis] < lo[axis] || inner.hi[axis] > hi[axis]) {
            return false;
        }
    }
    return true;
}

Box whole(const Index3& n) {
    return {{0, 0, 0}, {n[0] - 1, n[1] - 1, n[2] - 1}};
}

Box owned_planes(const Box& box, const Index3& n) {
    Box owned = box;
    for (int axis = 0; axis < 3; ++axis) {
        if (box.hi[axis] != n[axis] - 1) {
            --owned.hi[axis];
        }
    }
    return owned;
}

std::string to_string(const Box& box) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis) {
        text += axis == 0 ? "[" : " x [";
        text += std::to_string(box.lo[axis]) + "," + std::to_string(box.hi[axis]) + ")";
    }
    return text;
}

std::int64_t voxel_count(const Index3& n) {
    if (n[0] < 0 || n[1] < 0 || n[2] < 0) {
        return -1;
    }
    // In rising order a zero comes first, so that a product of zero never looks too large.
    std::int64_t count = (n[0] == 0 || n[1] == 0 || n[2] == 0) ? 0 : 1;
    for (const std::int64_t planes : n) {
        if (count != 0 && planes > std::numeric_limits<std::int64_t>::max() / count) {
            return -1;
        }
        count *= planes;
    }
    return count;
}

}  // namespace shearwater::volume
