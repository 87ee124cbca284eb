// Pictures of a cube that several sub-volumes find the functions of.

#include "common/culling/merge.h"

#include <gtest/gtest.h>

#include <random>

#include "common/culling/function_store.h"
#include "common/culling/rates.h"
#include "renderer/culling/culler.h"
#include "tests/culling/block.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::culling {
namespace {

using volume::Box;
using volume::Index3;

const Index3 n{97, 70, 65};
// Cuts within blocks and on their borders, along every axis.
const std::vector<Box> cut{{{0, 0, 0}, {45, 69, 64}},
                           {{45, 0, 0}, {96, 32, 64}},
                           {{45, 32, 0}, {96, 69, 21}},
                           {{45, 32, 21}, {96, 69, 64}}};

FunctionTable of(test::FloatCube& cube, const std::vector<Box>& boxes, const FunctionKey& key, bool octants) {
    base::Workers workers(2);
    const BlockGrid grid(cube.n());
    const DirectionGrid directions(12);
    std::vector<SubVolume> parts;
    for (const Box& box : boxes) {
        const auto volume = test::bricks_of(cube, box, workers);
        parts.push_back(
            {box,
             std::make_shared<FunctionTable>(functions_of(volume, key, grid, directions, octants, workers)),
             octants ? 4 : std::int64_t{1} << key.level});
    }
    return merged(grid, directions, key.footprint, parts);
}

// No sub-volumes together say more than one that has it all, nor much less where all is alike.
TEST(Merge, OfPartsSaysNoMoreThanTheWhole) {
    test::FloatCube noise = test::noise_cube(n);
    const auto member = members_of(ramp(0.1, 0.1, 0.9, 0.4)).at(0);
    for (const Footprint footprint : {Footprint::column, Footprint::block}) {
        struct From {
            bool octants;
            int level;
        };
        for (const auto& [octants, level] : {From{false, 0}, From{true, 0}, From{false, 1}}) {
            const FunctionKey key{footprint, member.basis, level};
            const FunctionTable whole = of(noise, {volume::whole(n)}, key, octants);
            const FunctionTable parts = of(noise, cut, key, octants);
            ASSERT_EQ(whole.codes.size(), parts.codes.size());
            for (std::size_t i = 0; i < whole.codes.size(); ++i) {
                // Rounded once more.
                ASSERT_LE(parts.codes[i], whole.codes[i] + (footprint == Footprint::block ? 0 : 1)) << i;
            }
        }
    }
}

// Blocks at a cut lose what their lines have on its other side; the others nothing. So it is where the cube
// ends within cells, too.
TEST(Merge, LosesLittleAtCuts) {
    const auto member = members_of(ramp(0, 0.1, 1, 0.1)).at(0);
    const FunctionKey key{Footprint::column, member.basis, 0};
    for (const Index3& many : {Index3{193, 97, 97}, Index3{191, 95, 94}}) {
        test::FloatCube even(many, [](double, double, double) { return 0.5F; });
        const Box all = volume::whole(many);
        Box left = all, right = all;
        left.hi[0] = right.lo[0] = 90;
        const BlockGrid grid(many);
        for (const bool octants : {false, true}) {
            const FunctionTable whole = of(even, {all}, key, octants);
            const FunctionTable parts = of(even, {left, right}, key, octants);
            double lost = 0, at_cut = 0, lost_at_end = 0, at_end = 0;
            for (std::size_t i = 0; i < whole.codes.size(); ++i) {
                const double rate = rate_of(whole.codes[i]), here = rate - rate_of(parts.codes[i]);
                const auto [x, y, z] = grid.at(i % grid.size());
                EXPECT_GT(rate, 0) << i;
                if (x < 1 || x > 3) {
                    EXPECT_EQ(here, 0);
                } else if (x == 2 && y == 1 && z == 1) {
                    at_cut += rate;
                    lost += here;
                } else if (x == 2 && y == 2 && z == 2) {
                    at_end += rate;
                    lost_at_end += here;
                }
            }
            if (!octants) {  // of those that the cut goes through nobody tells
                EXPECT_LT(lost, 0.4 * at_cut);
                EXPECT_LT(lost_at_end, 0.4 * at_end);
            }
        }
    }
}

// What nobody has said has no opacity: neither a sub-volume that is not there, nor cells across a cut.
TEST(Merge, OfSomeIsClearElsewhere) {
    test::FloatCube even(n, [](double, double, double) { return 0.5F; });
    const auto member = members_of(ramp(0, 0.1, 1, 0.1)).at(0);
    for (const Footprint footprint : {Footprint::column, Footprint::block}) {
        const FunctionTable some = of(even, {cut[0]}, {footprint, member.basis, 0}, false);
        const BlockGrid grid(n);
        int found = 0;
        for (std::size_t block = 0; block < grid.size(); ++block) {
            const bool there = grid.at(block)[0] <= 1;  // in part
            for (std::size_t direction = 0; direction < 72; ++direction) {
                const bool opaque = some.codes[direction * grid.size() + block] > 0;
                EXPECT_TRUE(there || !opaque) << block;
                found += opaque ? 1 : 0;
            }
        }
        EXPECT_GT(found, 50);
    }
}

// A finer grid's cells are told what the coarser ones that they lie in are.
TEST(FunctionTable, IsTheSameOverAFinerGrid) {
    FunctionTable table{.blocks = {{0, 0, 0}, {2, 1, 1}}, .side = 4, .codes = {}};
    for (int code = 0; code < 16; ++code) {
        table.codes.push_back(static_cast<std::uint8_t>(code));
    }
    const FunctionTable fine = finer(table, 3);
    const DirectionGrid coarse_grid(4), fine_grid(12);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> slope(-1, 1);
    std::vector<int> in_coarse, in_fine;
    for (int line = 0; line < 200; ++line) {
        const double u = slope(random), v = slope(random);
        coarse_grid.cells_of(line % 3, {{u, u}, {v, v}}, in_coarse);
        fine_grid.cells_of(line % 3, {{u, u}, {v, v}}, in_fine);
        if (in_coarse.size() == 1) {
            for (const int cell : in_fine) {
                EXPECT_EQ(fine.codes.at(static_cast<std::size_t>(cell) * 2),
                          table.codes.at(static_cast<std::size_t>(in_coarse[0]) * 2));
            }
        }
    }
}

TEST(Family, RatesOfPinsApartAddUp) {
    const std::vector<Member> members =
        members_of({.opacity_pins = {view::Hat{0.2, 0, 0.2, 0.5}, view::Hat{0.5, 0, 0.3, 0.5},
                                     view::Hat{0.3, 0, 0.3, 0.5}, view::Flat{0.001}},
                    .colour_pins = {{0, {1, 1, 1}}},
                    .background = {}});
    const Combination combination(members);
    EXPECT_FLOAT_EQ(combination(std::vector{1.0F, 2.0F, 2.5F, 0.1F}), 3.0F);
    EXPECT_FLOAT_EQ(combination(std::vector{1.0F, 2.0F, 3.5F, 0.1F}), 3.5F);
    EXPECT_FLOAT_EQ(combination(std::vector{1.0F, 2.0F, 3.5F, 9.0F}), 9.0F);
}

// What several bases combine to is kept as the greatest codes below it.
TEST(Family, CombinedCodesAreTheGreatestBelow) {
    const view::TransferFunction tf{.opacity_pins = {view::Hat{0.2, 0, 0.2, 0.9}, view::Hat{0.5, 0, 0.3, 0.4},
                                                     view::Hat{0.3, 0, 0.3, 0.01}},
                                    .colour_pins = {{0, {1, 1, 1}}},
                                    .background = {}};
    const BlockGrid grid({161, 161, 161});
    const DirectionGrid directions(4);
    FunctionStore store(grid, directions);
    std::mt19937 random(5);
    std::vector<std::shared_ptr<FunctionTable>> tables;
    const std::vector<Member> members = members_of(tf);
    for (const Member& member : members) {
        tables.push_back(std::make_shared<FunctionTable>(FunctionTable{{{}, grid.counts()}, 4, {}}));
        for (std::size_t entry = 0; entry < grid.size() * 8; ++entry) {
            tables.back()->codes.push_back(static_cast<std::uint8_t>(random()));
        }
        store.put({Footprint::column, member.basis, 0}, tables.back());
    }
    base::Workers workers(2);
    const BlockRates rates = store.rates(tf, Kind::opof, 0, 2).back();
    const std::vector cells{6, 1};
    const auto codes = rates.of(cells, workers);
    const Combination combination(members);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        for (std::size_t block = 0; block < grid.size(); ++block) {
            std::vector<float> each;
            for (std::size_t m = 0; m < members.size(); ++m) {
                const int code = tables[m]->codes[static_cast<std::size_t>(cells[c]) * grid.size() + block];
                each.push_back(static_cast<float>(lifted(rate_of(code), members[m].height, 2)));
            }
            const float rate = combination(each);
            const std::size_t code = codes[c][block];
            EXPECT_LE(rates.rate[code], rate);
            EXPECT_TRUE(code == 255 || rates.rate[code + 1] > rate * (1 - 1e-5F)) << code;
        }
    }
}

