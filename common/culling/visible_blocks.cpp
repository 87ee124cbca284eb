#include "common/culling/visible_blocks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "common/base/check.h"
#include "common/culling/beams.h"

namespace shearwater::culling {

using view::Face;
using view::Factorisation;
using volume::Index3;

namespace {

// What a ray gathers by the kernel's tables and rounded sums is less than by exact opacities by at most such
// a part of its depth, or little more.
constexpr double lack = 1.0 / 200;

double depth_that_hides(const Settings& settings) {
    return -std::log1p(-settings.threshold) * (1 + lack);
}

// What functions of one footprint say along the beams of a face.
struct Said {
    const std::array<float, 256>& rate;
    std::vector<Counted> u, v;      // of a side's slabs, one side after the other
    std::vector<BlockCodes> codes;  // of each cell that is needed
};

class FacePass {
  public:
    FacePass(const Factorisation& factorisation, const Face& face, const BlockGrid& grid,
             std::span<const BlockRates> rates, const Settings& settings, const ImagePart& part,
             BlockSet& visible, base::Workers& workers)
        : face_(face),
          grid_(grid),
          kind_(settings.kind),
          depth_(depth_that_hides(settings)),
          visible_(visible),
          beams_(factorisation, face, grid),
          u_met_(beams_.met(beams_.u(), face.u_axis())),
          v_met_(beams_.met(beams_.v(), face.v_axis())) {
        const DirectionGrid& directions = rates.front().directions;
        for (const Tile& tile : tiles_of(part)) {
            tiles_.push_back({tile, {}});
        }
        workers.for_each(tiles(), [&](std::int64_t n) {
            Looked& looked = tiles_[static_cast<std::size_t>(n)];
            looked.cells = beams_.cells(looked.tile, directions);
        });
        const std::vector<int> needed = count_needed(directions);
        for (const BlockRates& of : rates) {
            base::check(of.directions == directions, "a cube's functions are over the same directions");
            said_.push_back({of.rate, beams_.counted(beams_.u(), face.u_axis(), of.footprint),
                             beams_.counted(beams_.v(), face.v_axis(), of.footprint),
                             of.of(needed, workers)});
        }
    }

    std::int64_t tiles() const { return static_cast<std::int64_t>(tiles_.size()); }

    void pass_tile(std::int64_t n) {
        const auto& [tile, cells] = tiles_[static_cast<std::size_t>(n)];
        for (std::size_t j = tile.v0; j < tile.v1; ++j) {
            for (std::size_t i = tile.u0; i < tile.u1; ++i) {
                pass(i, j, cells.of(tile, i, j));
            }
        }
    }

  private:
    struct Looked {
        Tile tile;
        TileCells cells;
    };

    // Tiles beside one another, by what the beams in their middles meet.
    std::vector<Tile> tiles_of(const ImagePart& part) const {
        const std::size_t slabs = beams_.slabs().size();
        const std::vector<Tile> all = beams_.tiles();
        std::vector<std::int64_t> before{0};  // what so many tiles take
        for (const Tile& tile : all) {
            const std::size_t i = std::midpoint(tile.u0, tile.u1 - 1),
                              j = std::midpoint(tile.v0, tile.v1 - 1);
            std::int64_t met = 1;
            for (std::size_t n = 0; n < slabs; ++n) {
                met += u_met_[i * slabs + n].empty() || v_met_[j * slabs + n].empty() ? 0 : 1;
            }
            before.push_back(before.back() + met);
        }
        std::vector<Tile> tiles;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if ((before[n] + before[n + 1]) * part.parts / (2 * before.back()) == part.part) {
                tiles.push_back(all[n]);
            }
        }
        return tiles;
    }

    // The cells that beams need, each once; of the tiles' is kept which of those it is.
    std::vector<int> count_needed(const DirectionGrid& directions) {
        std::vector<int> place(static_cast<std::size_t>(directions.cells()), -1);
        std::vector<int> needed;
        for (Looked& looked : tiles_) {
            for (int& cell : looked.cells.cells) {
                int& of_cell = place[static_cast<std::size_t>(cell)];
                if (of_cell < 0) {
                    of_cell = static_cast<int>(needed.size());
                    needed.push_back(cell);
                }
                cell = of_cell;
            }
        }
        return needed;
    }

