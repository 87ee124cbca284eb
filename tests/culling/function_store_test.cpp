// What functions of several bases combine to, block by block, beside the sum that it stands for.

#include "common/culling/function_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "common/culling/rates.h"

namespace shearwater::culling {
namespace {

constexpr double voxel = 0.7;  // the smallest distance of two

FunctionTable random_table(const BlockGrid& grid, const DirectionGrid& directions, unsigned seed) {
    FunctionTable table;
    table.side = directions.side();
    table.blocks = {{0, 0, 0}, grid.counts()};
    table.codes.resize(grid.size() * static_cast<std::size_t>(directions.cells()));
    std::mt19937 random(seed);
    for (std::uint8_t& code : table.codes) {
        code = static_cast<std::uint8_t>(random() % 5 == 0 ? 0 : random() % 256);
    }
    return table;
}

// No code says more than the members do together, and the next one would.
void expect_tight(const view::TransferFunction& tf) {
    const BlockGrid grid({97, 70, 65}, 16);
    const DirectionGrid directions(12);
    base::Workers workers(2);
    FunctionStore store(grid, directions);
    const std::vector<Member> members = members_of(tf);
    ASSERT_EQ(members.size(), tf.opacity_pins.size());
    std::vector<FunctionTable> tables;
    for (std::size_t n = 0; n < members.size(); ++n) {
        tables.push_back(random_table(grid, directions, static_cast<unsigned>(n) + 1));
        store.put({Footprint::column, members[n].basis, 0}, std::make_shared<const FunctionTable>(tables[n]));
    }
    const std::vector<BlockRates> all = store.rates(tf, Kind::opof, 0, voxel);
    const BlockRates& rates = *std::ranges::find(all, Footprint::column, &BlockRates::footprint);
    const Combination combination(members);
    const std::vector<int> cells{0, 7, 30, directions.cells() - 1};
    const auto codes = rates.of(cells, workers);
    ASSERT_EQ(codes.size(), cells.size());
    std::size_t some = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        ASSERT_EQ(codes[c].size(), grid.size());
        for (std::size_t block = 0; block < grid.size(); ++block) {
            std::vector<float> of_members;
            for (std::size_t n = 0; n < members.size(); ++n) {
                const std::uint8_t code =
                    tables[n].codes[static_cast<std::size_t>(cells[c]) * grid.size() + block];
                of_members.push_back(
                    static_cast<float>(tf.density * lifted(rate_of(code), members[n].height, voxel)));
            }
            const float together = combination(of_members);
            const std::uint8_t code = codes[c][block];
            ASSERT_LE(rates.rate[code], together * (1 + 1e-5F)) << block;
            if (code < most_code) {
                ASSERT_GT(rates.rate[code + 1U], together * (1 - 1e-5F)) << block;
            }
            some += code > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(some, grid.size());
}

TEST(FunctionStore, CombinesBasesBlockByBlock) {
    const view::Hat low{0.2, 0, 0.3, 0.4}, high{0.8, 0, 0.3, 0.9}, between{0.5, 0, 0.5, 0.1};
    const auto of = [](std::vector<view::OpacityPin> pins) {
        return view::TransferFunction{.opacity_pins = std::move(pins),
                                      .colour_pins = {{0, {1, 1, 1}}},
                                      .background = {},
                                      .density = 1.5};
    };
    expect_tight(of({low}));
    expect_tight(of({low, high}));
    expect_tight(of({high, low}));
    expect_tight(of({low, between}));
    expect_tight(of({low, between, high}));
}

}  // namespace
}  // namespace shearwater::culling
