#include "common/volume/statistics.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "common/base/check.h"

namespace shearwater::volume {

namespace {

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
// A slab that stays in the processor's caches between reading and counting.
constexpr std::size_t cached_bytes = std::size_t{1} << 20;

base::Error cancelled(const Box& box) {
    return base::error(base::Code::cancelled, "count the values of " + to_string(box), "stopped");
}

// A box cut into slabs, in the order of a file.
struct Slabs {
    Slabs(const Box& whole, std::size_t bytes)
        : box(whole),
          shape(slab_shape(whole.plane_counts(), static_cast<std::int64_t>(bytes / sizeof(float)))),
          count(slab_count(whole, shape)),
          voxels(static_cast<std::size_t>(shape[0] * shape[1] * shape[2])) {}

    Box at(std::int64_t number) const { return slab_at(box, shape, number); }

    Box box;
    Index3 shape;
    std::int64_t count;
    std::size_t voxels;  // of the largest
};

void count_parallel(std::span<const float> values, std::vector<Histogram>& parts, base::Workers& workers) {
    const std::size_t share = values.size() / parts.size() + 1;
    workers.for_each(static_cast<std::int64_t>(parts.size()), [&](std::int64_t i) {
        const std::size_t first = std::min(static_cast<std::size_t>(i) * share, values.size());
        parts[static_cast<std::size_t>(i)].add(values.subspan(first, std::min(share, values.size() - first)));
    });
}

// One slab after the other is read by this thread and counted by all.
base::Status count_in_turn(VoxelSource& source, const Slabs& slabs, std::vector<Histogram>& parts,
                           base::Workers& workers, const Progress& progress, const std::stop_token& stop) {
    std::vector<float> values(slabs.voxels);
    for (std::int64_t i = 0; i < slabs.count; ++i) {
        if (stop.stop_requested()) {
            return cancelled(slabs.box);
        }
        const Box slab = slabs.at(i);
        const auto part = std::span(values).first(static_cast<std::size_t>(slab.voxels()));
        if (base::Status read = source.read(slab, part); !read) {
            return read;
        }
        count_parallel(part, parts, workers);
        if (progress) {
            progress(static_cast<double>(i + 1) / static_cast<double>(slabs.count));
        }
    }
    return {};
}

// Each thread reads slabs of its own and counts them into a histogram of its own.
base::Status count_at_once(VoxelSource& source, const Slabs& slabs, std::vector<Histogram>& parts,
                           base::Workers& workers, const Progress& progress, const std::stop_token& stop) {
    const auto caller = std::this_thread::get_id();
    std::atomic<std::int64_t> next{0};
    std::atomic<std::int64_t> done{0};
    double told = 0;
    std::mutex mutex;
    base::Status outcome;
    workers.for_each(static_cast<std::int64_t>(parts.size()), [&](std::int64_t number) {
        std::vector<float> values(slabs.voxels);
        for (std::int64_t i = next++; i < slabs.count && !stop.stop_requested(); i = next++) {
            const Box slab = slabs.at(i);
            const auto part = std::span(values).first(static_cast<std::size_t>(slab.voxels()));
            if (base::Status read = source.read(slab, part); !read) {
                next = slabs.count;
                const std::lock_guard lock(mutex);
                outcome = std::move(read);
                return;
            }
            parts[static_cast<std::size_t>(number)].add(part);
            const std::int64_t ready = ++done;
            if (progress && std::this_thread::get_id() == caller) {
                told = static_cast<double>(ready) / static_cast<double>(slabs.count);
                progress(told);
            }
        }
    });
    if (outcome && done < slabs.count) {
        return cancelled(slabs.box);
    }
    if (outcome && progress && told < 1) {
        progress(1);
    }
    return outcome;
}

}  // namespace

base::Result<Histogram> count_values(VoxelSource& source, const Box& box, const Index3& n,
                                     base::Workers& workers, const Progress& progress,
                                     const std::stop_token& stop, std::size_t slab_bytes) {
    base::check(whole(n).contains(box), "the box lies in the cube");
    const Box owned = owned_planes(box, n);
    if (owned.planes(0) <= 0 || owned.planes(1) <= 0 || owned.planes(2) <= 0) {
        return Histogram();
    }
    const int threads = std::min(workers.threads(), most_histograms);
    std::vector<Histogram> parts(static_cast<std::size_t>(threads));
    const base::Status counted =
        source.concurrent()
            ? count_at_once(source, Slabs(owned, std::min(slab_bytes / parts.size(), cached_bytes)), parts,
                            workers, progress, stop)
            : count_in_turn(source, Slabs(owned, slab_bytes), parts, workers, progress, stop);
    if (!counted) {
        return counted.error();
    }
    for (std::size_t i = 1; i < parts.size(); ++i) {
        parts.front().merge(parts[i]);
    }
    return std::move(parts.front());
}

}  // namespace shearwater::volume
