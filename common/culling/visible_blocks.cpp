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
    std::int64_t first, last;
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
          visible_(visible) {
        for (std::size_t a = 0; a < 3; ++a) {
            // Cells across the cube's end, of whichever size, are left out.
            const std::int64_t cell = std::max<std::int64_t>(std::int64_t{1} << factorisation.level(), 4);
            ends_[a] = static_cast<double>((factorisation.lattice.n[a] - 1) / cell * cell);
        }
        const int pixels = std::max((std::max(face.width, face.height) + most_beams - 1) / most_beams, 1);
        u_ = sides(face.u_axis(), face.origin.x, face.pitch.x, face.width, pixels);
        v_ = sides(face.v_axis(), face.origin.y, face.pitch.y, face.height, pixels);
        lay_slabs();
        find_functions(rates, workers);
    }

    std::int64_t rows() const { return static_cast<std::int64_t>(v_.size()); }

    void pass_row(std::int64_t row) {
        const auto j = static_cast<std::size_t>(row);
        for (std::size_t i = 0; i < u_.size(); ++i) {
            pass(u_[i], v_[j], beams_[j * u_.size() + i]);
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
            slab.thickness = hi - lo;
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
        std::vector<int> cells, some;
        Slopes last;
        for (const Side& v : v_) {
            for (const Side& u : u_) {
                if (beams_.empty() || !(last.u == u.slope && last.v == v.slope)) {
                    last = {u.slope, v.slope};
                    rates.directions.cells_of(face_.axis, last, some);
                    first_of_.push_back(cells.size());
                    cells.insert(cells.end(), some.begin(), some.end());
                }
                beams_.push_back(first_of_.size() - 1);
            }
        }
        first_of_.push_back(cells.size());
        std::vector<int> each = cells;
        std::sort(each.begin(), each.end());
        each.erase(std::unique(each.begin(), each.end()), each.end());
        const std::vector<BlockRates::Codes> codes = rates.of(each, workers);
        std::vector<const std::uint8_t*> by_cell(static_cast<std::size_t>(rates.directions.cells()));
        for (std::size_t n = 0; n < each.size(); ++n) {
            by_cell[static_cast<std::size_t>(each[n])] = codes[n].data();
        }
        for (const int cell : cells) {
            codes_.push_back(by_cell[static_cast<std::size_t>(cell)]);
        }
    }

    // Where the beam is on the planes from w0 to w1.
    static Interval between(const Side& side, double w0, double w1) {
        const auto [lo, hi] =
            std::minmax({side.slope.lo * w0, side.slope.lo * w1, side.slope.hi * w0, side.slope.hi * w1});
        return {side.at.lo + lo - slack, side.at.hi + hi + slack};
    }
    Run run(const Interval& interval) const {
        const auto edge = static_cast<double>(grid_.edge());
        return {static_cast<std::int64_t>(std::floor(interval.lo / edge)),
                static_cast<std::int64_t>(std::floor(interval.hi / edge))};
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

    void pass(const Side& u, const Side& v, std::size_t beam) {
        const auto wa = static_cast<std::size_t>(face_.axis);
        const auto ua = static_cast<std::size_t>(face_.u_axis()),
                   va = static_cast<std::size_t>(face_.v_axis());
        const std::int64_t count_u = grid_.counts()[ua], count_v = grid_.counts()[va];
        const Index3 strides{1, grid_.counts()[0], grid_.counts()[0] * grid_.counts()[1]};
        const auto codes = std::span(codes_).subspan(first_of_[beam], first_of_[beam + 1] - first_of_[beam]);
        const double step = shortest_step(u, v);
        double left = depth_;
        for (const Slab& slab : slabs_) {
            const double near = slab.near - origin(), far = slab.far - origin();
            const Run met_u = run(between(u, near, far)), met_v = run(between(v, near, far));
            const Run in_u{std::max<std::int64_t>(met_u.first, 0), std::min(met_u.last, count_u - 1)};
            const Run in_v{std::max<std::int64_t>(met_v.first, 0), std::min(met_v.last, count_v - 1)};
            if (in_u.first > in_u.last || in_v.first > in_v.last) {
                continue;
            }
            const std::int64_t slab_first = slab.block * strides[wa];
            for (std::int64_t bv = in_v.first; bv <= in_v.last; ++bv) {
                for (std::int64_t bu = in_u.first; bu <= in_u.last; ++bu) {
                    const auto block =
                        static_cast<std::size_t>(slab_first + bv * strides[va] + bu * strides[ua]);
                    std::atomic_ref(visible_.bytes()[block]).store(1, std::memory_order_relaxed);
                }
            }
            if (slab.thickness == 0) {
                continue;
            }
            // Lines that are out of the cube there are among none of its blocks' functions.
            const double middle = slab.middle - origin();
            const bool half_way = kind_ == Kind::opof;
            const Interval by_u = half_way ? between(u, middle, middle) : between(u, near, far);
            const Interval by_v = half_way ? between(v, middle, middle) : between(v, near, far);
            if (by_u.lo < 0 || by_u.hi >= ends_[ua] || by_v.lo < 0 || by_v.hi >= ends_[va]) {
                continue;
            }
            const Run run_u = run(by_u), run_v = run(by_v);
            std::uint8_t least = 255;
            for (const std::uint8_t* const of : codes) {
                for (std::int64_t bv = run_v.first; bv <= run_v.last; ++bv) {
                    for (std::int64_t bu = run_u.first; bu <= run_u.last; ++bu) {
                        least = std::min(least, of[slab_first + bv * strides[va] + bu * strides[ua]]);
                    }
                }
            }
            const int parts = 1 + (run_u.first < run_u.last ? 1 : 0) + (run_v.first < run_v.last ? 1 : 0);
            left -= depth_of(static_cast<double>(rate_[least]) * step, slab.thickness, parts);
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
    std::array<double, 3> ends_;  // of what functions are of, in voxels
    std::vector<Side> u_, v_;
    std::vector<Slab> slabs_;
    std::vector<const std::uint8_t*> codes_;  // of the directions of some beams, one after the other
    std::vector<std::size_t> first_of_;       // of those
    std::vector<std::size_t> beams_;          // which of them each beam has
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
