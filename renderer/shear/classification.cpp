#include "renderer/shear/classification.h"

#include <algorithm>

namespace shearwater::shear {

namespace {

std::uint64_t opaque_micro_bricks(const Brick& brick, const MicroBricks& micro_bricks,
                                  const OpacityTable& table) {
    if (!table.any_opacity(brick.min, brick.max)) {
        return 0;
    }
    std::uint64_t mask = 0;
    for (std::size_t m = 0; m < MicroBricks::count; ++m) {
        mask |= std::uint64_t{table.any_opacity(micro_bricks.min[m], micro_bricks.max[m])} << m;
    }
    return mask;
}

}  // namespace

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, base::Workers& workers) {
    constexpr std::int64_t at_once = 256;
    const auto count = static_cast<std::int64_t>(volume.bricks().size());
    Classification classification{.table = OpacityTable(tf, volume.mapping().levels()),
                                  .opaque = std::vector<std::uint64_t>(volume.bricks().size())};
    workers.for_each((count + at_once - 1) / at_once, [&](std::int64_t part) {
        for (std::int64_t i = part * at_once; i < std::min(count, (part + 1) * at_once); ++i) {
            const auto n = static_cast<std::size_t>(i);
            classification.opaque[n] =
                opaque_micro_bricks(volume.bricks()[n], volume.micro_bricks()[n], classification.table);
        }
    });
    return classification;
}

}  // namespace shearwater::shear
