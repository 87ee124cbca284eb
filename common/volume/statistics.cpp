#include "common/volume/statistics.h"

#include <algorithm>
#include <vector>

#include "common/base/check.h"

namespace shearwater::volume {

namespace {

// The planes a box owns, first and last both included.
Box owned_planes(const Box& box, const Index3& n) {
    Box owned = box;
    for (int axis = 0; axis < 3; ++axis) {
        if (box.hi[axis] != n[axis] - 1) {
            --owned.hi[axis];
        }
    }
    return owned;
}

// How many planes of each axis a slab takes so that it has at most `voxels`, one at the least: whole
// rows first, then whole planes, as they lie in a file.
Index3 slab_shape(const Index3& planes, std::int64_t voxels) {
    Index3 shape{};
    for (int axis = 0; axis < 3; ++axis) {
        shape[axis] = std::clamp<std::int64_t>(voxels, 1, planes[axis]);
        voxels /= planes[axis];
    }
    return shape;
}

// The slab with the given number, counted along axis 0 first.
Box slab_at(const Box& owned, const Index3& shape, std::int64_t number) {
    Box slab;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t slabs = (owned.planes(axis) + shape[axis] - 1) / shape[axis];
        slab.lo[axis] = owned.lo[axis] + number % slabs * shape[axis];
        slab.hi[axis] = std::min(slab.lo[axis] + shape[axis] - 1, owned.hi[axis]);
        number /= slabs;
    }
    return slab;
}

std::int64_t slab_count(const Box& owned, const Index3& shape) {
    std::int64_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        count *= (owned.planes(axis) + shape[axis] - 1) / shape[axis];
    }
    return count;
}

// A histogram is 8 MB, so that many threads share a few; counting is far faster than reading.
constexpr int most_histograms = 8;

void count_parallel(std::span<const float> values, std::vector<Histogram>& parts, base::Workers& workers) {
    const std::size_t share = values.size() / parts.size() + 1;
    workers.for_each(static_cast<std::int64_t>(parts.size()), [&](std::int64_t i) {
        const std::size_t first = std::min(static_cast<std::size_t>(i) * share, values.size());
        parts[static_cast<std::size_t>(i)].add(values.subspan(first, std::min(share, values.size() - first)));
    });
}

}  // namespace

base::Result<Histogram> count_values(VoxelSource& source, const Box& box, const Index3& n,
                                     base::Workers& workers, const Progress& progress,
                                     const std::stop_token& stop, std::size_t slab_bytes) {
    base::check(whole(n).contains(box), "the box lies in the cube");
    const Box owned = owned_planes(box, n);
    std::vector<Histogram> parts(static_cast<std::size_t>(std::min(workers.threads(), most_histograms)));
    if (owned.planes(0) <= 0 || owned.planes(1) <= 0 || owned.planes(2) <= 0) {
        return std::move(parts.front());
    }
    const Index3 shape =
        slab_shape(owned.plane_counts(), static_cast<std::int64_t>(slab_bytes / sizeof(float)));
    const std::int64_t slabs = slab_count(owned, shape);
    std::vector<float> values(static_cast<std::size_t>(shape[0] * shape[1] * shape[2]));
    for (std::int64_t i = 0; i < slabs; ++i) {
        if (stop.stop_requested()) {
            return base::error(base::Code::cancelled, "count the values of " + to_string(box), "stopped");
        }
        const Box slab = slab_at(owned, shape, i);
        const auto part = std::span(values).first(static_cast<std::size_t>(slab.voxels()));
        if (base::Status read = source.read(slab, part); !read) {
            return read.error();
        }
        count_parallel(part, parts, workers);
        if (progress) {
            progress(static_cast<double>(i + 1) / static_cast<double>(slabs));
        }
    }
    for (std::size_t i = 1; i < parts.size(); ++i) {
        parts.front().merge(parts[i]);
    }
    return std::move(parts.front());
}

}  // namespace shearwater::volume
