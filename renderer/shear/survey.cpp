#include "renderer/shear/survey.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace shearwater::shear {

namespace {

// Planes of a box along an axis, counted from its first: both ends.
struct Planes {
    std::int64_t first, last;

    bool contain(std::int64_t plane) const { return first <= plane && plane <= last; }
};
// Those that a row of the grid over `own` has.
Planes planes_of(const CodeGrid& grid, const volume::Box& box, const volume::Box& own, int axis,
                 std::int64_t at) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t start = (grid.first(axis) + at) * grid.edge();
    return {std::max(start, own.lo[a]) - box.lo[a], std::min(start + grid.edge(), own.hi[a]) - box.lo[a]};
}
// With one more on either side.
Planes about(const Planes& planes, const volume::Box& box, int axis) {
    return {std::max<std::int64_t>(planes.first - 1, 0), std::min(planes.last + 1, box.planes(axis) - 1)};
}

// Codes are sought less one for the least: so the blank one is the greatest of all, and counts for nothing.
template <class Code>
struct Extremes {
    std::vector<Code> least_less_one, least, greatest;

    explicit Extremes(std::size_t columns) : least_less_one(columns), least(columns), greatest(columns) {}
    void clear() {
        std::fill(least_less_one.begin(), least_less_one.end(), std::numeric_limits<Code>::max());
        std::fill(least.begin(), least.end(), std::numeric_limits<Code>::max());
        std::fill(greatest.begin(), greatest.end(), Code{0});
    }
    void add(const Code* row) {
        Code* const low_less_one = least_less_one.data();
        Code* const low = least.data();
        Code* const high = greatest.data();
        for (std::size_t x = 0, n = least.size(); x < n; ++x) {
            low_less_one[x] = std::min(low_less_one[x], static_cast<Code>(row[x] - 1));
            low[x] = std::min(low[x], row[x]);
            high[x] = std::max(high[x], row[x]);
        }
    }
    void add(const Extremes& other) {
        const auto least_of = [](Code a, Code b) { return std::min(a, b); };
        std::ranges::transform(least_less_one, other.least_less_one, least_less_one.begin(), least_of);
        std::ranges::transform(least, other.least, least.begin(), least_of);
        std::ranges::transform(greatest, other.greatest, greatest.begin(),
                               [](Code a, Code b) { return std::max(a, b); });
    }
    CodeRange over(const Planes& columns) const {
        Code low_less_one = std::numeric_limits<Code>::max();
        Code low = low_less_one, high = 0;
        for (auto x = static_cast<std::size_t>(columns.first); x <= static_cast<std::size_t>(columns.last);
             ++x) {
            low_less_one = std::min(low_less_one, least_less_one[x]);
            low = std::min(low, least[x]);
            high = std::max(high, greatest[x]);
        }
        CodeRange range{.blanks = low == 0};
        if (high > 0) {
            range.min = static_cast<std::uint16_t>(low_less_one + 1);
            range.max = high;
        }
        return range;
    }
};

// One row of micro-bricks along axis 0.
template <class Code>
void survey_row(const CodesOfBox<Code>& codes, const volume::Box& own, CodeGrid& grid,
                std::span<CodeRange> reaches, std::int64_t my, std::int64_t mz, Extremes<Code>& within,
                Extremes<Code>& all) {
    const Planes y = planes_of(grid, codes.box, own, 1, my), about_y = about(y, codes.box, 1);
    const Planes z = planes_of(grid, codes.box, own, 2, mz), about_z = about(z, codes.box, 2);
    within.clear();
    all.clear();
    for (std::int64_t plane = about_z.first; plane <= about_z.last; ++plane) {
        for (std::int64_t row = about_y.first; row <= about_y.last; ++row) {
            Extremes<Code>& extremes = z.contain(plane) && y.contain(row) ? within : all;
            extremes.add(codes.first + plane * codes.plane_stride + row * codes.row_stride);
        }
    }
    all.add(within);
    for (std::int64_t mx = 0; mx < grid.counts()[0]; ++mx) {
        const Planes x = planes_of(grid, codes.box, own, 0, mx);
        const std::size_t brick = grid.index({mx, my, mz});
        grid.ranges()[brick] = within.over(x);
        reaches[brick] = all.over(about(x, codes.box, 0));
    }
}

}  // namespace

template <class Code>
bool survey(const CodesOfBox<Code>& codes, const volume::Box& own, CodeGrid& micro_bricks,
            std::span<CodeRange> reaches, base::Workers& workers, const std::stop_token& stop) {
    return workers.for_each(
        micro_bricks.counts()[2],
        [&](std::int64_t mz) {
            Extremes<Code> within(static_cast<std::size_t>(codes.box.planes(0)));
            Extremes<Code> all(within);
            for (std::int64_t my = 0; my < micro_bricks.counts()[1]; ++my) {
                survey_row(codes, own, micro_bricks, reaches, my, mz, within, all);
            }
        },
        stop);
}

template bool survey(const CodesOfBox<std::uint8_t>&, const volume::Box&, CodeGrid&, std::span<CodeRange>,
                     base::Workers&, const std::stop_token&);
template bool survey(const CodesOfBox<std::uint16_t>&, const volume::Box&, CodeGrid&, std::span<CodeRange>,
                     base::Workers&, const std::stop_token&);

void summarise(const CodeGrid& fine, CodeGrid& coarse) {
    const std::int64_t ratio = coarse.edge() / fine.edge();
    volume::Index3 at;
    for (at[2] = 0; at[2] < fine.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < fine.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < fine.counts()[0]; ++at[0]) {
                volume::Index3 to;
                for (int axis = 0; axis < 3; ++axis) {
                    const auto a = static_cast<std::size_t>(axis);
                    to[a] = (fine.first(axis) + at[a]) / ratio - coarse.first(axis);
                }
                coarse.ranges()[coarse.index(to)].add(fine.ranges()[fine.index(at)]);
            }
        }
    }
}

}  // namespace shearwater::shear
