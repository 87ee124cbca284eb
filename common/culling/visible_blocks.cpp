#include "common/culling/visible_blocks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

namespace shearwater::culling {

using view::Face;
using view::Factorisation;
using volume::Index3;

namespace {

// So many beams along a face's longer side.
constexpr int most_beams = 112;
// Where samples are told from one another is rounded by less than this, in voxels.
constexpr double slack = 1.0 / 64;

// A slab of blocks, as far as it is in front of the eye.
struct Slab {
    std::int64_t block;
    double near, far;  // planes
    double middle;
    double thickness;  // voxels, 0 where the eye is in it or near
};

// Blocks along an axis, [first, last].
struct Run {
    std::int32_t first, last;
    bool empty() const { return last < first; }
    bool contains(std::int64_t block) const { return first <= block && block <= last; }
};
// What a beam crosses of a slab along u or v.
struct Crossing {
    Run met;  // of the grid
    Run by;   // whose functions count, if any do
};

// Along u or v: where a beam's rays are, at + slope * w.
struct Side {
    Interval at, slope;
};

class FacePass {
  public:
    FacePass(const Factorisation& factorisation, const Face& face, const BlockGrid& grid,
             const BlockRates& rates, const Settings& settings, BlockSet& visible, base::Workers& workers)
        : f_(factorisation),
          face_(face),
          grid_(grid),
          kind_(settings.kind),
          depth_(-std::log1p(-settings.threshold)),
          rate_(rates.rate),
          visible_(visible),
          step_(std::max(factorisation.slice_pitch(), 1.0)) {
        const volume::Box shown = factorisation.shown();
        for (std::size_t a = 0; a < 3; ++a) {
            // Cells across the cube's end, of whichever size, are left out.
            const std::int64_t cell = std::max<std::int64_t>(std::int64_t{1} << factorisation.level(), 4);
            const std::int64_t last = factorisation.lattice.n[a] - 1;
            begins_[a] = static_cast<double>(shown.lo[a]);
            ends_[a] = static_cast<double>(std::min(last / cell * cell, shown.hi[a]));
            const std::int64_t whole_end = shown.hi[a] == last ? grid.counts()[a] : shown.hi[a] / grid.edge();
            whole_[a] = {static_cast<std::int32_t>((shown.lo[a] + grid.edge() - 1) / grid.edge()),
                         static_cast<std::int32_t>(whole_end - 1)};
        }
        const int pixels = std::max((std::max(face.width, face.height) + most_beams - 1) / most_beams, 1);
        u_ = sides(face.u_axis(), face.origin.x, face.pitch.x, face.width, pixels);
        v_ = sides(face.v_axis(), face.origin.y, face.pitch.y, face.height, pixels);
        lay_slabs();
        u_crossings_ = crossings(u_, face.u_axis());
        v_crossings_ = crossings(v_, face.v_axis());
        find_functions(rates, workers);
    }

    std::int64_t rows() const { return static_cast<std::int64_t>(v_.size()); }

    void pass_row(std::int64_t row) {
        const auto j = static_cast<std::size_t>(row);
        for (std::size_t i = 0; i < u_.size(); ++i) {
            pass(i, j);
        }
    }

  private:
    bool perspective() const { return f_.projection == view::Projection::perspective; }

    std::vector<Side> sides(int axis, double origin, double pitch, int count, int pixels) const {
        std::vector<Side> sides;
        for (int first = 0; first < count; first += pixels) {
            const int last = std::min(first + pixels, count) - 1;
            const auto [lo, hi] = std::minmax({origin + first * pitch, origin + last * pitch});
            if (perspective()) {
                // The eye's part is added below, where the slope is known to go with it.
                sides.push_back({{f_.eye[axis], f_.eye[axis]}, {lo, hi}});
            } else {
                const double slope = f_.direction[axis] / f_.direction[face_.axis];
                sides.push_back({{lo, hi}, {slope, slope}});
            }
        }
        return sides;
    }

    // From where positions along the principal axis are counted.
    double origin() const { return perspective() ? f_.eye[face_.axis] : 0; }

