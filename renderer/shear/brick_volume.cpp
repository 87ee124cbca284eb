#include "renderer/shear/brick_volume.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <thread>

#include "common/volume/quantiser.h"
#include "renderer/shear/kernel.h"
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

// A little more than so many codes, if need be: rows or planes that lie a large power of two apart would
// compete for the same few lines of the caches.
std::int64_t padded(std::int64_t codes, std::int64_t code_bytes) {
    constexpr std::int64_t vector = 16, line = 64, far = 512;
    const std::int64_t bytes = (codes * code_bytes + vector - 1) / vector * vector;
    return (bytes % far == 0 ? bytes + line : bytes) / code_bytes;
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

void CodeRange::add(const CodeRange& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
    blanks = blanks || other.blanks;
}

CodeGrid::CodeGrid(const Box& box, std::int64_t edge) : edge_(edge) {
    std::int64_t count = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        first_[a] = box.lo[a] / edge;
        counts_[a] = (box.hi[a] - 1) / edge - first_[a] + 1;
        count *= counts_[a];
    }
    ranges_.resize(static_cast<std::size_t>(count));
}

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
    const std::int64_t code_bytes = mapping.bits / 8;
    const std::int64_t row = padded(box.planes(0), code_bytes);
    const std::int64_t plane = padded(row * box.planes(1), code_bytes);
    volume.strides_ = {1, row, plane};
    try {
        const auto codes = static_cast<std::size_t>(plane * box.planes(2)) + voxel_padding;
        volume.bricks_ = CodeGrid(box, edge);
        volume.micro_bricks_ = CodeGrid(box, micro_edge);
        base::Status filled;
        if (mapping.bits == 8) {
            volume.codes8_ = base::HugeArray<std::uint8_t>(codes);
            filled = volume.fill(volume.codes8_, source, workers, progress, stop, slab_bytes);
        } else {
            volume.codes16_ = base::HugeArray<std::uint16_t>(codes);
            filled = volume.fill(volume.codes16_, source, workers, progress, stop, slab_bytes);
        }
        return filled ? base::Result<BrickVolume>(std::move(volume)) : filled.error();
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
base::Status BrickVolume::fill(base::HugeArray<Code>& codes, volume::VoxelSource& source,
                               base::Workers& workers, const volume::Progress& progress,
                               const std::stop_token& stop, std::size_t slab_bytes) {
    const volume::Quantiser quantiser(mapping_);
    const auto place = [&](const Index3& p) { return offset(p); };
    const bool alone = !source.concurrent();
    const base::Status read = read_chunks(
        source, box_, slab_bytes, workers, progress, stop,
        [&](const Box& chunk, std::span<const float> values) {
            if (!alone) {
                quantise<Code>(quantiser, values, chunk, codes.span(), place);
                return;
            }
            // The reading thread hands out what it has read, plane by plane.
            const auto plane = static_cast<std::size_t>(chunk.planes(0) * chunk.planes(1));
            workers.for_each(chunk.planes(2), [&](std::int64_t z) {
                Box slice = chunk;
                slice.lo[2] = slice.hi[2] = chunk.lo[2] + z;
                quantise<Code>(quantiser, values.subspan(static_cast<std::size_t>(z) * plane, plane), slice,
                               codes.span(), place);
            });
        });
    if (!read) {
        return read;
    }
    const CodesOfBox<Code> all{codes.span().data(), box_, stride(1), stride(2)};
    if (!survey(all, micro_bricks_, workers, stop)) {
        return refuse(base::Code::cancelled, box_, "stopped");
    }
    summarise(micro_bricks_, bricks_);
    return {};
}

std::size_t BrickVolume::bytes() const {
    return codes8_.span().size_bytes() + codes16_.span().size_bytes() + bricks_.ranges().size_bytes() +
           micro_bricks_.ranges().size_bytes();
}

std::size_t BrickVolume::offset(const Index3& p) const {
    std::size_t offset = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        offset += static_cast<std::size_t>((p[a] - box_.lo[a]) * strides_[a]);
    }
    return offset;
}

}  // namespace shearwater::shear
