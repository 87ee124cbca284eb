#include "renderer/shear/classification.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

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

// Whether a sample with some code of a range has opacity, or a segment between two.
bool any_opacity(const Classification& classification, const CodeRange& range) {
    return classification.segments ? classification.segments->any_opacity(range.min, range.max)
                                   : classification.table.any_opacity(range.min, range.max);
}

std::vector<Content> contents_of(const CodeVolume& codes, const Classification& classification,
                                 base::Workers& workers) {
    constexpr std::int64_t at_once = 1 << 13;
    const std::span<const CodeRange> ranges =
        classification.segments ? codes.reaches() : codes.micro_bricks().ranges();
    const auto count = static_cast<std::int64_t>(ranges.size());
    std::vector<Content> contents(ranges.size());
    workers.for_each((count + at_once - 1) / at_once, [&](std::int64_t part) {
        const auto end = static_cast<std::size_t>(std::min(count, (part + 1) * at_once));
        for (auto n = static_cast<std::size_t>(part * at_once); n < end; ++n) {
            contents[n].blanks = ranges[n].blanks;
            if (any_opacity(classification, ranges[n])) {
                // Octants are not told apart for segments, which reach too far.
                contents[n].opaque_octants =
                    classification.segments
                        ? std::uint8_t{0xff}
                        : opaque_of(codes.octants()[n], codes.bits(), classification.table);
            }
        }
    });
    return contents;
}

bool is_sparse(std::span<const Content> contents) {
    std::uint64_t opaque = 0;
    for (const Content& content : contents) {
        opaque += static_cast<std::uint64_t>(std::popcount(content.opaque_octants));
    }
    return SparseFaces::pay(opaque, 8 * contents.size());
}

}  // namespace

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, view::Classify how,
                        base::Workers& workers) {
    const int codes = volume.mapping().levels();
    Classification classification{
        .table = OpacityTable(tf, codes), .segments = {}, .micro_bricks = {}, .opaque = {}};
    if (how == view::Classify::pre_integrated) {
        classification.segments.emplace(tf, codes, classification.table);
    }
    for (int level = 0; level < volume.levels(); ++level) {
        std::vector<Content> contents = contents_of(volume.level(level), classification, workers);
        classification.is_sparse.push_back(!classification.segments && is_sparse(contents));
        classification.micro_bricks.push_back(std::move(contents));
    }
    for (const CodeRange& range : classification.segments ? volume.reaches() : volume.bricks().ranges()) {
        classification.opaque.push_back(static_cast<std::uint8_t>(any_opacity(classification, range)));
    }
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
