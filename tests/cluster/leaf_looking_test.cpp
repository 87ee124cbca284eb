// What a renderer does to say what a part of a picture shows, event by event.

#include <gtest/gtest.h>

#include "protocol/wire/convert.h"
#include "protocol/wire/convert_culling.h"
#include "renderer/leaf/leaf.h"

namespace shearwater::leaf {
namespace {

namespace pb = wire::pb;

constexpr view::Lattice looked_lattice{.n = {70, 40, 33}, .spacing = {1, 1, 1}};
const culling::BlockGrid looked_grid(looked_lattice.n);

class LeafLookingTest : public testing::Test {
  protected:
    LeafLookingTest() {
        take(leaf_.start());
        take(leaf_.handle(wire::LinkUp{dialled_, pb::ROLE_RENDERER, "server", "127.0.0.1"}, now_));
        pb::Assign assign;
        assign.set_epoch(1);
        assign.set_place(4);
        *assign.mutable_box() = wire::to_wire(volume::whole(looked_lattice.n));
        assign.mutable_cube()->set_path("/cube");
        *assign.mutable_cube()->mutable_lattice() = wire::to_wire(looked_lattice);
        assign.set_bits(8);
        *assign.mutable_mapping() = wire::to_wire(volume::Mapping{.lo = 0, .hi = 5});
        take(leaf_.handle(wire::Received{dialled_, wire::message(assign)}, now_));
        parent_ = dialled_;
        take(leaf_.handle(wire::LinkUp{parent_, pb::ROLE_CHILD, "parent", "127.0.0.1"}, now_));
    }
    void load() {
        take(leaf_.handle(Loaded{load_, {}}, now_));
        ASSERT_EQ(leaf_.phase(), pb::PHASE_READY);
    }
    void receive(wire::Message message) {
        take(leaf_.handle(wire::Received{parent_, std::move(message)}, now_));
    }
    void want(std::initializer_list<std::uint64_t> numbers) {
        pb::WantFunctions want;
        for (const std::uint64_t number : numbers) {
            want.add_wants()->set_number(number);
            *want.mutable_wants(want.wants_size() - 1)->mutable_key() = wire::to_wire(key(number));
        }
        want.set_block_edge(32);
        want.set_side(36);
        receive(wire::message(want));
    }
    static culling::FunctionKey key(std::uint64_t number) {
        return {
            culling::Footprint::column, {view::Hat{0.05 * static_cast<double>(number), 0, 0.1, 1}, {}}, 0};
    }
    static culling::FunctionTable table(int side = culling::DirectionGrid::default_side) {
        culling::FunctionTable table{.blocks = {{}, looked_grid.counts()}, .side = side, .codes = {}};
        table.codes.resize(
            looked_grid.size() * static_cast<std::size_t>(culling::DirectionGrid(side).cells()), 7);
        return table;
    }
    void give(std::uint64_t request, std::uint64_t number) {
        receive(wire::give_functions(request, key(number), number, table(), 0));
    }
    void look(std::uint64_t request, std::vector<std::uint64_t> functions,
              std::vector<int> places = {2, 4, 9}) {
        const auto f = view::factorise(view::camera_on({}, looked_lattice), {20, 20}, looked_lattice, {});
        receive(wire::message(wire::to_wire(wire::LookRequest{.request = request,
                                                              .factorisation = f,
                                                              .tf = view::default_transfer_function(),
                                                              .settings = {culling::Kind::opof, 0.95},
                                                              .functions = std::move(functions),
                                                              .places = std::move(places)})));
    }
    void take(Effects effects) {
        for (const wire::NetEffect& effect : effects.net) {
            if (const auto* dial = std::get_if<wire::Dial>(&effect)) {
                dialled_ = dial->link;
            } else if (const auto* close = std::get_if<wire::CloseLink>(&effect)) {
                closed_.push_back(close->reason);
            } else if (const auto* send = std::get_if<wire::Send>(&effect)) {
                if (const auto* replied = std::get_if<pb::Replied>(&send->message.body)) {
                    replies_.push_back(*wire::reply_from(*replied));
                }
            }
        }
        for (Effect& effect : effects.jobs) {
            if (const auto* load = std::get_if<Load>(&effect)) {
                load_ = load->job;
            } else if (const auto* learn = std::get_if<Learn>(&effect)) {
                learns_.push_back(*learn);
            } else if (const auto* look = std::get_if<Look>(&effect)) {
                looks_.push_back(*look);
            } else if (const auto* forget = std::get_if<node::Forget>(&effect)) {
                forgotten_.push_back(forget->key);
            }
        }
    }
    // The newest reply, if there have been so many.
    const wire::Reply& reply(std::size_t count) {
        EXPECT_EQ(replies_.size(), count);
        static const wire::Reply none;
        return replies_.empty() ? none : replies_.back();
    }

