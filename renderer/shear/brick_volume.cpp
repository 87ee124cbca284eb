#include "renderer/shear/brick_volume.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <thread>

#include "common/base/check.h"
#include "common/volume/levels.h"
#include "common/volume/quantiser.h"
#include "renderer/shear/coarsen.h"
#include "renderer/shear/survey.h"

namespace shearwater::shear {

namespace {

using volume::Box;
using volume::Index3;

base::Status refuse(base::Code code, const Box& box, std::string detail) {
    return base::error(code, "load bricks of " + volume::to_string(box), std::move(detail));
}

base::Status check(const Box& box, const Index3& n) {
    if (!volume::whole(n).contains(box) || volume::voxel_count(box.plane_counts()) < 0) {
        return refuse(base::Code::invalid_argument, box, "the box is not inside the cube");
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (box.cells(axis) < 1) {
            return refuse(base::Code::invalid_argument, box, "the box is flat");
        }
    }
    return {};
}

// The planes lo to hi of a box cut into chunks of at most `room` voxels (one at the least): whole planes
// where they fit, else rows, else pieces of a row. Every voxel is in one of them.
std::vector<Box> chunks_of(const Box& box, std::int64_t room) {
    const std::int64_t row = box.planes(0);
    const std::int64_t length = std::clamp<std::int64_t>(room, 1, row);
    const std::int64_t rows = std::clamp<std::int64_t>(room / row, 1, box.planes(1));
    const std::int64_t planes = std::clamp<std::int64_t>(room / (row * box.planes(1)), 1, box.planes(2));
    std::vector<Box> chunks;
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; z += planes) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; y += rows) {
            for (std::int64_t x = box.lo[0]; x <= box.hi[0]; x += length) {
                chunks.push_back({{x, y, z},
                                  {std::min(x + length - 1, box.hi[0]), std::min(y + rows - 1, box.hi[1]),
                                   std::min(z + planes - 1, box.hi[2])}});
            }
        }
    }
    return chunks;
}

}  // namespace

base::Result<BrickVolume> BrickVolume::load(volume::VoxelSource& source, const Box& box, const Index3& n,
                                            const volume::Mapping& mapping, base::Workers& workers,
                                            const volume::Progress& progress, const std::stop_token& stop,
                                            std::size_t slab_bytes) {
    if (const auto sound = check(box, n); !sound) {
        return sound.error();
    }
    BrickVolume volume;
    volume.box_ = box;
    volume.n_ = n;
    volume.mapping_ = mapping;
    try {
        CodeVolume voxels(volume::nodes_to_make(box, n).front(), mapping.bits);
        const auto filled =
            mapping.bits == 8
                ? fill<std::uint8_t>(voxels, mapping, source, workers, progress, stop, slab_bytes)
                : fill<std::uint16_t>(voxels, mapping, source, workers, progress, stop, slab_bytes);
        if (!filled) {
            return filled.error();
        }
        if (!volume.build(std::move(voxels), workers, stop)) {
            return refuse(base::Code::cancelled, box, "stopped").error();
        }
        return volume;
    } catch (const std::bad_alloc&) {
        return refuse(base::Code::too_large, box, "there is not enough memory for it").error();
    }
}

namespace {

// Quantises a chunk's voxels to where they lie in a box's codes.
template <class Code, class Offset>
void quantise(const volume::Quantiser& quantiser, std::span<const float> values, const Box& chunk,
              std::span<Code> codes, const Offset& offset) {
    const auto length = static_cast<std::size_t>(chunk.planes(0));
    for (std::int64_t z = chunk.lo[2]; z <= chunk.hi[2]; ++z) {
        for (std::int64_t y = chunk.lo[1]; y <= chunk.hi[1]; ++y) {
            quantiser.codes(values.first(length), codes.subspan(offset({chunk.lo[0], y, z}), length));
            values = values.subspan(length);
        }
    }
}

// A chunk that stays in the processor's caches between reading and quantising.
constexpr std::size_t cached_bytes = std::size_t{1} << 20;

// Reads chunk after chunk and calls use(chunk, values) on each; by all workers at once where the source lets
// them. Told stop, or at the first error, begins no more.
template <class Use>
base::Status read_chunks(volume::VoxelSource& source, const Box& box, std::size_t slab_bytes,
                         base::Workers& workers, const volume::Progress& progress,
                         const std::stop_token& stop, const Use& use) {
    const auto threads = static_cast<std::size_t>(source.concurrent() ? workers.threads() : 1);
    const std::size_t bytes = threads > 1 ? std::min(slab_bytes / threads, cached_bytes) : slab_bytes;
    const auto chunks = chunks_of(box, static_cast<std::int64_t>(bytes / sizeof(float)));
    const auto caller = std::this_thread::get_id();
    std::atomic<std::size_t> next{0}, done{0};
    std::mutex mutex;
    base::Status outcome;
    const auto work = [&](std::int64_t) {
        std::vector<float> values(static_cast<std::size_t>(chunks.front().voxels()));
        for (std::size_t i = next++; i < chunks.size() && !stop.stop_requested(); i = next++) {
            const std::span<float> part(values.data(), static_cast<std::size_t>(chunks[i].voxels()));
            if (base::Status read = source.read(chunks[i], part); !read) {
                next = chunks.size();
                const std::lock_guard lock(mutex);
                outcome = std::move(read);
                return;
            }
            use(chunks[i], part);
            const std::size_t ready = ++done;
            if (progress && std::this_thread::get_id() == caller) {
                progress(static_cast<double>(ready) / static_cast<double>(chunks.size()));
            }
        }
    };
    if (threads > 1) {
        workers.for_each(static_cast<std::int64_t>(threads), work);
    } else {
        work(0);
    }
    if (outcome && done < chunks.size()) {
        return refuse(base::Code::cancelled, box, "stopped");
    }
    return outcome;
}

}  // namespace

