#include "renderer/shear/micro_bricks.h"

#include <algorithm>
#include <limits>

namespace shearwater::shear {

namespace {

constexpr int per_axis = 4;

// Least and greatest code of the cells [8 m, 8 m + 8] of a row for each m; of two rows, the lesser and the
// greater. Codes are held less one, so that the blank one is the greatest of all and counts for nothing
// where the least is sought, and as they are where the greatest is.
template <class Code>
struct Extremes {
    std::array<Code, per_axis> least_less_one, greatest;

    Extremes() {
        least_less_one.fill(std::numeric_limits<Code>::max());
        greatest.fill(0);
    }
    void add(const Extremes& other) {
        for (std::size_t m = 0; m < per_axis; ++m) {
            least_less_one[m] = std::min(least_less_one[m], other.least_less_one[m]);
            greatest[m] = std::max(greatest[m], other.greatest[m]);
        }
    }
};

// A row of at most 33 codes, its last repeated up to that.
template <class Code>
Extremes<Code> extremes_of_row(const Code* row, std::int64_t planes) {
    constexpr std::int64_t edge = MicroBricks::edge;
    Extremes<Code> extremes;
    for (std::int64_t m = 0; m < per_axis && m * edge < std::max<std::int64_t>(planes - 1, 1); ++m) {
        const auto end = std::min(planes, m * edge + edge + 1);
        Code least = std::numeric_limits<Code>::max();
        Code greatest = 0;
        for (std::int64_t x = m * edge; x < end; ++x) {
            least = std::min(least, static_cast<Code>(row[x] - 1));
            greatest = std::max(greatest, row[x]);
        }
        extremes.least_less_one[static_cast<std::size_t>(m)] = least;
        extremes.greatest[static_cast<std::size_t>(m)] = greatest;
    }
    return extremes;
}

}  // namespace

template <class Code>
void survey_codes(std::span<const Code> store, Brick& brick, MicroBricks& micro_bricks) {
    constexpr std::int64_t edge = MicroBricks::edge;
    const volume::Box& box = brick.box;
    const auto row_length = box.planes(0);
    std::array<Extremes<Code>, static_cast<std::size_t>(per_axis) * per_axis> all;
    const Code* row = &store[brick.first];
    bool blanks = false;
    // The micro-bricks along an axis that a plane belongs to: one, or the two that share it.
    const auto first_with = [](std::int64_t plane) { return std::max<std::int64_t>((plane - 1) / edge, 0); };
    const auto last_with = [](std::int64_t plane, std::int64_t cells) {
        return std::min(plane, cells - 1) / edge;
    };
    for (std::int64_t z = 0; z < box.planes(2); ++z) {
        for (std::int64_t y = 0; y < box.planes(1); ++y, row += row_length) {
            const Extremes<Code> of_row = extremes_of_row(row, row_length);
            blanks = blanks || std::find(row, row + row_length, Code{0}) != row + row_length;
            for (std::int64_t mz = first_with(z); mz <= last_with(z, box.cells(2)); ++mz) {
                for (std::int64_t my = first_with(y); my <= last_with(y, box.cells(1)); ++my) {
                    all[static_cast<std::size_t>(mz * per_axis + my)].add(of_row);
                }
            }
        }
    }
    brick.min = std::numeric_limits<std::uint16_t>::max();
    brick.max = 0;
    brick.has_blanks = blanks;
    for (std::size_t m = 0; m < MicroBricks::count; ++m) {
        const Extremes<Code>& extremes = all[m / per_axis];
        const Code greatest = extremes.greatest[m % per_axis];
        const bool none = greatest == 0;
        micro_bricks.min[m] = none ? std::numeric_limits<std::uint16_t>::max()
                                   : static_cast<std::uint16_t>(extremes.least_less_one[m % per_axis] + 1);
        micro_bricks.max[m] = greatest;
        brick.min = std::min(brick.min, micro_bricks.min[m]);
        brick.max = std::max(brick.max, micro_bricks.max[m]);
    }
}

template void survey_codes(std::span<const std::uint8_t>, Brick&, MicroBricks&);
template void survey_codes(std::span<const std::uint16_t>, Brick&, MicroBricks&);

}  // namespace shearwater::shear
