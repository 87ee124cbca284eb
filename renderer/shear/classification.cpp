#include "renderer/shear/classification.h"

#include <algorithm>
#include <span>

namespace shearwater::shear {

namespace {

// Table: one of those that know what has opacity.
template <class Table>
std::vector<Content> contents_of(std::span<const CodeRange> ranges, const Table& table,
                                 base::Workers& workers) {
    constexpr std::int64_t at_once = 1 << 15;
    const auto count = static_cast<std::int64_t>(ranges.size());
    std::vector<Content> contents(ranges.size());
    workers.for_each((count + at_once - 1) / at_once, [&](std::int64_t part) {
        const auto end = static_cast<std::size_t>(std::min(count, (part + 1) * at_once));
        for (auto n = static_cast<std::size_t>(part * at_once); n < end; ++n) {
            const CodeRange& range = ranges[n];
            contents[n] = !table.any_opacity(range.min, range.max) ? Content::transparent
                          : range.blanks                           ? Content::with_blanks
                                                                   : Content::full;
        }
    });
    return contents;
}

// Whether each brick has a micro-brick that is not transparent.
std::vector<std::uint8_t> any_within(const CodeGrid& bricks, const CodeGrid& micro_bricks,
                                     std::span<const Content> contents) {
    const std::int64_t ratio = bricks.edge() / micro_bricks.edge();
    std::vector<std::uint8_t> any(bricks.ranges().size());
    volume::Index3 at;
    for (at[2] = 0; at[2] < micro_bricks.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < micro_bricks.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < micro_bricks.counts()[0]; ++at[0]) {
                if (contents[micro_bricks.index(at)] != Content::transparent) {
                    volume::Index3 brick;
                    for (int axis = 0; axis < 3; ++axis) {
                        const auto a = static_cast<std::size_t>(axis);
                        brick[a] = (micro_bricks.first(axis) + at[a]) / ratio - bricks.first(axis);
                    }
                    any[bricks.index(brick)] = 1;
                }
            }
        }
    }
    return any;
}

void classify_samples(const BrickVolume& volume, base::Workers& workers, Classification& classification) {
    const OpacityTable& table = classification.table;
    for (int level = 0; level < volume.levels(); ++level) {
        classification.micro_bricks.push_back(
            contents_of(volume.level(level).micro_bricks().ranges(), table, workers));
    }
    for (const CodeRange& range : volume.bricks().ranges()) {
        classification.opaque.push_back(static_cast<std::uint8_t>(table.any_opacity(range.min, range.max)));
    }
}

void classify_segments(const BrickVolume& volume, base::Workers& workers, Classification& classification) {
    for (int level = 0; level < volume.levels(); ++level) {
        classification.micro_bricks.push_back(
            contents_of(volume.level(level).reaches(), *classification.segments, workers));
    }
    classification.opaque =
        any_within(volume.bricks(), volume.level(0).micro_bricks(), classification.micro_bricks.front());
}

}  // namespace

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, view::Classify how,
                        base::Workers& workers) {
    const int codes = volume.mapping().levels();
    Classification classification{
        .table = OpacityTable(tf, codes), .segments = {}, .micro_bricks = {}, .opaque = {}};
    if (how == view::Classify::pre_integrated) {
        classification.segments.emplace(tf, codes, classification.table);
        classify_segments(volume, workers, classification);
    } else {
        classify_samples(volume, workers, classification);
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