    void lay_slabs() {
        const auto edge = static_cast<double>(grid_.edge());
        const std::int64_t count = grid_.counts()[static_cast<std::size_t>(face_.axis)];
        const auto end = static_cast<double>(f_.lattice.n[static_cast<std::size_t>(face_.axis)] - 1);
        for (std::int64_t n = 0; n < count; ++n) {
            Slab slab;
            slab.block = face_.sign > 0 ? n : count - 1 - n;
            const double lo = static_cast<double>(slab.block) * edge, hi = std::min(lo + edge, end);
            slab.near = face_.sign > 0 ? lo : hi;
            slab.far = face_.sign > 0 ? hi : lo;
            slab.middle = lo + edge / 2;
            slab.thickness = whole_[static_cast<std::size_t>(face_.axis)].contains(slab.block) ? hi - lo : 0;
            if (perspective()) {
                const double eye = f_.eye[face_.axis];
                if ((slab.far - eye) * face_.sign <= 0) {
                    continue;
                }
                // A ray's first sample may stand for half a step: it has to lie before the slab.
                if ((slab.near - eye) * face_.sign < std::max(f_.slice_pitch(), 1.0)) {
                    slab.near = face_.sign > 0 ? std::max(slab.near, eye) : std::min(slab.near, eye);
                    slab.thickness = 0;
                }
            }
            slabs_.push_back(slab);
        }
    }

    // All that will be needed, before several threads do.
    void find_functions(const BlockRates& rates, base::Workers& workers) {
        // Of a row's beams, one after the other, and where each one's begin.
        struct Row {
            std::vector<int> cells;
            std::vector<std::size_t> first_of;
        };
        std::vector<Row> rows_of_cells(v_.size());
        workers.for_each(rows(), [&](std::int64_t n) {
            const Side& v = v_[static_cast<std::size_t>(n)];
            Row& row = rows_of_cells[static_cast<std::size_t>(n)];
            std::vector<int> some;
            for (const Side& u : u_) {
                if (row.first_of.empty() || perspective()) {
                    rates.directions.cells_of(face_.axis, {u.slope, v.slope}, some);
                }
                row.first_of.push_back(row.cells.size());
                row.cells.insert(row.cells.end(), some.begin(), some.end());
            }
        });
        std::vector<std::uint8_t> needed(static_cast<std::size_t>(rates.directions.cells()));
        for (const Row& row : rows_of_cells) {
            for (const int cell : row.cells) {
                needed[static_cast<std::size_t>(cell)] = 1;
            }
        }
        std::vector<int> each;
        for (std::size_t cell = 0; cell < needed.size(); ++cell) {
            if (needed[cell] != 0) {
                each.push_back(static_cast<int>(cell));
            }
        }
        const std::vector<BlockRates::Codes> codes = rates.of(each, workers);
        std::vector<const std::uint8_t*> by_cell(needed.size());
        for (std::size_t n = 0; n < each.size(); ++n) {
            by_cell[static_cast<std::size_t>(each[n])] = codes[n].data();
        }
        for (const Row& row : rows_of_cells) {
            for (const std::size_t first : row.first_of) {
                first_of_.push_back(codes_.size() + first);
            }
            for (const int cell : row.cells) {
                codes_.push_back(by_cell[static_cast<std::size_t>(cell)]);
            }
        }
        first_of_.push_back(codes_.size());
    }

    // Where the beam is on the planes from w0 to w1.
    static Interval between(const Side& side, double w0, double w1) {
        const auto [lo, hi] =
            std::minmax({side.slope.lo * w0, side.slope.lo * w1, side.slope.hi * w0, side.slope.hi * w1});
        return {side.at.lo + lo - slack, side.at.hi + hi + slack};
    }
    Run run(const Interval& interval) const {
        const auto block_at = [&](double at) {
            constexpr double far = 1e9;  // beyond every grid
            return static_cast<std::int32_t>(
                std::clamp(std::floor(at / static_cast<double>(grid_.edge())), -far, far));
        };
        return {block_at(interval.lo), block_at(interval.hi)};
    }

    // Of each of some sides, of each slab.
    std::vector<Crossing> crossings(const std::vector<Side>& sides, int axis) const {
        const auto a = static_cast<std::size_t>(axis);
        const auto last = static_cast<std::int32_t>(grid_.counts()[a] - 1);
        std::vector<Crossing> crossings;
        for (const Side& side : sides) {
            for (const Slab& slab : slabs_) {
                const double near = slab.near - origin(), far = slab.far - origin();
                const double middle = slab.middle - origin();
                const Interval all = between(side, near, far);
                const Interval by = kind_ == Kind::opof ? between(side, middle, middle) : all;
                // No function is of lines that come in or go out by the sides of the cube, or of what is
                // shown of it, nor by how much a ray's first or last sample in it is less than a step; and
                // none of a part of a block.
                const Interval on = between(side, near - face_.sign * step_, far + face_.sign * step_);
                const Run counted = run(by);
                const bool inside = slab.thickness > 0 && std::min(on.lo, by.lo) >= begins_[a] &&
                                    std::max(on.hi, by.hi) < ends_[a] && whole_[a].contains(counted.first) &&
                                    whole_[a].contains(counted.last);
                const Run met = run(all);
                crossings.push_back(
                    {{std::max(met.first, 0), std::min(met.last, last)}, inside ? counted : Run{0, -1}});
            }
        }
        return crossings;
    }