template <class Code>
base::Status BrickVolume::fill(CodeVolume& voxels, const volume::Mapping& mapping,
                               volume::VoxelSource& source, base::Workers& workers,
                               const volume::Progress& progress, const std::stop_token& stop,
                               std::size_t slab_bytes) {
    const volume::Quantiser quantiser(mapping);
    const std::span<Code> codes = voxels.codes<Code>();
    const auto place = [&](const Index3& p) { return voxels.offset(p); };
    const bool alone = !source.concurrent();
    return read_chunks(source, voxels.box(), slab_bytes, workers, progress, stop,
                       [&](const Box& chunk, std::span<const float> values) {
                           if (!alone) {
                               quantise<Code>(quantiser, values, chunk, codes, place);
                               return;
                           }
                           // The reading thread hands out what it has read, plane by plane.
                           const auto plane = static_cast<std::size_t>(chunk.planes(0) * chunk.planes(1));
                           workers.for_each(chunk.planes(2), [&](std::int64_t z) {
                               Box slice = chunk;
                               slice.lo[2] = slice.hi[2] = chunk.lo[2] + z;
                               quantise<Code>(quantiser,
                                              values.subspan(static_cast<std::size_t>(z) * plane, plane),
                                              slice, codes, place);
                           });
                       });
}

bool BrickVolume::build(CodeVolume voxels, base::Workers& workers, const std::stop_token& stop) {
    const std::vector<Box> boxes = volume::nodes_to_make(box_, n_);
    levels_.push_back(std::move(voxels));
    for (std::size_t level = 0; level < boxes.size(); ++level) {
        const int number = static_cast<int>(level);
        if (level + 1 < boxes.size()) {
            levels_.emplace_back(boxes[level + 1], mapping_.bits);
            if (!coarsen(levels_[level], levels_[level + 1], number + 1, n_, workers, stop)) {
                return false;
            }
        }
        if (!levels_[level].crop(volume::nodes_kept(box_, number, n_), stop) ||
            !levels_[level].survey(volume::nodes_of(box_, number), workers, stop)) {
            return false;
        }
    }
    summarise(0);
    return true;
}

void BrickVolume::summarise(int level) {
    const CodeVolume& nodes = levels_[static_cast<std::size_t>(level)];
    bricks_ = CodeGrid(box_, edge);
    reaches_.resize(bricks_.ranges().size());
    for_cells_reached(nodes.micro_bricks(), level, bricks_, [&](std::size_t micro_brick, std::size_t brick) {
        bricks_.ranges()[brick].add(std::as_const(nodes).micro_bricks().ranges()[micro_brick]);
        reaches_[brick].add(nodes.reaches()[micro_brick]);
    });
}

BrickVolume BrickVolume::of_level(int level, CodeVolume nodes, const Box& box, const Index3& n,
                                  const volume::Mapping& mapping, base::Workers& workers) {
    base::check(nodes.box() == volume::nodes_kept(box, level, n) && nodes.bits() == mapping.bits,
                "a level has the nodes of its box");
    BrickVolume volume;
    volume.box_ = box;
    volume.n_ = n;
    volume.mapping_ = mapping;
    volume.levels_.resize(static_cast<std::size_t>(level));
    volume.levels_.push_back(std::move(nodes));
    volume.levels_.back().survey(volume::nodes_of(box, level), workers, {});
    volume.summarise(level);
    return volume;
}

std::size_t BrickVolume::bytes() const {
    std::size_t bytes = bricks_.ranges().size_bytes() + reaches().size_bytes();
    for (const CodeVolume& level : levels_) {
        bytes += level.bytes();
    }
    return bytes;
}

}  // namespace shearwater::shear
