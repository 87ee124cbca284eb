#include "renderer/shear/classification.h"

#include <algorithm>

namespace shearwater::shear {

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, base::Workers& workers) {
    constexpr std::int64_t at_once = 1 << 15;
    const auto ranges = volume.micro_bricks().ranges();
    const auto count = static_cast<std::int64_t>(ranges.size());
    Classification classification{.table = OpacityTable(tf, volume.mapping().levels()),
                                  .micro_bricks = std::vector<Content>(ranges.size()),
                                  .opaque = std::vector<std::uint8_t>(volume.bricks().ranges().size())};
    const OpacityTable& table = classification.table;
    workers.for_each((count + at_once - 1) / at_once, [&](std::int64_t part) {
        const auto end = static_cast<std::size_t>(std::min(count, (part + 1) * at_once));
        for (auto n = static_cast<std::size_t>(part * at_once); n < end; ++n) {
            const CodeRange& range = ranges[n];
            classification.micro_bricks[n] = !table.any_opacity(range.min, range.max) ? Content::transparent
                                             : range.blanks                           ? Content::with_blanks
                                                                                      : Content::full;
        }
    });
    std::transform(volume.bricks().ranges().begin(), volume.bricks().ranges().end(),
                   classification.opaque.begin(), [&](const CodeRange& range) {
                       return static_cast<std::uint8_t>(table.any_opacity(range.min, range.max));
                   });
    return classification;
}

const Classification& Classifier::classify(const BrickVolume& volume, const view::TransferFunction& tf,
                                           base::Workers& workers) {
    if (!last_ || last_->tf != tf) {
        last_ = {tf, shear::classify(volume, tf, workers)};
    }
    return last_->result;
}

}  // namespace shearwater::shear
