// Which cells of a piece may be seen, beside the opacity of everything between their corners' codes.

#include "renderer/shear/plane_cells.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "renderer/shear/kernel.h"

namespace shearwater::shear {
namespace {

// Random codes, most of them low.
template <class Code>
struct RandomPiece {
    std::int64_t across, down, count;
    std::vector<Code> codes;

    RandomPiece(std::int64_t across_, std::int64_t down_, std::int64_t count_, std::mt19937& random)
        : across(across_),
          down(down_),
          count(count_),
          codes(static_cast<std::size_t>(across * down * count) + voxel_padding) {
        std::uniform_int_distribution<int> any(0, sizeof(Code) == 1 ? 255 : 65535), one_of(0, 19);
        // What lies beyond is all there can be, and must not be taken for a part of it.
        std::ranges::fill(codes, std::numeric_limits<Code>::max());
        for (std::int64_t n = 0; n < across * down * count; ++n) {
            const int code = any(random);
            codes[static_cast<std::size_t>(n)] = static_cast<Code>(one_of(random) == 0 ? code : code / 8);
        }
    }

    std::int64_t cells_across() const { return std::max<std::int64_t>(across - 1, 1); }
    std::int64_t cells_down() const { return std::max<std::int64_t>(down - 1, 1); }

    // The least and the greatest code about a cell on a plane, or between two.
    std::pair<Code, Code> about(std::int64_t u, std::int64_t v, std::int64_t first, std::int64_t last) const {
        Code least = std::numeric_limits<Code>::max(), most = 0;
        for (std::int64_t w = first; w <= last; ++w) {
            for (std::int64_t j = v; j <= std::min(v + 1, down - 1); ++j) {
                for (std::int64_t i = u; i <= std::min(u + 1, across - 1); ++i) {
                    const Code code = codes[static_cast<std::size_t>((w * down + j) * across + i)];
                    least = std::min(least, code);
                    most = std::max(most, code);
                }
            }
        }
        return {least, most};
    }
};

struct CellBox {
    std::int64_t fast_first = 1000, fast_end = 0, slow_first = 1000, slow_end = 0;

    void add(std::int64_t u, std::int64_t v) {
        fast_first = std::min(fast_first, u);
        fast_end = std::max(fast_end, u + 1);
        slow_first = std::min(slow_first, v);
        slow_end = std::max(slow_end, v + 1);
    }
    CellBox with(const CellBox& other) const {
        return {std::max(fast_first, other.fast_first), std::min(fast_end, other.fast_end),
                std::max(slow_first, other.slow_first), std::min(slow_end, other.slow_end)};
    }
};

template <class Code>
void expect_all_that_may_be_seen(const RandomPiece<Code>& piece, const view::TransferFunction& tf) {
    const OpacityTable table(tf, std::numeric_limits<Code>::max());
    const auto [first, last] = table.opaque_codes();
    std::vector<PlaneCells> found(static_cast<std::size_t>(2 * piece.count));
    find_opaque_cells<Code>({piece.codes.data(), piece.across, piece.down, piece.count}, table.opaque_codes(),
                            found);
    for (std::int64_t at = 0; at < 2 * piece.count - 1; ++at) {
        const PlaneCells& cells = found[static_cast<std::size_t>(at)];
        CellBox high, low;
        for (std::int64_t v = 0; v < piece.cells_down(); ++v) {
            for (std::int64_t u = 0; u < piece.cells_across(); ++u) {
                const auto [least, most] = piece.about(u, v, at / 2, (at + 1) / 2);
                if (most >= first) {
                    high.add(u, v);
                }
                if (least <= last) {
                    low.add(u, v);
                }
                const bool is_told = cells.fast_first <= u && u < cells.fast_end && cells.slow_first <= v &&
                                     v < cells.slow_end;
                ASSERT_TRUE(is_told || !table.any_opacity(least, most))
                    << piece.across << " x " << piece.down << ", " << at << ": " << u << ", " << v;
            }
        }
        const CellBox box = high.with(low);
        ASSERT_EQ(cells.empty(), box.fast_first >= box.fast_end || box.slow_first >= box.slow_end);
        if (!cells.empty()) {
            ASSERT_EQ(cells.fast_first, box.fast_first);
            ASSERT_EQ(cells.fast_end, box.fast_end);
            ASSERT_EQ(cells.slow_first, box.slow_first);
            ASSERT_EQ(cells.slow_end, box.slow_end);
        }
    }
}

view::TransferFunction one_pin(view::OpacityPin pin) {
    return {.opacity_pins = {pin}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}};
}

TEST(PlaneCells, AreThoseThatMayBeSeen) {
    const std::array<view::TransferFunction, 5> functions{
        one_pin(view::Ramp{0.7, 0, 1, 0.5}), one_pin(view::Hat{0.5, 0.1, 0.1, 0.5}),
        one_pin(view::Ramp{0, 0.5, 0.05, 0}), one_pin(view::Flat{0.1}), one_pin(view::Flat{0})};
    std::mt19937 random(3);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        for (const std::int64_t across : {1, 2, 5, 9, 16, 17, 64, 65, 129}) {
            for (const std::int64_t down : {1, 5, 9, 129}) {
                for (const std::int64_t count : {1, 5}) {
                    for (const view::TransferFunction& tf : functions) {
                        expect_all_that_may_be_seen(RandomPiece<std::uint8_t>(across, down, count, random),
                                                    tf);
                        expect_all_that_may_be_seen(RandomPiece<std::uint16_t>(across, down, count, random),
                                                    tf);
                    }
                }
            }
        }
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace shearwater::shear
