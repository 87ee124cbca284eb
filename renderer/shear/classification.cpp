#include "renderer/shear/classification.h"

#include <algorithm>
#include <span>

namespace shearwater::shear {

namespace {

// The octants that may have opacity.
std::uint8_t opaque_of(const Octants& octants, int bits, const OpacityTable& table) {
    const int low = bits - 8;  // bits of codes that the ranges leave out
    unsigned opaque = 0;
    for (std::size_t n = 0; n < octants.size(); ++n) {
        const auto min = static_cast<std::uint16_t>(octants[n].min << low);
        const auto max = static_cast<std::uint16_t>((octants[n].max + 1) * (1 << low) - 1);
        opaque |= octants[n].min <= octants[n].max && table.any_opacity(min, max) ? 1U << n : 0U;
    }
    return static_cast<std::uint8_t>(opaque);
}

std::vector<Content> contents_of(const CodeVolume& codes, const OpacityTable& table, base::Workers& workers) {
    const std::span<const CodeRange> ranges = codes.micro_bricks().ranges();
    constexpr std::int64_t at_once = 1 << 13;
    const auto count = static_cast<std::int64_t>(ranges.size());
    std::vector<Content> contents(ranges.size());
    workers.for_each((count + at_once - 1) / at_once, [&](std::int64_t part) {
        const auto end = static_cast<std::size_t>(std::min(count, (part + 1) * at_once));
        for (auto n = static_cast<std::size_t>(part * at_once); n < end; ++n) {
            const CodeRange& range = ranges[n];
            contents[n].blanks = range.blanks;
            if (table.any_opacity(range.min, range.max)) {
                contents[n].opaque_octants = opaque_of(codes.octants()[n], codes.bits(), table);
            }
        }
    });
    return contents;
}

}  // namespace

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, base::Workers& workers) {
    Classification classification{.table = OpacityTable(tf, volume.mapping().levels()),
                                  .micro_bricks = {},
                                  .opaque = std::vector<std::uint8_t>(volume.bricks().ranges().size())};
    const OpacityTable& table = classification.table;
    for (int level = 0; level < volume.levels(); ++level) {
        classification.micro_bricks.push_back(contents_of(volume.level(level), table, workers));
    }
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