// It multiplies all extinctions alike, so that no function is another one for it.
TEST(Family, DensityMultipliesRatesAndNeedsNoOtherFunction) {
    view::TransferFunction tf{
        .opacity_pins = {view::Hat{0.2, 0, 0.2, 0.9}}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}};
    view::TransferFunction dense = tf;
    dense.density = 3;
    EXPECT_EQ(members_of(dense), members_of(tf));
    const BlockGrid grid({161, 161, 161});
    FunctionStore store(grid, DirectionGrid(4));
    const auto table = std::make_shared<FunctionTable>(FunctionTable{{{}, grid.counts()}, 4, {}});
    table->codes.assign(grid.size() * 8, 200);
    const auto put = [&](const Member& member) { store.put({Footprint::column, member.basis, 0}, table); };
    put(members_of(tf)[0]);
    const auto thin = store.rates(tf, Kind::opof, 0, 1).back().rate;
    const auto thick = store.rates(dense, Kind::opof, 0, 1).back().rate;
    for (std::size_t code = 0; code < thin.size(); ++code) {
        EXPECT_FLOAT_EQ(thick[code], 3 * thin[code]);
    }
    // And of several pins together.
    for (view::TransferFunction* of : {&tf, &dense}) {
        of->opacity_pins.emplace_back(view::Hat{0.6, 0, 0.2, 0.01});
    }
    put(members_of(tf)[1]);
    base::Workers workers(1);
    const auto rate_with = [&](const view::TransferFunction& by) {
        const std::vector cells{0};
        const BlockRates rates = store.rates(by, Kind::opof, 0, 1).back();
        return rates.rate[rates.of(cells, workers)[0][0]];
    };
    const auto wanted = static_cast<float>(lifted(rate_of(200), 0.9, 1) + lifted(rate_of(200), 0.01, 1));
    EXPECT_LE(rate_with(tf), wanted);
    EXPECT_LE(rate_with(dense), 3 * wanted);
    EXPECT_GT(rate_with(dense), 2.5F * rate_with(tf));
}

