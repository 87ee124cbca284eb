#include "renderer/shear/survey.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace shearwater::shear {

namespace {

// Planes of a box along an axis, counted from its first: both ends.
struct Planes {
    std::int64_t first, last;

    bool empty() const { return first > last; }
    bool contain(std::int64_t plane) const { return first <= plane && plane <= last; }
};
// Those of a box's own that `edge` cells from `start` on lie between.
Planes planes_of(const volume::Box& box, const volume::Box& own, int axis, std::int64_t start,
                 std::int64_t edge) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t lo = std::max(start, own.lo[a]), hi = std::min(start + edge, own.hi[a]);
    // A single plane is no cell's.
    return lo < hi ? Planes{lo - box.lo[a], hi - box.lo[a]} : Planes{0, -1};
}
// With one more on either side.
Planes about(const Planes& planes, const volume::Box& box, int axis) {
    return {std::max<std::int64_t>(planes.first - 1, 0), std::min(planes.last + 1, box.planes(axis) - 1)};
}

// Of codes that lie across one another, column by column. They are sought less one for the least: so the
// blank one is the greatest of all, and counts for nothing.
template <class Code>
class Extremes {
  public:
    explicit Extremes(std::size_t columns) : least_less_one_(columns), least_(columns), greatest_(columns) {}

    void clear() {
        std::fill(least_less_one_.begin(), least_less_one_.end(), most);
        std::fill(least_.begin(), least_.end(), most);
        std::fill(greatest_.begin(), greatest_.end(), Code{0});
    }
    void add(const Code* row) {
        Code* const least_less_one = least_less_one_.data();
        Code* const least = least_.data();
        Code* const greatest = greatest_.data();
        for (std::size_t x = 0, n = least_.size(); x < n; ++x) {
            least_less_one[x] = std::min(least_less_one[x], static_cast<Code>(row[x] - 1));
            least[x] = std::min(least[x], row[x]);
            greatest[x] = std::max(greatest[x], row[x]);
        }
    }
    void add(const Extremes& other) {
        const auto lesser = [](Code a, Code b) { return std::min(a, b); };
        std::ranges::transform(least_less_one_, other.least_less_one_, least_less_one_.begin(), lesser);
        std::ranges::transform(least_, other.least_, least_.begin(), lesser);
        std::ranges::transform(greatest_, other.greatest_, greatest_.begin(),
                               [](Code a, Code b) { return std::max(a, b); });
    }
    // Each column then stands for itself and the octant_edge next ones, where there are as many.
    void widen() {
        const auto choose = [](std::vector<Code>& codes, std::size_t step, const auto& better) {
            for (std::size_t x = 0; x + step < codes.size(); ++x) {
                codes[x] = better(codes[x], codes[x + step]);
            }
        };
        static_assert(CodeVolume::octant_edge == 1 + 2 + 1);
        for (const std::size_t step : {1, 2, 1}) {
            choose(least_less_one_, step, [](Code a, Code b) { return std::min(a, b); });
            choose(least_, step, [](Code a, Code b) { return std::min(a, b); });
            choose(greatest_, step, [](Code a, Code b) { return std::max(a, b); });
        }
    }
    CodeRange over(const Planes& columns) const {
        Code low_less_one = most, low = most, high = 0;
        for (auto x = static_cast<std::size_t>(columns.first); x <= static_cast<std::size_t>(columns.last);
             ++x) {
            low_less_one = std::min(low_less_one, least_less_one_[x]);
            low = std::min(low, least_[x]);
            high = std::max(high, greatest_[x]);
        }
        CodeRange range{.blanks = low == 0};
        if (high > 0) {
            range.min = static_cast<std::uint16_t>(low_less_one + 1);
            range.max = high;
        }
        return range;
    }

  private:
    static constexpr Code most = std::numeric_limits<Code>::max();

    std::vector<Code> least_less_one_, least_, greatest_;
};

OctantRange leading_bytes(const CodeRange& range, int bits) {
    if (range.empty()) {
        return {};
    }
    return {static_cast<std::uint8_t>(range.min >> (bits - 8)),
            static_cast<std::uint8_t>(range.max >> (bits - 8))};
}

