// Who holds which place, and where they are.

#include "server/head/roster.h"

#include <gtest/gtest.h>

#include "common/tree/plan.h"

namespace shearwater::head {
namespace {

namespace pb = wire::pb;

TEST(Roster, KnowsWhetherAnybodyIsElsewhere) {
    const volume::Index3 n{32, 32, 32};
    CubeFacts cube;
    cube.lattice = {.n = n, .spacing = {1, 1, 1}};
    constexpr std::uint64_t epoch = 9;
    Roster roster(*tree::make_plan(*tree::full_tree(4, 2), n), cube, epoch, 8);
    EXPECT_FALSE(roster.any_elsewhere());
    pb::Join join;
    join.set_role(pb::ROLE_RENDERER);
    std::uint64_t link = wire::first_accepted;
    for (const char* here : {"127.0.0.1", "::1", "::ffff:127.0.0.1"}) {
        const wire::LinkId id{++link};
        ASSERT_TRUE(roster.join(id, join, {id, pb::ROLE_RENDERER, "name", here}));
        EXPECT_FALSE(roster.any_elsewhere()) << here;
    }
    const wire::LinkId id{++link};
    ASSERT_TRUE(roster.join(id, join, {id, pb::ROLE_RENDERER, "name", "10.1.27.4"}));
    EXPECT_TRUE(roster.any_elsewhere());
    roster.leave(id);
    EXPECT_FALSE(roster.any_elsewhere());
}

}  // namespace
}  // namespace shearwater::head