    wire::Time now_ = wire::Time{} + std::chrono::seconds(1000);
    Leaf leaf_{{.server = {"host", 1}}};
    wire::LinkId dialled_{}, parent_{};
    Job load_ = 0;
    std::vector<pb::Reason> closed_;
    std::vector<wire::Reply> replies_;
    std::vector<Learn> learns_;
    std::vector<Look> looks_;
    std::vector<culling::FunctionKey> forgotten_;
};

TEST_F(LeafLookingTest, LooksAtItsPartByWhatItHasBeenGiven) {
    load();
    want({5});
    give(11, 5);
    ASSERT_EQ(learns_.size(), 1U);
    EXPECT_TRUE(replies_.empty()) << "not before it has learnt it";
    take(leaf_.handle(Learned{learns_[0].job}, now_));
    EXPECT_EQ(reply(1).request, 11U);
    EXPECT_FALSE(reply(1).incomplete);

    look(12, {5});
    ASSERT_EQ(looks_.size(), 1U);
    EXPECT_EQ(looks_[0].look.part.part, 1);
    EXPECT_EQ(looks_[0].look.part.parts, 3);
    culling::BlockSet seen(looked_grid.size());
    seen.bytes()[3] = 1;
    take(leaf_.handle(Looked{looks_[0].job, {12, {looked_grid, seen}}}, now_));
    EXPECT_EQ(reply(2).request, 12U);
    EXPECT_FALSE(reply(2).incomplete);
    EXPECT_EQ(wire::blocks_from(reply(2).visible, looked_grid.size()), seen);
    take(leaf_.handle(Looked{looks_[0].job, {12, {looked_grid, seen}}}, now_));
    EXPECT_EQ(replies_.size(), 2U) << "once";
}

TEST_F(LeafLookingTest, LeavesToOthersWhatOnlyTheyAreAskedFor) {
    load();
    look(12, {}, {2, 9});
    EXPECT_FALSE(reply(1).incomplete);
    EXPECT_TRUE(reply(1).visible.empty());
    EXPECT_TRUE(looks_.empty());
}

TEST_F(LeafLookingTest, SaysSoIfItCannot) {
    give(11, 5);
    EXPECT_TRUE(reply(1).incomplete) << "nothing is loaded";
    look(12, {});
    EXPECT_TRUE(reply(2).incomplete);
    load();
    want({5});
    look(13, {5});
    EXPECT_TRUE(reply(3).incomplete) << "not given";
    receive(wire::give_functions(14, key(5), 5, table(12), 0));
    EXPECT_TRUE(reply(4).incomplete) << "over other directions";
    culling::FunctionTable other = table();
    ++other.blocks.hi[0];
    other.codes.resize(other.block_count() * 648);
    receive(wire::give_functions(15, key(5), 5, other, 0));
    EXPECT_TRUE(reply(5).incomplete) << "of other blocks";
    EXPECT_TRUE(learns_.empty() && looks_.empty() && closed_.empty());
}

TEST_F(LeafLookingTest, ForgetsWhatIsNoLongerWanted) {
    load();
    want({5, 6});
    give(11, 5);
    give(12, 6);
    want({6});
    ASSERT_EQ(forgotten_.size(), 1U);
    EXPECT_EQ(forgotten_[0], key(5));
    look(13, {5, 6});
    EXPECT_TRUE(reply(1).incomplete);
    look(14, {6});
    EXPECT_EQ(looks_.size(), 1U);
    // A parent that comes back numbers anew.
    take(leaf_.handle(wire::LinkDown{parent_, pb::REASON_LOST, "gone"}, now_));
    EXPECT_EQ(forgotten_.size(), 2U);
    take(leaf_.handle(Looked{looks_[0].job, {14, {looked_grid, culling::BlockSet(looked_grid.size())}}},
                      now_));
    EXPECT_EQ(replies_.size(), 1U) << "nobody waits for it";
}

TEST_F(LeafLookingTest, ForgetsAllWhenValuesAreMappedAnew) {
    load();
    want({5});
    give(11, 5);
    pb::SetMapping set;
    *set.mutable_mapping() = wire::to_wire(volume::Mapping{.lo = 1, .hi = 2});
    receive(wire::message(set));
    EXPECT_EQ(forgotten_.size(), 1U);
    load();
    look(12, {5});
    EXPECT_TRUE(reply(1).incomplete);
}

TEST_F(LeafLookingTest, TakesNoMoreRequestsThanItAnswers) {
    load();
    for (std::uint64_t n = 0; n < Leaf::most_replying + 5; ++n) {
        look(n, {});
    }
    EXPECT_EQ(looks_.size(), Leaf::most_replying);
    EXPECT_TRUE(reply(5).incomplete);
}

TEST_F(LeafLookingTest, ClosesTheLinkOverNonsense) {
    load();
    pb::Look nothing;
    receive(wire::message(nothing));
    ASSERT_EQ(closed_.size(), 1U);
    EXPECT_EQ(closed_[0], pb::REASON_INVALID);
}

}  // namespace
}  // namespace shearwater::leaf