template <class Code>
class Surveyor {
  public:
    Surveyor(const CodesOfBox<Code>& codes, const volume::Box& own, const Survey& found)
        : codes_(codes),
          own_(own),
          found_(found),
          grid_(found.micro_bricks),
          within_(static_cast<std::size_t>(codes.box.planes(0))),
          widened_(within_),
          all_(within_) {}

    // One row of micro-bricks along axis 0.
    void row(std::int64_t my, std::int64_t mz) {
        all_.clear();
        for (int octant = 0; octant < 8; octant += 2) {
            row_of_octants(my, mz, octant);
        }
        const auto planes = [&](int axis, std::int64_t at) {
            return planes_of(codes_.box, own_, axis, (grid_.first(axis) + at) * grid_.edge(), grid_.edge());
        };
        const Planes y = planes(1, my), about_y = about(y, codes_.box, 1);
        const Planes z = planes(2, mz), about_z = about(z, codes_.box, 2);
        for (std::int64_t plane = about_z.first; plane <= about_z.last; ++plane) {
            for (std::int64_t row = about_y.first; row <= about_y.last; ++row) {
                if (!z.contain(plane) || !y.contain(row)) {
                    all_.add(codes_.first + plane * codes_.plane_stride + row * codes_.row_stride);
                }
            }
        }
        for (std::int64_t mx = 0; mx < grid_.counts()[0]; ++mx) {
            found_.reaches[grid_.index({mx, my, mz})] = all_.over(about(planes(0, mx), codes_.box, 0));
        }
    }

  private:
    // Of octants and the next ones along axis 0.
    void row_of_octants(std::int64_t my, std::int64_t mz, int octant) {
        constexpr std::int64_t edge = CodeVolume::octant_edge;
        const auto planes = [&](int axis, std::int64_t at, int half) {
            return planes_of(codes_.box, own_, axis, (grid_.first(axis) + at) * grid_.edge() + half * edge,
                             edge);
        };
        const Planes y = planes(1, my, octant / 2 % 2), z = planes(2, mz, octant / 4);
        if (y.empty() || z.empty()) {
            return;
        }
        within_.clear();
        for (std::int64_t plane = z.first; plane <= z.last; ++plane) {
            for (std::int64_t row = y.first; row <= y.last; ++row) {
                within_.add(codes_.first + plane * codes_.plane_stride + row * codes_.row_stride);
            }
        }
        all_.add(within_);
        widened_ = within_;
        widened_.widen();
        for (std::int64_t mx = 0; mx < grid_.counts()[0]; ++mx) {
            for (int half = 0; half < 2; ++half) {
                const Planes x = planes(0, mx, half);
                if (!x.empty()) {
                    const CodeRange range =
                        x.last - x.first == edge ? widened_.over({x.first, x.first}) : within_.over(x);
                    const std::size_t micro_brick = grid_.index({mx, my, mz});
                    grid_.ranges()[micro_brick].add(range);
                    found_.octants[micro_brick][static_cast<std::size_t>(octant + half)] =
                        leading_bytes(range, 8 * static_cast<int>(sizeof(Code)));
                }
            }
        }
    }

    const CodesOfBox<Code>& codes_;
    const volume::Box& own_;
    const Survey& found_;
    CodeGrid& grid_;
    Extremes<Code> within_, widened_, all_;
};

}  // namespace

template <class Code>
bool survey(const CodesOfBox<Code>& codes, const volume::Box& own, const Survey& found,
            base::Workers& workers, const std::stop_token& stop) {
    return workers.for_each(
        found.micro_bricks.counts()[2],
        [&](std::int64_t mz) {
            Surveyor<Code> surveyor(codes, own, found);
            for (std::int64_t my = 0; my < found.micro_bricks.counts()[1]; ++my) {
                surveyor.row(my, mz);
            }
        },
        stop);
}

template bool survey(const CodesOfBox<std::uint8_t>&, const volume::Box&, const Survey&, base::Workers&,
                     const std::stop_token&);
template bool survey(const CodesOfBox<std::uint16_t>&, const volume::Box&, const Survey&, base::Workers&,
                     const std::stop_token&);

}  // namespace shearwater::shear
