#include "renderer/shear/brick_volume.h"

#include <algorithm>
#include <new>
#include <utility>

#include "common/base/check.h"
#include "common/volume/levels.h"
#include "renderer/shear/level_builder.h"
#include "renderer/shear/plane_reader.h"
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
        PlaneReader reader(source, mapping, workers, slab_bytes);
        const Box all = volume::nodes_to_make(box, n).front();
        LevelBuilder builder(box, n, mapping.bits, reader.planes_at_once(all));
        while (const auto planes = builder.next()) {
            const auto share = [&](double of_these) {
                const auto count = static_cast<double>(planes->planes(2));
                progress((static_cast<double>(planes->lo[2] - all.lo[2]) + count * of_these) /
                         static_cast<double>(all.planes(2)));
            };
            const auto read =
                reader.read(*planes, builder.window(), progress ? volume::Progress(share) : nullptr, stop);
            if (!read) {
                return read.error();
            }
            if (!builder.rise(workers, stop)) {
                return refuse(base::Code::cancelled, box, "stopped").error();
            }
        }
        volume.levels_ = builder.take_levels();
        volume.halo_ = builder.take_halo();
        if (!volume.survey(workers, stop)) {
            return refuse(base::Code::cancelled, box, "stopped").error();
        }
        return volume;
    } catch (const std::bad_alloc&) {
        return refuse(base::Code::too_large, box, "there is not enough memory for it").error();
    }
}

base::Status BrickVolume::keep_copies(int copies, base::Workers& workers, const std::stop_token& stop) {
    base::check(copies == 1 || copies == 2, "a volume has one copy of its codes, or two");
    if (copies == 1) {
        return {};
    }
    try {
        for (CodeVolume& level : levels_) {
            if (!level.keep_turned(workers, stop)) {
                return refuse(base::Code::cancelled, box_, "stopped");
            }
        }
        return {};
    } catch (const std::bad_alloc&) {
        return refuse(base::Code::too_large, box_, "there is not enough memory for a second copy of it");
    }
}

bool BrickVolume::survey(base::Workers& workers, const std::stop_token& stop) {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        if (!levels_[level].survey(volume::nodes_of(box_, static_cast<int>(level)), workers, stop)) {
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
    std::size_t bytes = bricks_.ranges().size_bytes() + reaches().size_bytes() + halo_.bytes();
    for (const CodeVolume& level : levels_) {
        bytes += level.bytes();
    }
    return bytes;
}

}  // namespace shearwater::shear
