#include "renderer/shear/sketch.h"

#include <algorithm>
#include <mutex>
#include <span>

#include "common/base/check.h"
#include "common/volume/levels.h"
#include "common/volume/quantiser.h"
#include "renderer/shear/plane_reader.h"

namespace shearwater::shear {

using volume::Box;
using volume::Index3;

Sketch::Sketch(const Box& box, const Index3& n, int level)
    : box_(box),
      nodes_(volume::nodes_kept(box, level, n)),
      n_(n),
      level_(level),
      values_(static_cast<std::size_t>(nodes_.voxels())) {}

base::Result<Sketch> Sketch::read(volume::VoxelSource& source, const Box& box, const Index3& n, int level,
                                  base::Workers& workers, const std::stop_token& stop) {
    base::check(source.gives_rows() && volume::whole(n).contains(box), "rows of the cube can be read alone");
    constexpr std::int64_t most_nodes = 1 << 25;
    const std::string operation = "sketch " + volume::to_string(box);
    if (volume::nodes_kept(box, level, n).voxels() > most_nodes) {
        return base::error(base::Code::too_large, operation, "its level has too many nodes");
    }
    Sketch sketch(box, n, level);
    const Box& nodes = sketch.nodes_;
    const auto voxel = [&](std::int64_t node, std::size_t axis) {
        return std::min(node << level, n[axis] - 1);
    };
    const auto length = static_cast<std::size_t>(nodes.planes(0));
    std::mutex mutex;
    base::Status outcome;
    std::stop_source failed;
    const auto read_row = [&](std::int64_t row) {
        if (failed.stop_requested()) {
            return;
        }
        const std::int64_t y = voxel(nodes.lo[1] + row % nodes.planes(1), 1);
        const std::int64_t z = voxel(nodes.lo[2] + row / nodes.planes(1), 2);
        const Box voxels{{voxel(nodes.lo[0], 0), y, z}, {voxel(nodes.hi[0], 0), y, z}};
        std::vector<float> values(static_cast<std::size_t>(voxels.planes(0)));
        if (base::Status read = source.read(voxels, values); !read) {
            failed.request_stop();
            const std::lock_guard lock(mutex);
            outcome = std::move(read);
            return;
        }
        float* const to = &sketch.values_[static_cast<std::size_t>(row) * length];
        for (std::size_t i = 0; i < length; ++i) {
            to[i] = values[std::min(i << level, values.size() - 1)];
        }
    };
    base::Workers alone(1);
    base::Workers& readers = source.concurrent() ? workers : alone;
    if (!readers.for_each(nodes.planes(1) * nodes.planes(2), read_row, stop)) {
        return base::error(base::Code::cancelled, operation, "stopped");
    }
    if (!outcome) {
        return outcome.error();
    }
    return sketch;
}

volume::Histogram Sketch::histogram() const {
    // The nodes of an axis that the box owns.
    const auto first = [&](std::size_t a) {
        return (box_.lo[a] + (std::int64_t{1} << level_) - 1) >> level_;
    };
    const auto last = [&](std::size_t a) {
        const std::int64_t end = box_.hi[a] == n_[a] - 1 ? n_[a] : box_.hi[a];
        return (end - 1) >> level_;
    };
    volume::Histogram histogram;
    const auto length = static_cast<std::size_t>(std::max<std::int64_t>(last(0) - first(0) + 1, 0));
    for (std::int64_t z = first(2); z <= last(2); ++z) {
        for (std::int64_t y = first(1); y <= last(1); ++y) {
            const std::int64_t row = (z - nodes_.lo[2]) * nodes_.planes(1) + y - nodes_.lo[1];
            const std::int64_t at = row * nodes_.planes(0) + first(0) - nodes_.lo[0];
            histogram.add(std::span(values_).subspan(static_cast<std::size_t>(at), length));
        }
    }
    return histogram;
}

BrickVolume Sketch::volume(const volume::Mapping& mapping, base::Workers& workers) const {
    CodeVolume nodes(nodes_, mapping.bits);
    quantise(volume::Quantiser(mapping), values_, nodes_, nodes);
    return BrickVolume::of_level(level_, std::move(nodes), box_, n_, mapping, workers);
}

}  // namespace shearwater::shear
