#include "renderer/shear/survey.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace shearwater::shear {

namespace {

// Planes of a box along an axis, counted from its first: both ends.
struct Planes {
    std::int64_t first, last;
};
// Those that `edge` cells from `start` on lie between; none has first > last.
Planes planes_of(const volume::Box& box, int axis, std::int64_t start, std::int64_t edge) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t lo = std::max(start, box.lo[a]), hi = std::min(start + edge, box.hi[a]);
    // A single plane is no cell's.
    return lo < hi ? Planes{lo - box.lo[a], hi - box.lo[a]} : Planes{0, -1};
}

// Of codes that lie across one another, column by column, counted from where an octant begins. They are
// sought less one for the least: so the blank one is the greatest of all, and counts for nothing.
template <class Code>
class Extremes {
  public:
    // For rows of codes from column `before` on.
    Extremes(std::int64_t before, std::int64_t codes)
        : before_(static_cast<std::size_t>(before)),
          codes_(static_cast<std::size_t>(codes)),
          least_less_one_(before_ + codes_ + beyond),
          least_(least_less_one_.size()),
          greatest_(least_less_one_.size()) {}

    void clear() {
        std::fill(least_less_one_.begin(), least_less_one_.end(), most);
        std::fill(least_.begin(), least_.end(), most);
        std::fill(greatest_.begin(), greatest_.end(), Code{0});
    }
    void add(const Code* row) {
        Code* const least_less_one = &least_less_one_[before_];
        Code* const least = &least_[before_];
        Code* const greatest = &greatest_[before_];
        for (std::size_t x = 0; x < codes_; ++x) {
            least_less_one[x] = std::min(least_less_one[x], static_cast<Code>(row[x] - 1));
            least[x] = std::min(least[x], row[x]);
            greatest[x] = std::max(greatest[x], row[x]);
        }
    }
    // From now on each column stands for itself and the octant_edge next ones.
    void widen() {
        const auto choose = [this](std::vector<Code>& codes, std::size_t step, const auto& better) {
            for (std::size_t x = 0; x < before_ + codes_; ++x) {
                codes[x] = better(codes[x], codes[x + step]);
            }
        };
        for (const std::size_t step : {1, 2, 1}) {
            choose(least_less_one_, step, [](Code a, Code b) { return std::min(a, b); });
            choose(least_, step, [](Code a, Code b) { return std::min(a, b); });
            choose(greatest_, step, [](Code a, Code b) { return std::max(a, b); });
        }
    }
    CodeRange at(std::int64_t column) const {
        const auto x = static_cast<std::size_t>(column);
        CodeRange range{.blanks = least_[x] == 0};
        if (greatest_[x] > 0) {
            range.min = static_cast<std::uint16_t>(least_less_one_[x] + 1);
            range.max = greatest_[x];
        }
        return range;
    }

  private:
    static constexpr Code most = std::numeric_limits<Code>::max();
    static constexpr std::size_t beyond = CodeVolume::octant_edge;

    std::size_t before_, codes_;
    std::vector<Code> least_less_one_, least_, greatest_;
};

OctantRange leading_bytes(const CodeRange& range, int bits) {
    if (range.empty()) {
        return {};
    }
    return {static_cast<std::uint8_t>(range.min >> (bits - 8)),
            static_cast<std::uint8_t>(range.max >> (bits - 8))};
}

// One row of micro-bricks along axis 0, octant by octant.
template <class Code>
void survey_row(const CodesOfBox<Code>& codes, CodeGrid& grid, std::span<Octants> octants, std::int64_t my,
                std::int64_t mz, Extremes<Code>& extremes) {
    constexpr std::int64_t edge = CodeVolume::octant_edge;
    const auto start = [&](int axis, std::int64_t at, int half) {
        return (grid.first(axis) + at) * grid.edge() + half * edge;
    };
    for (int octant = 0; octant < 8; octant += 2) {
        const Planes y = planes_of(codes.box, 1, start(1, my, octant / 2 % 2), edge);
        const Planes z = planes_of(codes.box, 2, start(2, mz, octant / 4), edge);
        if (y.first > y.last || z.first > z.last) {
            continue;
        }
        extremes.clear();
        for (std::int64_t plane = z.first; plane <= z.last; ++plane) {
            for (std::int64_t row = y.first; row <= y.last; ++row) {
                extremes.add(codes.first + plane * codes.plane_stride + row * codes.row_stride);
            }
        }
        extremes.widen();
        for (std::int64_t mx = 0; mx < grid.counts()[0]; ++mx) {
            const std::size_t micro_brick = grid.index({mx, my, mz});
            for (int half = 0; half < 2; ++half) {
                const std::int64_t first = start(0, mx, half);
                const Planes x = planes_of(codes.box, 0, first, edge);
                if (x.first <= x.last) {
                    const CodeRange range = extremes.at(first - codes.box.lo[0] / edge * edge);
                    grid.ranges()[micro_brick].add(range);
                    octants[micro_brick][static_cast<std::size_t>(octant + half)] =
                        leading_bytes(range, 8 * static_cast<int>(sizeof(Code)));
                }
            }
        }
    }
}

}  // namespace

template <class Code>
bool survey(const CodesOfBox<Code>& codes, CodeGrid& micro_bricks, std::span<Octants> octants,
            base::Workers& workers, const std::stop_token& stop) {
    return workers.for_each(
        micro_bricks.counts()[2],
        [&](std::int64_t mz) {
            Extremes<Code> extremes(codes.box.lo[0] % CodeVolume::octant_edge, codes.box.planes(0));
            for (std::int64_t my = 0; my < micro_bricks.counts()[1]; ++my) {
                survey_row(codes, micro_bricks, octants, my, mz, extremes);
            }
        },
        stop);
}

template bool survey(const CodesOfBox<std::uint8_t>&, CodeGrid&, std::span<Octants>, base::Workers&,
                     const std::stop_token&);
template bool survey(const CodesOfBox<std::uint16_t>&, CodeGrid&, std::span<Octants>, base::Workers&,
                     const std::stop_token&);

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
