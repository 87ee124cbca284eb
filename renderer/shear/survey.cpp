#include "renderer/shear/survey.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace shearwater::shear {

namespace {

// The planes of the box, counted from its first, that a row of the grid has along an axis: both ends.
struct Planes {
    std::int64_t first, last;
};
Planes planes_of(const CodeGrid& grid, const volume::Box& box, int axis, std::int64_t at) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t start = (grid.first(axis) + at) * grid.edge();
    return {std::max(start, box.lo[a]) - box.lo[a], std::min(start + grid.edge(), box.hi[a]) - box.lo[a]};
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
        for (std::size_t x = 0; x < least.size(); ++x) {
            least_less_one[x] = std::min(least_less_one[x], static_cast<Code>(row[x] - 1));
            least[x] = std::min(least[x], row[x]);
            greatest[x] = std::max(greatest[x], row[x]);
        }
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
void survey_row(const CodesOfBox<Code>& codes, CodeGrid& grid, std::int64_t my, std::int64_t mz,
                Extremes<Code>& extremes) {
    const Planes y = planes_of(grid, codes.box, 1, my);
    const Planes z = planes_of(grid, codes.box, 2, mz);
    extremes.clear();
    for (std::int64_t plane = z.first; plane <= z.last; ++plane) {
        for (std::int64_t row = y.first; row <= y.last; ++row) {
            extremes.add(codes.first + plane * codes.plane_stride + row * codes.row_stride);
        }
    }
    for (std::int64_t mx = 0; mx < grid.counts()[0]; ++mx) {
        grid.ranges()[grid.index({mx, my, mz})] = extremes.over(planes_of(grid, codes.box, 0, mx));
    }
}

}  // namespace

template <class Code>
bool survey(const CodesOfBox<Code>& codes, CodeGrid& micro_bricks, base::Workers& workers,
            const std::stop_token& stop) {
    return workers.for_each(
        micro_bricks.counts()[2],
        [&](std::int64_t mz) {
            Extremes<Code> extremes(static_cast<std::size_t>(codes.box.planes(0)));
            for (std::int64_t my = 0; my < micro_bricks.counts()[1]; ++my) {
                survey_row(codes, micro_bricks, my, mz, extremes);
            }
        },
        stop);
}

template bool survey(const CodesOfBox<std::uint8_t>&, CodeGrid&, base::Workers&, const std::stop_token&);
template bool survey(const CodesOfBox<std::uint16_t>&, CodeGrid&, base::Workers&, const std::stop_token&);

void summarise(const CodeGrid& nodes, int level, CodeGrid& voxels) {
    const std::int64_t edge = nodes.edge() << level;
    volume::Index3 at;
    for (at[2] = 0; at[2] < nodes.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < nodes.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < nodes.counts()[0]; ++at[0]) {
                const CodeRange& range = nodes.ranges()[nodes.index(at)];
                volume::Index3 first, last;
                for (int axis = 0; axis < 3; ++axis) {
                    const auto a = static_cast<std::size_t>(axis);
                    const std::int64_t start = (nodes.first(axis) + at[a]) * edge;
                    // The outermost nodes may lie outside the box.
                    const auto cell_of = [&](std::int64_t voxel) {
                        return std::clamp<std::int64_t>(voxel / voxels.edge() - voxels.first(axis), 0,
                                                        voxels.counts()[a] - 1);
                    };
                    first[a] = cell_of(start);
                    last[a] = cell_of(start + edge - 1);
                }
                voxels.add(first, last, range);
            }
        }
    }
}

}  // namespace shearwater::shear
