#include "renderer/shear/brick_volume.h"

#include <algorithm>
#include <limits>
#include <new>
#include <type_traits>

#include "common/volume/quantiser.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/micro_bricks.h"

namespace shearwater::shear {

namespace {

using volume::Box;
using volume::Index3;

// Bricks lie on a grid global to the cube; these are those of one axis that a box touches.
std::int64_t first_brick(const Box& box, int axis) {
    return box.lo[axis] / BrickVolume::edge;
}
std::int64_t brick_count(const Box& box, int axis) {
    return (box.hi[axis] - 1) / BrickVolume::edge - first_brick(box, axis) + 1;
}

std::vector<Brick> lay_bricks(const Box& box, const Index3& grid) {
    std::vector<Brick> bricks;
    std::size_t first = 0;
    Index3 at;
    for (at[2] = 0; at[2] < grid[2]; ++at[2]) {
        for (at[1] = 0; at[1] < grid[1]; ++at[1]) {
            for (at[0] = 0; at[0] < grid[0]; ++at[0]) {
                Brick brick{.first = first, .min = std::numeric_limits<std::uint16_t>::max(), .max = 0};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::int64_t start =
                        (first_brick(box, static_cast<int>(axis)) + at[axis]) * BrickVolume::edge;
                    brick.box.lo[axis] = std::max(box.lo[axis], start);
                    brick.box.hi[axis] = std::min(box.hi[axis], start + BrickVolume::edge);
                }
                first += static_cast<std::size_t>(brick.box.voxels());
                bricks.push_back(brick);
            }
        }
    }
    return bricks;
}

// The voxels that two boxes both store; false when there are none.
bool common_planes(const Box& a, const Box& b, Box& both) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        both.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
        both.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
    }
    return both.lo[0] <= both.hi[0] && both.lo[1] <= both.hi[1] && both.lo[2] <= both.hi[2];
}

std::size_t offset_in(const Box& box, std::int64_t x, std::int64_t y, std::int64_t z) {
    return static_cast<std::size_t>(((z - box.lo[2]) * box.planes(1) + (y - box.lo[1])) * box.planes(0) +
                                    (x - box.lo[0]));
}

// Quantises a chunk's voxels into the part of a brick that lies in it.
template <class Code>
void fill(const Brick& brick, std::span<Code> store, const Box& chunk, std::span<const float> values,
          const volume::Quantiser& quantiser) {
    Box part;
    if (!common_planes(brick.box, chunk, part)) {
        return;
    }
    const auto length = static_cast<std::size_t>(part.planes(0));
    for (std::int64_t z = part.lo[2]; z <= part.hi[2]; ++z) {
        for (std::int64_t y = part.lo[1]; y <= part.hi[1]; ++y) {
            const auto from = values.subspan(offset_in(chunk, part.lo[0], y, z), length);
            const auto to = store.subspan(brick.first + offset_in(brick.box, part.lo[0], y, z), length);
            quantiser.codes(from, to);
        }
    }
}

// The planes lo to hi of a box cut into chunks of at most `room` voxels (one row at the least): whole
// planes where they fit, else rows, else pieces of a row. Every voxel is in one of them.
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
    volume.grid_ = {brick_count(box, 0), brick_count(box, 1), brick_count(box, 2)};
    try {
        volume.bricks_ = lay_bricks(box, volume.grid_);
        const Brick& last = volume.bricks_.back();
        const std::size_t codes = last.first + static_cast<std::size_t>(last.box.voxels()) + voxel_padding;
        mapping.bits == 8 ? volume.codes8_.resize(codes) : volume.codes16_.resize(codes);
        volume.micro_bricks_.resize(volume.bricks_.size());
        const auto filled = volume.fill_from(source, workers, progress, stop, slab_bytes);
        return filled ? base::Result<BrickVolume>(std::move(volume)) : filled.error();
    } catch (const std::bad_alloc&) {
        return refuse(base::Code::too_large, box, "there is not enough memory for it").error();
    }
}

base::Status BrickVolume::fill_from(volume::VoxelSource& source, base::Workers& workers,
                                    const volume::Progress& progress, const std::stop_token& stop,
                                    std::size_t slab_bytes) {
    const volume::Quantiser quantiser(mapping_);
    const auto chunks = chunks_of(box_, static_cast<std::int64_t>(slab_bytes / sizeof(float)));
    std::vector<float> values(static_cast<std::size_t>(chunks.front().voxels()));
    std::vector<Brick*> touched;
    for (std::size_t done = 0; done < chunks.size(); ++done) {
        if (stop.stop_requested()) {
            return refuse(base::Code::cancelled, box_, "stopped");
        }
        const Box& chunk = chunks[done];
        const std::span<float> part(values.data(), static_cast<std::size_t>(chunk.voxels()));
        if (auto read = source.read(chunk, part); !read) {
            return read;
        }
        touched.clear();
        for (Brick& brick : bricks_) {
            Box both;
            if (common_planes(brick.box, chunk, both)) {
                touched.push_back(&brick);
            }
        }
        workers.for_each(static_cast<std::int64_t>(touched.size()), [&](std::int64_t i) {
            Brick& brick = *touched[static_cast<std::size_t>(i)];
            if (mapping_.bits == 8) {
                fill<std::uint8_t>(brick, codes8_, chunk, part, quantiser);
            } else {
                fill<std::uint16_t>(brick, codes16_, chunk, part, quantiser);
            }
        });
        if (progress) {
            progress(static_cast<double>(done + 1) / static_cast<double>(chunks.size()));
        }
    }
    workers.for_each(static_cast<std::int64_t>(bricks_.size()), [&](std::int64_t i) {
        const auto n = static_cast<std::size_t>(i);
        mapping_.bits == 8 ? survey_codes<std::uint8_t>(codes8_, bricks_[n], micro_bricks_[n])
                           : survey_codes<std::uint16_t>(codes16_, bricks_[n], micro_bricks_[n]);
    });
    return {};
}

std::size_t BrickVolume::bytes() const {
    return bricks_.capacity() * sizeof(Brick) + micro_bricks_.capacity() * sizeof(MicroBricks) +
           codes8_.capacity() + codes16_.capacity() * sizeof(std::uint16_t);
}

const Brick& BrickVolume::brick(std::int64_t bx, std::int64_t by, std::int64_t bz) const {
    return bricks_[static_cast<std::size_t>((bz * grid_[1] + by) * grid_[0] + bx)];
}

}  // namespace shearwater::shear