// Whatever values a line meets: the mean extinction of a pin is at least what its mean at the least height is
// lifted to, exactly that where all are alike, and rises with it.
TEST(Family, LiftsLeastHeightsToOthers) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> share(0, 1);
    for (int trial = 0; trial < 500; ++trial) {
        const double height = trial == 0 ? 1 : least_height + (1 - least_height) * share(random);
        double low = 0, high = 0;
        const int samples = 1 + trial % 20;
        for (int sample = 0; sample < samples; ++sample) {
            const double value = std::pow(share(random), 3);
            low += -std::log1p(-least_height * value) / least_height / samples;
            high += -std::log1p(-height * value) / samples;
        }
        const double bound = lifted(low, height, 1);
        EXPECT_LE(bound, high * (1 + 1e-9));
        EXPECT_GE(bound, low * height * (1 - 1e-9));
        EXPECT_GE(bound, samples > 1 ? 0 : high * (1 - 1e-9));
        EXPECT_LE(lifted(0.9 * low, height, 1), bound);
        EXPECT_DOUBLE_EQ(lifted(low, height, 3), 3 * bound);
    }
}

// The bound, at every value and for every height: sums of pins apart below the transfer function.
TEST(Family, IsBelowTheTransferFunction) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> share(0, 1);
    for (int trial = 0; trial < 200; ++trial) {
        view::TransferFunction tf{.opacity_pins = {}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}};
        for (int pin = 0; pin < 4; ++pin) {
            tf.opacity_pins.push_back(view::Hat{share(random), 0.1 * share(random), 0.1 + 0.3 * share(random),
                                                0.002 + 0.99 * share(random)});
        }
        tf.opacity_pins.push_back(
            view::Ramp{0.5 * share(random), 0, 0.6 + 0.3 * share(random), share(random)});
        tf.opacity_pins.push_back(view::Blank{0.3, 0.3 + 0.1 * share(random)});
        const std::vector<Member> members = members_of(tf);
        const Combination combination(members);
        for (double s = 0; s <= 1; s += 1.0 / 256) {
            std::vector<float> rates;
            for (const Member& member : members) {
                const double least = at_height(member.basis, least_height).extinction(s) / least_height;
                const double rate = lifted(least, member.height, 1);
                EXPECT_LE(rate, at_height(member.basis, member.height).extinction(s) * (1 + 1e-9));
                rates.push_back(static_cast<float>(rate));
            }
            EXPECT_LE(static_cast<double>(combination(rates)), tf.extinction(s) * (1 + 1e-6) + 1e-9) << s;
        }
    }
}

}  // namespace
}  // namespace shearwater::culling
