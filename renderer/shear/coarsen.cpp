#include "renderer/shear/coarsen.h"

#include <algorithm>
#include <cstdlib>
#include <type_traits>
#include <vector>

#include "common/base/check.h"
#include "common/volume/levels.h"

namespace shearwater::shear {

namespace {

using volume::Box;
using volume::Index3;

// Makes rows of a coarser level.
template <class Code>
class Coarsener {
  public:
    // Of some nodes; `last` is the finer level's last one in the cube.
    Coarsener(const CodeVolume& fine, CodeVolume& coarse, const Box& nodes, const Index3& last)
        : fine_(fine),
          coarse_(coarse),
          nodes_(nodes),
          last_(last),
          before_(2 * nodes.lo[0] - 1),
          sums_(static_cast<std::size_t>(2 * nodes.planes(0) + 1)),
          weights_(sums_.size()) {}

    void make_row(std::int64_t y, std::int64_t z) {
        std::fill(sums_.begin(), sums_.end(), Sum{0});
        std::fill(weights_.begin(), weights_.end(), std::uint16_t{0});
        for (int dz = -1; dz <= 1; ++dz) {
            for (int dy = -1; dy <= 1; ++dy) {
                add_row(std::clamp<std::int64_t>(2 * y + dy, 0, last_[1]),
                        std::clamp<std::int64_t>(2 * z + dz, 0, last_[2]),
                        static_cast<std::uint16_t>((2 - std::abs(dy)) * (2 - std::abs(dz))));
            }
        }
        repeat_ends();
        Code* const to = &coarse_.codes<Code>()[coarse_.offset({nodes_.lo[0], y, z})];
        for (std::size_t i = 0; 2 * i + 2 < sums_.size(); ++i) {
            to[i] = mean(tent(sums_, 2 * i), tent(weights_, 2 * i));
        }
    }

  private:
    // 64 times the greatest code fits.
    using Sum = std::conditional_t<sizeof(Code) == 1, std::uint16_t, std::uint32_t>;
    static constexpr unsigned whole = 64;

    // The finer nodes of the cube that the coarser row is made from.
    std::int64_t first_x() const { return std::max<std::int64_t>(before_, 0); }
    std::int64_t last_x() const { return std::min(2 * nodes_.hi[0] + 1, last_[0]); }

    void add_row(std::int64_t y, std::int64_t z, std::uint16_t weight) {
        const Code* const row = &fine_.codes<Code>()[fine_.offset({first_x(), y, z})];
        const auto count = static_cast<std::size_t>(last_x() - first_x() + 1);
        Sum* const sums = &sums_[static_cast<std::size_t>(first_x() - before_)];
        std::uint16_t* const weights = &weights_[static_cast<std::size_t>(first_x() - before_)];
        for (std::size_t x = 0; x < count; ++x) {
            sums[x] = static_cast<Sum>(sums[x] + static_cast<Sum>(weight * row[x]));
            weights[x] = static_cast<std::uint16_t>(weights[x] + (row[x] != 0 ? weight : 0));
        }
    }

    void repeat_ends() {
        const auto first = static_cast<std::size_t>(first_x() - before_);
        const auto last = static_cast<std::size_t>(last_x() - before_);
        const auto repeat = [&](auto& values) {
            std::fill_n(values.begin(), first, values[first]);
            std::fill(values.begin() + static_cast<std::ptrdiff_t>(last) + 1, values.end(), values[last]);
        };
        repeat(sums_);
        repeat(weights_);
    }

    template <class Values>
    static unsigned tent(const Values& values, std::size_t x) {
        return values[x] + 2U * values[x + 1] + values[x + 2];
    }

    static Code mean(unsigned sum, unsigned weight) {
        if (weight == whole) {
            return static_cast<Code>((sum + whole / 2) / whole);
        }
        return weight < whole / 2 ? Code{0} : static_cast<Code>((sum + weight / 2) / weight);
    }

    const CodeVolume& fine_;
    CodeVolume& coarse_;
    Box nodes_;
    Index3 last_;
    std::int64_t before_;  // the finer node that sums_ begin with, perhaps outside the cube
    std::vector<Sum> sums_;
    std::vector<std::uint16_t> weights_;
};

template <class Code>
bool coarsen_codes(const CodeVolume& fine, CodeVolume& coarse, const Box& nodes, const Index3& last,
                   base::Workers& workers, const std::stop_token& stop) {
    // A few planes may be all: there have to be more pieces than workers.
    constexpr std::int64_t rows_at_once = 32;
    const std::int64_t pieces = (nodes.planes(1) + rows_at_once - 1) / rows_at_once;
    return workers.for_each(
        nodes.planes(2) * pieces,
        [&](std::int64_t piece) {
            Coarsener<Code> coarsener(fine, coarse, nodes, last);
            const std::int64_t first = nodes.lo[1] + piece % pieces * rows_at_once;
            const std::int64_t end = std::min(first + rows_at_once, nodes.hi[1] + 1);
            for (std::int64_t y = first; y < end; ++y) {
                coarsener.make_row(y, nodes.lo[2] + piece / pieces);
            }
        },
        stop);
}

}  // namespace

bool coarsen(const CodeVolume& fine, CodeVolume& coarse, const Box& nodes, int level, const Index3& n,
             base::Workers& workers, const std::stop_token& stop) {
    const Index3 last = volume::last_nodes(n, level - 1);
    base::check(coarse.box().contains(nodes) && fine.box().contains(volume::made_from(nodes, last)),
                "nodes are made from all of their finer ones");
    return fine.bits() == 8 ? coarsen_codes<std::uint8_t>(fine, coarse, nodes, last, workers, stop)
                            : coarsen_codes<std::uint16_t>(fine, coarse, nodes, last, workers, stop);
}

}  // namespace shearwater::shear