    // World length of the beam's shortest ray from plane to plane of voxels, in the smallest distance of two.
    double shortest_step(const Side& u, const Side& v) const {
        const view::Vec3& spacing = f_.lattice.spacing;
        const auto gentlest = [](const Interval& slope) { return std::clamp(0.0, slope.lo, slope.hi); };
        const double along = spacing[face_.axis], across_u = gentlest(u.slope) * spacing[face_.u_axis()],
                     across_v = gentlest(v.slope) * spacing[face_.v_axis()];
        return std::sqrt(along * along + across_u * across_u + across_v * across_v) /
               std::min({spacing.x, spacing.y, spacing.z});
    }

    void pass(std::size_t i, std::size_t j) {
        const Index3 strides{1, grid_.counts()[0], grid_.counts()[0] * grid_.counts()[1]};
        const std::int64_t along = strides[static_cast<std::size_t>(face_.axis)];
        const std::int64_t across_u = strides[static_cast<std::size_t>(face_.u_axis())];
        const std::int64_t across_v = strides[static_cast<std::size_t>(face_.v_axis())];
        const std::size_t beam = j * u_.size() + i;
        const auto codes = std::span(codes_).subspan(first_of_[beam], first_of_[beam + 1] - first_of_[beam]);
        const double step = shortest_step(u_[i], v_[j]);
        double left = depth_;
        for (std::size_t n = 0; n < slabs_.size(); ++n) {
            const auto& [met_u, by_u] = u_crossings_[i * slabs_.size() + n];
            const auto& [met_v, by_v] = v_crossings_[j * slabs_.size() + n];
            if (met_u.empty() || met_v.empty()) {
                continue;
            }
            const std::int64_t slab_first = slabs_[n].block * along;
            for (std::int64_t v = met_v.first; v <= met_v.last; ++v) {
                for (std::int64_t u = met_u.first; u <= met_u.last; ++u) {
                    const auto block = static_cast<std::size_t>(slab_first + v * across_v + u * across_u);
                    std::atomic_ref(visible_.bytes()[block]).store(1, std::memory_order_relaxed);
                }
            }
            if (by_u.empty() || by_v.empty()) {
                continue;
            }
            std::uint8_t least = 255;
            for (const std::uint8_t* const of : codes) {
                for (std::int64_t v = by_v.first; v <= by_v.last; ++v) {
                    for (std::int64_t u = by_u.first; u <= by_u.last; ++u) {
                        least = std::min(least, of[slab_first + v * across_v + u * across_u]);
                    }
                }
            }
            if (least == 0) {
                continue;
            }
            const int parts = 1 + (by_u.first < by_u.last ? 1 : 0) + (by_v.first < by_v.last ? 1 : 0);
            left -= depth_of(static_cast<double>(rate_[least]) * step, slabs_[n].thickness, parts);
            if (left <= 0) {
                return;
            }
        }
    }

    // Of a slab whose blocks have at least a rate, from plane to plane, crossed in at most so many parts.
    double depth_of(double rate, double thickness, int parts) const {
        switch (kind_) {
            case Kind::pof:
                return rate;  // some block has a sample of the ray
            case Kind::opof_linear: {
                // The opacity of a part is the greatest thickness' times its share of that. Together parts
                // are least opaque if they are alike.
                const double opacity = -std::expm1(-rate * thickness);
                return -parts * std::log1p(-opacity / parts * (1 - 1e-12));
            }
            default:
                return rate * thickness;
        }
    }

    const Factorisation& f_;
    const Face& face_;
    const BlockGrid& grid_;
    Kind kind_;
    double depth_;  // that hides what is behind
    const std::array<float, 256>& rate_;
    BlockSet& visible_;
    double step_;                          // at most from slice to slice, in voxels
    std::array<double, 3> begins_, ends_;  // of what functions are of, in voxels
    std::array<Run, 3> whole_;             // blocks that are shown from end to end
    std::vector<Side> u_, v_;
    std::vector<Slab> slabs_;
    std::vector<Crossing> u_crossings_, v_crossings_;  // of a side's slabs, one side after the other
    std::vector<const std::uint8_t*> codes_;           // of each beam's directions, one beam after the other
    std::vector<std::size_t> first_of_;                // of each beam
};

}  // namespace

BlockSet visible_blocks(const Factorisation& factorisation, const BlockGrid& grid, const BlockRates& rates,
                        const Settings& settings, base::Workers& workers) {
    BlockSet visible(grid.size());
    for (const Face& face : factorisation.faces) {
        FacePass pass(factorisation, face, grid, rates, settings, visible, workers);
        workers.for_each(pass.rows(), [&](std::int64_t row) { pass.pass_row(row); });
    }
    return visible;
}

}  // namespace shearwater::culling
