#include "common/culling/beams.h"

#include <algorithm>
#include <cmath>

namespace shearwater::culling {

using view::Face;
using view::Factorisation;

namespace {

// So many beams along a face's longer side for each block of the grid's longest, and at the least and the
// most. Grids of few blocks, which are soon passed, have more of them: there a block is a large share of all.
constexpr std::int64_t beams_per_block = 4;
constexpr std::int64_t least_beams = 80, most_beams = 112;
constexpr std::int64_t beams_times_blocks = 1440, most_beams_of_few = 160;
// Where samples are told from one another is rounded by less than this, in voxels.
constexpr double slack = 1.0 / 64;

Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

// Of a grid with so many blocks along its longest side.
std::int64_t beams_for(std::int64_t blocks) {
    return std::max(std::clamp(beams_per_block * blocks, least_beams, most_beams),
                    std::min(beams_times_blocks / blocks, most_beams_of_few));
}

}  // namespace

Beams::Beams(const Factorisation& factorisation, const Face& face, const BlockGrid& grid)
    : f_(factorisation), face_(face), grid_(grid), step_(std::max(factorisation.slice_pitch(), 1.0)) {
    const volume::Box shown = factorisation.shown();
    for (std::size_t a = 0; a < 3; ++a) {
        const std::int64_t last = factorisation.lattice.n[a] - 1;
        begins_[a] = static_cast<double>(shown.lo[a]);
        ends_[a] = static_cast<double>(shown.hi[a]);
        const std::int64_t whole_end = shown.hi[a] == last ? grid.counts()[a] : shown.hi[a] / grid.edge();
        whole_[a] = {static_cast<std::int32_t>((shown.lo[a] + grid.edge() - 1) / grid.edge()),
                     static_cast<std::int32_t>(whole_end - 1)};
    }
    const auto beams = static_cast<int>(beams_for(*std::ranges::max_element(grid.counts())));
    const int pixels = std::max((std::max(face.width, face.height) + beams - 1) / beams, 1);
    u_ = sides(face.u_axis(), face.origin.x, face.pitch.x, face.width, pixels);
    v_ = sides(face.v_axis(), face.origin.y, face.pitch.y, face.height, pixels);
    lay_slabs();
}

std::vector<Side> Beams::sides(int axis, double origin, double pitch, int count, int pixels) const {
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

void Beams::lay_slabs() {
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

std::vector<Tile> Beams::tiles() const {
    constexpr std::size_t side = 4 * TileCells::group;
    std::vector<Tile> tiles;
    for (std::size_t v0 = 0; v0 < v_.size(); v0 += side) {
        const std::size_t v1 = std::min(v0 + side, v_.size());
        const std::size_t row = tiles.size();
        for (std::size_t u0 = 0; u0 < u_.size(); u0 += side) {
            tiles.push_back({u0, std::min(u0 + side, u_.size()), v0, v1});
        }
        if (v0 / side % 2 == 1) {
            std::reverse(tiles.begin() + static_cast<std::ptrdiff_t>(row), tiles.end());
        }
    }
    return tiles;
}

// Of the beams of a group at a time: most have the same, and the others' functions differ little.
TileCells Beams::cells(const Tile& tile, const DirectionGrid& directions) const {
    constexpr std::size_t group = TileCells::group;
    TileCells cells;
    std::vector<int> all;
    for (std::size_t v = tile.v0; v < tile.v1; v += group) {
        const Interval v_slopes = hull(v_[v].slope, v_[std::min(v + group, tile.v1) - 1].slope);
        for (std::size_t u = tile.u0; u < tile.u1; u += group) {
            if (all.empty() || perspective()) {
                const Interval u_slopes = hull(u_[u].slope, u_[std::min(u + group, tile.u1) - 1].slope);
                directions.cells_of(face_.axis, {u_slopes, v_slopes}, all);
            }
            cells.first_of.push_back(cells.cells.size());
            cells.cells.insert(cells.cells.end(), all.begin(), all.end());
        }
    }
    cells.first_of.push_back(cells.cells.size());
    return cells;
}

// Where the beam is on the planes from w0 to w1.
Interval Beams::between(const Side& side, double w0, double w1) {
    const auto [lo, hi] =
        std::minmax({side.slope.lo * w0, side.slope.lo * w1, side.slope.hi * w0, side.slope.hi * w1});
    return {side.at.lo + lo - slack, side.at.hi + hi + slack};
}

Run Beams::run(const Interval& interval) const {
    const auto block_at = [&](double at) {
        constexpr double far = 1e9;  // beyond every grid
        return static_cast<std::int32_t>(
            std::clamp(std::floor(at / static_cast<double>(grid_.edge())), -far, far));
    };
    return {block_at(interval.lo), block_at(interval.hi)};
}

std::vector<Run> Beams::met(const std::vector<Side>& sides, int axis) const {
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
Interval Beams::inside(const Side& side, std::size_t axis) const {
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

std::vector<Counted> Beams::counted(const std::vector<Side>& sides, int axis, Footprint footprint) const {
    const auto a = static_cast<std::size_t>(axis);
    const Counted none{{0, -1}, 0, 0};
    std::vector<Counted> all;
    for (const Side& side : sides) {
        const Interval in = inside(side, a);
        for (const Slab& slab : slabs_) {
            const double slab_near = (slab.near - origin()) * face_.sign;
            const double slab_far = (slab.far - origin()) * face_.sign;
            const double near = std::max(slab_near, in.lo + step_), far = std::min(slab_far, in.hi - step_);
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
            all.push_back(are_whole ? Counted{by, static_cast<float>(near), static_cast<float>(far)} : none);
        }
    }
    return all;
}

double Beams::shortest_step(const Side& u, const Side& v) const {
    const view::Vec3& spacing = f_.lattice.spacing;
    const auto gentlest = [](const Interval& slope) { return std::clamp(0.0, slope.lo, slope.hi); };
    const double along = spacing[face_.axis], across_u = gentlest(u.slope) * spacing[face_.u_axis()],
                 across_v = gentlest(v.slope) * spacing[face_.v_axis()];
    return std::sqrt(along * along + across_u * across_u + across_v * across_v) /
           std::min({spacing.x, spacing.y, spacing.z});
}

}  // namespace shearwater::culling
