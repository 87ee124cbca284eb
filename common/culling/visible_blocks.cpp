#include "common/culling/visible_blocks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace shearwater::culling {

using view::Face;
using view::Factorisation;
using volume::Index3;

namespace {

// So many beams along a face's longer side.
constexpr int most_beams = 112;
// What a ray gathers by the kernel's tables and rounded sums is less than by exact opacities by at most such a
// part of its depth, or little more.
constexpr double lack = 1.0 / 200;
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

// Along u or v: where a beam's rays are, at + slope * w.
struct Side {
    Interval at, slope;
};

// Where a side has a slab's functions count, and whose.
struct Counted {
    Run by;           // or none
    float near, far;  // of the slab, how far along the principal axis in front of where that is counted from
};

// What functions of one footprint say along the beams of a face.
struct Said {
    Footprint footprint;
    const std::array<float, 256>& rate;
    std::vector<Counted> u, v;               // of a side's slabs, one side after the other
    std::vector<const std::uint8_t*> codes;  // of each beam's directions, one beam after the other
    std::vector<std::size_t> first_of;       // of each beam
};

class FacePass {
  public:
    FacePass(const Factorisation& factorisation, const Face& face, const BlockGrid& grid,
             std::span<const BlockRates> rates, const Settings& settings, BlockSet& visible,
             base::Workers& workers)
        : f_(factorisation),
          face_(face),
          grid_(grid),
          kind_(settings.kind),
          depth_(-std::log1p(-settings.threshold) * (1 + lack)),
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
        u_met_ = met(u_, face.u_axis());
        v_met_ = met(v_, face.v_axis());
        for (const BlockRates& each : rates) {
            said_.push_back({each.footprint,
                             each.rate,
                             counted(u_, face.u_axis(), each.footprint),
                             counted(v_, face.v_axis(), each.footprint),
                             {},
                             {}});
            find_functions(each, said_.back(), workers);
        }
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
    void find_functions(const BlockRates& rates, Said& said, base::Workers& workers) const {
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
                said.first_of.push_back(said.codes.size() + first);
            }
            for (const int cell : row.cells) {
                said.codes.push_back(by_cell[static_cast<std::size_t>(cell)]);
            }
        }
        said.first_of.push_back(said.codes.size());
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

    // What each of some sides meets of each slab, of the grid.
    std::vector<Run> met(const std::vector<Side>& sides, int axis) const {
        const auto last = static_cast<std::int32_t>(grid_.counts()[static_cast<std::size_t>(axis)] - 1);
        std::vector<Run> runs;
        for (const Side& side : sides) {
            for (const Slab& slab : slabs_) {
                const Run all = run(between(side, slab.near - origin(), slab.far - origin()));
                runs.push_back({std::max(all.first, 0), std::min(all.last, last)});
            }
        }
        return runs;
    }

    // How far in front of where that is counted from all of a side's rays are inside of what is shown.
    Interval inside(const Side& side, std::size_t axis) const {
        const auto [slowest, fastest] = std::minmax({side.slope.lo * face_.sign, side.slope.hi * face_.sign});
        Interval far{-HUGE_VAL, HUGE_VAL};
        // at + slope * t >= 0
        const auto narrow = [&far](double at, double slope) {
            if (slope > 0) {
                far.lo = std::max(far.lo, -at / slope);
            } else if (slope < 0) {
                far.hi = std::min(far.hi, -at / slope);
            } else if (at < 0) {
                far.hi = -HUGE_VAL;
            }
        };
        narrow(side.at.lo - slack - begins_[axis], slowest);
        narrow(ends_[axis] - slack - side.at.hi, -fastest);
        return far;
    }

