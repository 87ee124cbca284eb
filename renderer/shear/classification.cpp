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

// Of micro-bricks with some ranges: opaque(n) are the octants of the n-th that may have opacity.
template <class Opaque>
std::vector<Content> contents_of(std::span<const CodeRange> ranges, base::Workers& workers,
                                 const Opaque& opaque) {
    constexpr std::int64_t at_once = 1 << 13;
    const auto count = static_cast<std::int64_t>(ranges.size());
    std::vector<Content> contents(ranges.size());
    workers.for_each((count + at_once - 1) / at_once, [&](std::int64_t part) {
        const auto end = static_cast<std::size_t>(std::min(count, (part + 1) * at_once));
        for (auto n = static_cast<std::size_t>(part * at_once); n < end; ++n) {
            contents[n] = {.opaque_octants = opaque(n), .blanks = ranges[n].blanks};
        }
    });
    return contents;
}

std::vector<Content> samples_of(const CodeVolume& codes, const OpacityTable& table, base::Workers& workers) {
    const std::span<const CodeRange> ranges = codes.micro_bricks().ranges();
    return contents_of(ranges, workers, [&](std::size_t n) {
        return table.any_opacity(ranges[n].min, ranges[n].max)
                   ? opaque_of(codes.octants()[n], codes.bits(), table)
                   : std::uint8_t{0};
    });
}

// Octants are not told apart: a segment reaches too far.
std::vector<Content> segments_of(const CodeVolume& codes, const SegmentTable& table, base::Workers& workers) {
    const std::span<const CodeRange> reaches = codes.reaches();
    return contents_of(reaches, workers, [&](std::size_t n) {
        return static_cast<std::uint8_t>(table.any_opacity(reaches[n].min, reaches[n].max) ? 0xff : 0);
    });
}

}  // namespace

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, view::Classify how,
                        base::Workers& workers) {
    const int codes = volume.mapping().levels();
    Classification classification{.table = OpacityTable(tf, codes),
                                  .segments = {},
                                  .micro_bricks = {},
                                  .opaque = std::vector<std::uint8_t>(volume.bricks().ranges().size())};
    if (how == view::Classify::pre_integrated) {
        classification.segments.emplace(tf, codes, classification.table);
    }
    for (int level = 0; level < volume.levels(); ++level) {
        const CodeVolume& of_level = volume.level(level);
        classification.micro_bricks.push_back(classification.segments
                                                  ? segments_of(of_level, *classification.segments, workers)
                                                  : samples_of(of_level, classification.table, workers));
    }
    const auto any_opacity = [&](const CodeRange& range) {
        return static_cast<std::uint8_t>(classification.segments
                                             ? classification.segments->any_opacity(range.min, range.max)
                                             : classification.table.any_opacity(range.min, range.max));
    };
    const std::span<const CodeRange> bricks =
        classification.segments ? volume.reaches() : volume.bricks().ranges();
    std::transform(bricks.begin(), bricks.end(), classification.opaque.begin(), any_opacity);
    return classification;
}

const Classification& Classifier::classify(const BrickVolume& volume, const view::TransferFunction& tf,
                                           view::Classify how, base::Workers& workers) {
    if (!last_ || last_->how != how || last_->tf != tf) {
        last_ = {tf, how, shear::classify(volume, tf, how, workers)};
    }
    return last_->result;
}

}  // namespace shearwater::shear
