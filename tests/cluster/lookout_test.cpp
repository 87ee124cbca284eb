// What a node knows of blocks' opacity: renderers' functions become the cube's, go on to another node piece
// by piece, and both see the same.

#include "protocol/node/lookout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace shearwater::node {
namespace {

class LookoutTest : public testing::Test {
  protected:
    inline static const view::Lattice lattice{.n = {97, 161, 129}, .spacing = {1, 1, 1}};
    inline static const culling::BlockGrid grid{lattice.n};
    inline static const view::TransferFunction tf{.opacity_pins = {view::Flat{0.8}},
                                                  .colour_pins = {{0, {1, 1, 1}}}};
    inline static const culling::FunctionKey key{culling::Footprint::block, culling::members_of(tf)[0].basis,
                                                 0};

    // The functions of two renderers, that share the cube along its second axis.
    void learn_of_two(Lookout& lookout) {
        std::mt19937 random(4);
        const volume::Box whole = volume::whole(lattice.n);
        for (int place = 1; place <= 2; ++place) {
            volume::Box box = whole;
            (place == 1 ? box.hi : box.lo)[1] = 64;
            culling::FunctionTable table{
                .blocks = grid.blocks_of(box), .side = culling::DirectionGrid::default_side, .codes = {}};
            table.codes.resize(table.block_count() * 648);
            std::ranges::generate(table.codes,
                                  [&] { return static_cast<std::uint8_t>(150 + random() % 106); });
            for (const wire::Message& message : wire::functions_messages(7, place, false, table)) {
                lookout.learn({key, lattice.n, box, *wire::functions_from(message), message.payload});
            }
        }
    }
    culling::BlockSet seen(Lookout& lookout, const culling::ImagePart& part = {}) {
        const auto f = view::factorise(view::camera_on({}, lattice), {60, 50}, lattice, {});
        const Looked looked =
            lookout.look({5, f, tf, {.kind = culling::Kind::opof, .threshold = 0.9}, part}, workers_);
        EXPECT_EQ(looked.number, 5U);
        return looked.visible.blocks;
    }

    base::Workers workers_{2};
};

TEST_F(LookoutTest, SeesAllAsLongAsItKnowsNothing) {
    Lookout lookout;
    EXPECT_EQ(seen(lookout).count(), grid.size());
    EXPECT_FALSE(lookout.give(1, key, 7, 0));
    learn_of_two(lookout);
    EXPECT_LT(seen(lookout).count(), grid.size());
    lookout.forget({key});
    EXPECT_EQ(seen(lookout).count(), grid.size());
    EXPECT_FALSE(lookout.give(1, key, 7, 0));
}

TEST_F(LookoutTest, GivesAnotherWhatItKnows) {
    Lookout one, other;
    learn_of_two(one);
    int next = 0;
    while (next < 648) {
        const auto message = one.give(3, key, 7, next);
        ASSERT_TRUE(message);
        const auto given = *wire::given_functions_from(*message);
        EXPECT_EQ(given.key, key);
        ASSERT_EQ(given.part.first_direction, next);
        EXPECT_EQ(seen(other).count(), grid.size()) << "not before it has all";
        other.learn({given.key, lattice.n, volume::whole(lattice.n), given.part, message->payload});
        next += given.part.directions;
    }
    EXPECT_EQ(seen(other), seen(one));
}

TEST_F(LookoutTest, LooksAtThePartThatItIsAskedFor) {
    Lookout lookout;
    learn_of_two(lookout);
    culling::BlockSet together(grid.size());
    for (int part = 0; part < 3; ++part) {
        const culling::BlockSet own = seen(lookout, {part, 3});
        EXPECT_LT(own.count(), seen(lookout).count());
        std::ranges::transform(together.bytes(), own.bytes(), together.bytes().begin(), std::bit_or());
    }
    EXPECT_EQ(together, seen(lookout));
}

}  // namespace
}  // namespace shearwater::node