    // Where functions count of each slab. None is of lines that go half-way past a block and come in or go
    // out by the sides of the cube, or of what is shown of it; those of blocks are of what is inside. Nor is
    // it known by how much a ray's first or last sample there is less than a step; and none is of a part of a
    // block.
    std::vector<Counted> counted(const std::vector<Side>& sides, int axis, Footprint footprint) const {
        const auto a = static_cast<std::size_t>(axis);
        const Counted none{{0, -1}, 0, 0};
        std::vector<Counted> all;
        for (const Side& side : sides) {
            const Interval in = inside(side, a);
            for (const Slab& slab : slabs_) {
                const double slab_near = (slab.near - origin()) * face_.sign;
                const double slab_far = (slab.far - origin()) * face_.sign;
                const double near = std::max(slab_near, in.lo + step_),
                             far = std::min(slab_far, in.hi - step_);
                const bool is_cut = near > slab_near || far < slab_far;
                if (slab.thickness <= 0 || near >= far || (is_cut && footprint == Footprint::column)) {
                    all.push_back(none);
                    continue;
                }
                const double middle = slab.middle - origin();
                const Run by =
                    run(footprint == Footprint::column ? between(side, middle, middle)
                                                       : between(side, near * face_.sign, far * face_.sign));
                const bool are_whole = whole_[a].contains(by.first) && whole_[a].contains(by.last);
                all.push_back(are_whole ? Counted{by, static_cast<float>(near), static_cast<float>(far)}
                                        : none);
            }
        }
        return all;
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
        const double step = shortest_step(u_[i], v_[j]);
        double left = depth_;
        for (std::size_t n = 0; n < slabs_.size(); ++n) {
            const Run& met_u = u_met_[i * slabs_.size() + n];
            const Run& met_v = v_met_[j * slabs_.size() + n];
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
            double most = 0;
            for (const Said& said : said_) {
                most = std::max(most, depth_of(said, i, j, n, slab_first, across_u, across_v, step));
            }
            left -= most;
            if (left <= 0) {
                return;
            }
        }
    }

    // What the functions of a footprint say that a beam gathers in a slab at the least.
    double depth_of(const Said& said, std::size_t i, std::size_t j, std::size_t slab, std::int64_t slab_first,
                    std::int64_t across_u, std::int64_t across_v, double step) const {
        const auto& [by_u, near_u, far_u] = said.u[i * slabs_.size() + slab];
        const auto& [by_v, near_v, far_v] = said.v[j * slabs_.size() + slab];
        const double part = static_cast<double>(std::min(far_u, far_v) - std::max(near_u, near_v));
        if (by_u.empty() || by_v.empty() || part <= 0) {
            return 0;
        }
        const std::size_t beam = j * u_.size() + i;
        std::uint8_t least = 255;
        for (std::size_t n = said.first_of[beam]; n < said.first_of[beam + 1]; ++n) {
            const std::uint8_t* const of = said.codes[n];
            for (std::int64_t v = by_v.first; v <= by_v.last; ++v) {
                for (std::int64_t u = by_u.first; u <= by_u.last; ++u) {
                    least = std::min(least, of[slab_first + v * across_v + u * across_u]);
                }
            }
        }
        if (least == 0) {
            return 0;
        }
        const int parts = 1 + (by_u.first < by_u.last ? 1 : 0) + (by_v.first < by_v.last ? 1 : 0);
        return depth_of(static_cast<double>(said.rate[least]) * step, slabs_[slab].thickness, part, parts);
    }

    // Of so much of a slab's thickness whose blocks have at least a rate, crossed in at most so many parts.
    double depth_of(double rate, double thickness, double part, int parts) const {
        const double sample = rate * std::min(part, 1.0);  // some block has one of the ray
        switch (kind_) {
            case Kind::pof:
                return sample;
            case Kind::opof_linear: {
                // The opacity of a part is the greatest thickness' times its share of that. Together parts
                // are least opaque if they are alike.
                const double opacity = -std::expm1(-rate * thickness) * part / thickness;
                return std::max(sample, -parts * std::log1p(-opacity / parts * (1 - 1e-12)));
            }
            default:
                return rate * part;
        }
    }

    const Factorisation& f_;
    const Face& face_;
    const BlockGrid& grid_;
    Kind kind_;
    double depth_;  // that hides what is behind
    BlockSet& visible_;
    double step_;                          // at most from slice to slice, in voxels
    std::array<double, 3> begins_, ends_;  // of what functions are of, in voxels
    std::array<Run, 3> whole_;             // blocks that are shown from end to end
    std::vector<Side> u_, v_;
    std::vector<Slab> slabs_;
    std::vector<Run> u_met_, v_met_;  // of a side's slabs, one side after the other
    std::vector<Said> said_;
};

}  // namespace

std::span<const Footprint> footprints_of(Kind kind) {
    static constexpr std::array both{Footprint::block, Footprint::column};
    return std::span(both).first(kind == Kind::opof ? 2 : 1);
}

BlockSet visible_blocks(const Factorisation& factorisation, const BlockGrid& grid,
                        std::span<const BlockRates> rates, const Settings& settings, base::Workers& workers) {
    BlockSet visible(grid.size());
    for (const Face& face : factorisation.faces) {
        FacePass pass(factorisation, face, grid, rates, settings, visible, workers);
        workers.for_each(pass.rows(), [&](std::int64_t row) { pass.pass_row(row); });
    }
    return visible;
}

}  // namespace shearwater::culling
