// Deciding what is visible in parts of the image: together they say what one pass says of all of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "common/culling/function_store.h"
#include "common/culling/visible_blocks.h"
#include "deploy/bench/culled_pictures.h"

namespace shearwater::culling {
namespace {

class ImageParts : public testing::Test {
  protected:
    inline static const view::Lattice lattice{.n = {300, 270, 410}, .spacing = {1, 1, 1}};
    inline static const BlockGrid grid{lattice.n};
    inline static const DirectionGrid directions{12};
    inline static const view::TransferFunction tf{.opacity_pins = {view::Flat{0.7}},
                                                  .colour_pins = {{0, {1, 1, 1}}}};

    ImageParts() {
        for (const Footprint footprint : {Footprint::block, Footprint::column}) {
            FunctionTable table{.blocks = {{}, grid.counts()}, .side = directions.side(), .codes = {}};
            table.codes.resize(grid.size() * static_cast<std::size_t>(directions.cells()));
            for (std::uint8_t& code : table.codes) {
                code = static_cast<std::uint8_t>(random_() >> 7);
            }
            store_.put({footprint, members_of(tf)[0].basis, 0},
                       std::make_shared<const FunctionTable>(std::move(table)));
        }
    }

    BlockSet visible(const view::Factorisation& f, Kind kind, const ImagePart& part) {
        return visible_blocks(f, grid, store_.rates(tf, kind, 0, 1), {.kind = kind, .threshold = 0.95},
                              workers_, part);
    }

    base::Workers workers_{2};
    std::mt19937 random_{5};
    FunctionStore store_{grid, directions};
};

TEST_F(ImageParts, TogetherSeeWhatTheImageSees) {
    std::size_t hidden = 0;
    for (int n = 0; n < 40; ++n) {
        const Kind kind = std::array{Kind::pof, Kind::opof_linear, Kind::opof}[random_() % 3];
        const auto f = view::factorise(bench::camera_at_random(random_, lattice), {90, 70}, lattice,
                                       {.level_of_detail = false});
        const BlockSet whole = visible(f, kind, {});
        hidden += whole.size() - whole.count();
        for (const int parts : {2, 3, 7, 400}) {
            BlockSet seen(grid.size());
            for (int part = 0; part < parts; ++part) {
                const BlockSet of = visible(f, kind, {part, parts});
                std::ranges::transform(seen.bytes(), of.bytes(), seen.bytes().begin(), std::bit_or());
            }
            EXPECT_EQ(seen, whole) << parts << " parts of view " << n;
        }
    }
    EXPECT_GT(hidden, 0U);
}

// A cube in the middle of a picture is not left to those who have the picture's middle.
TEST_F(ImageParts, HaveAboutAsMuchToLookAtEach) {
    const auto f = view::factorise(view::camera_on({20, 15, 2500, {}}, lattice), {400, 400}, lattice,
                                   {.level_of_detail = false});
    constexpr int parts = 4;
    for (int part = 0; part < parts; ++part) {
        const double share = static_cast<double>(visible(f, Kind::opof, {part, parts}).count()) /
                             static_cast<double>(visible(f, Kind::opof, {}).count());
        EXPECT_GT(share, 0.15) << part;
        EXPECT_LT(share, 0.45) << part;
    }
}

}  // namespace
}  // namespace shearwater::culling