    void pass(std::size_t i, std::size_t j, std::span<const int> cells) {
        const Index3 strides{1, grid_.counts()[0], grid_.counts()[0] * grid_.counts()[1]};
        const std::int64_t along = strides[static_cast<std::size_t>(face_.axis)];
        const std::int64_t across_u = strides[static_cast<std::size_t>(face_.u_axis())];
        const std::int64_t across_v = strides[static_cast<std::size_t>(face_.v_axis())];
        const double step = beams_.shortest_step(beams_.u()[i], beams_.v()[j]);
        double left = depth_;
        for (std::size_t n = 0; n < beams_.slabs().size(); ++n) {
            const Run& met_u = u_met_[i * beams_.slabs().size() + n];
            const Run& met_v = v_met_[j * beams_.slabs().size() + n];
            if (met_u.empty() || met_v.empty()) {
                continue;
            }
            const std::int64_t slab_first = beams_.slabs()[n].block * along;
            for (std::int64_t v = met_v.first; v <= met_v.last; ++v) {
                for (std::int64_t u = met_u.first; u <= met_u.last; ++u) {
                    const auto block = static_cast<std::size_t>(slab_first + v * across_v + u * across_u);
                    std::atomic_ref(visible_.bytes()[block]).store(1, std::memory_order_relaxed);
                }
            }
            double most = 0;
            for (const Said& said : said_) {
                most = std::max(most, depth_of(said, i, j, cells, n, slab_first, across_u, across_v, step));
            }
            left -= most;
            if (left <= 0) {
                return;
            }
        }
    }

    // What the functions of a footprint say that a beam gathers in a slab at the least.
    double depth_of(const Said& said, std::size_t i, std::size_t j, std::span<const int> cells,
                    std::size_t slab, std::int64_t slab_first, std::int64_t across_u, std::int64_t across_v,
                    double step) const {
        const auto& [by_u, near_u, far_u] = said.u[i * beams_.slabs().size() + slab];
        const auto& [by_v, near_v, far_v] = said.v[j * beams_.slabs().size() + slab];
        const double part = static_cast<double>(std::min(far_u, far_v) - std::max(near_u, near_v));
        if (by_u.empty() || by_v.empty() || part <= 0) {
            return 0;
        }
        std::uint8_t least = 255;
        for (const int cell : cells) {
            const BlockCodes& of = said.codes[static_cast<std::size_t>(cell)];
            const auto of_blocks = [&](const auto& code) {
                for (std::int64_t v = by_v.first; v <= by_v.last; ++v) {
                    for (std::int64_t u = by_u.first; u <= by_u.last; ++u) {
                        least = std::min(
                            least, code(static_cast<std::size_t>(slab_first + v * across_v + u * across_u)));
                    }
                }
            };
            if (of.paired()) {
                of_blocks([&](std::size_t block) { return of.of_pair(block); });
            } else {
                of_blocks([&](std::size_t block) { return of.alone(block); });
            }
        }
        if (least == 0) {
            return 0;
        }
        const int parts = 1 + (by_u.first < by_u.last ? 1 : 0) + (by_v.first < by_v.last ? 1 : 0);
        return depth_of(static_cast<double>(said.rate[least]) * step, beams_.slabs()[slab].thickness, part,
                        parts);
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

    const Face& face_;
    const BlockGrid& grid_;
    Kind kind_;
    double depth_;  // that hides what is behind
    BlockSet& visible_;
    Beams beams_;
    std::vector<Run> u_met_, v_met_;  // of a side's slabs, one side after the other
    std::vector<Looked> tiles_;
    std::vector<Said> said_;
};

// Whether a ray through all of the cube may have so much depth by the greatest of all rates. By no kind has
// it more along a way than by opof.
bool may_hide(const view::Lattice& lattice, std::span<const BlockRates> rates, double depth) {
    const view::Vec3& spacing = lattice.spacing;
    const double steps = lattice.diagonal() / std::min({spacing.x, spacing.y, spacing.z});
    return std::ranges::any_of(
        rates, [&](const BlockRates& of) { return static_cast<double>(of.greatest) * steps >= depth; });
}

}  // namespace

BlockSet visible_blocks(const Factorisation& factorisation, const BlockGrid& grid,
                        std::span<const BlockRates> rates, const Settings& settings, base::Workers& workers,
                        const ImagePart& part) {
    base::check(0 <= part.part && part.part < part.parts, "a part is one of all");
    if (!may_hide(factorisation.lattice, rates, depth_that_hides(settings))) {
        return BlockSet(grid.size(), true);
    }
    BlockSet visible(grid.size());
    for (const Face& face : factorisation.faces) {
        FacePass pass(factorisation, face, grid, rates, settings, part, visible, workers);
        workers.for_each(pass.tiles(), [&](std::int64_t tile) { pass.pass_tile(tile); });
    }
    return visible;
}

}  // namespace shearwater::culling
