// What a renderer does with its sketch: event by event, the server and the jobs being the test.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/wire/convert.h"
#include "renderer/leaf/leaf.h"

namespace shearwater::leaf {
namespace {

namespace pb = wire::pb;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr view::Lattice lattice{.n = {70, 9, 11}, .spacing = {1, 1, 1}};
const volume::Mapping by_sketch{.lo = 1, .hi = 3}, by_cube{.lo = 0, .hi = 5};

class LeafSketchTest : public testing::Test {
  protected:
    LeafSketchTest() {
        take(leaf_.start());
        take(leaf_.handle(wire::LinkUp{dialled_.back(), pb::ROLE_RENDERER, "server", "127.0.0.1"}, now_));
        server_ = dialled_.back();
    }
    static pb::Assign order(std::uint32_t level, const std::optional<volume::Mapping>& mapping = {}) {
        pb::Assign assign;
        assign.set_epoch(1);
        assign.set_place(4);
        *assign.mutable_box() = wire::to_wire(volume::whole(lattice.n));
        assign.mutable_cube()->set_path("/cube");
        *assign.mutable_cube()->mutable_lattice() = wire::to_wire(lattice);
        assign.set_bits(8);
        assign.set_sketch_level(level);
        if (mapping) {
            *assign.mutable_mapping() = wire::to_wire(*mapping);
        }
        return assign;
    }
    void assign(const pb::Assign& order) { receive(server_, order); }
    void adopt() {
        parent_ = dialled_.back();
        take(leaf_.handle(wire::LinkUp{parent_, pb::ROLE_CHILD, "parent", "127.0.0.1"}, now_));
    }
    template <class T>
    void receive(wire::LinkId link, T body) {
        take(leaf_.handle(wire::Received{link, wire::message(std::move(body))}, now_));
    }
    void tell(JobEvent event) { take(leaf_.handle(std::move(event), now_)); }
    static volume::Histogram histogram() {
        volume::Histogram values;
        values.add(2.0F);
        return values;
    }
    static pb::Render render(std::uint64_t frame, int level, const std::optional<volume::Mapping>& sketch) {
        view::Factorisation factorisation =
            view::factorise(view::camera_on({}, lattice), {20, 20}, lattice, {});
        factorisation.slice_exponent = level;
        pb::Render render;
        render.set_frame(frame);
        *render.mutable_factorisation() = wire::to_wire(factorisation);
        *render.mutable_transfer_function() = wire::to_wire(view::default_transfer_function());
        if (sketch) {
            *render.mutable_sketch() = wire::to_wire(*sketch);
        }
        return render;
    }
    void load() {
        const auto mapping = [] {
            pb::SetMapping set;
            *set.mutable_mapping() = wire::to_wire(by_cube);
            return set;
        };
        tell(Counted{counts_.back().job, histogram()});
        receive(parent_, mapping());
        tell(Loaded{loads_.back().job, {}});
        ASSERT_EQ(leaf_.phase(), pb::PHASE_READY);
    }
    void take(Effects effects) {
        for (const wire::NetEffect& effect : effects.net) {
            if (const auto* dial = std::get_if<wire::Dial>(&effect)) {
                dialled_.push_back(dial->link);
            } else if (const auto* close = std::get_if<wire::CloseLink>(&effect)) {
                closed_.push_back(close->reason);
            } else if (const auto* send = std::get_if<wire::Send>(&effect)) {
                if (const auto* report = std::get_if<pb::HistogramReport>(&send->message.body)) {
                    reports_.push_back(report->sketch());
                } else if (const auto* windows = std::get_if<pb::Windows>(&send->message.body)) {
                    (windows->missing_size() > 0 ? absent_ : answered_).push_back(windows->frame());
                }
            }
        }
        for (Effect& effect : effects.jobs) {
            if (auto* count = std::get_if<Count>(&effect)) {
                counts_.push_back(*count);
            } else if (auto* load = std::get_if<Load>(&effect)) {
                loads_.push_back(*load);
            } else if (auto* draw = std::get_if<Draw>(&effect)) {
                draws_.push_back(*draw);
            } else if (auto* stop = std::get_if<Stop>(&effect)) {
                stopped_.push_back(stop->job);
            }
        }
    }

    wire::Time now_ = wire::Time{} + std::chrono::seconds(1000);
    Leaf leaf_{{.server = {"host", 1}}};
    wire::LinkId server_{}, parent_{};
    std::vector<wire::LinkId> dialled_;
    std::vector<pb::Reason> closed_;
    std::vector<bool> reports_;
    std::vector<std::uint64_t> absent_, answered_;
    std::vector<Count> counts_;
    std::vector<Load> loads_;
    std::vector<Draw> draws_;
    std::vector<Job> stopped_;
};

TEST_F(LeafSketchTest, BeginsTheFirstPassWhicheverItIs) {
    assign(order(1));
    ASSERT_THAT(counts_, SizeIs(1));
    EXPECT_EQ(counts_[0].sketch_level, 1);
    adopt();
    tell(Sketched{counts_[0].job, histogram()});
    EXPECT_THAT(reports_, ElementsAre(true));
    EXPECT_EQ(leaf_.phase(), pb::PHASE_COUNTING);
    load();
    EXPECT_THAT(reports_, ElementsAre(true, false));
    EXPECT_EQ(loads_[0].sketch_level, 0) << "there is one";
}

TEST_F(LeafSketchTest, BeginsTheLoadWhereLimitsAreKnown) {
    assign(order(1, by_cube));
    EXPECT_THAT(counts_, IsEmpty());
    ASSERT_THAT(loads_, SizeIs(1));
    EXPECT_EQ(loads_[0].sketch_level, 1);
}

TEST_F(LeafSketchTest, LoadsAnewWhereAnotherNumberOfCopiesIsAskedFor) {
    assign(order(1, by_cube));
    ASSERT_THAT(loads_, SizeIs(1));
    EXPECT_EQ(loads_[0].share.copies, 1);
    pb::Assign two = order(1, by_cube);
    two.set_copies(2);
    assign(two);
    ASSERT_THAT(loads_, SizeIs(2));
    EXPECT_EQ(loads_[1].share.copies, 2);
}

TEST_F(LeafSketchTest, IsToldToAParentThatComesLater) {
    assign(order(1));
    tell(Sketched{counts_[0].job, histogram()});
    EXPECT_THAT(reports_, IsEmpty());
    adopt();
    EXPECT_THAT(reports_, ElementsAre(true));
}

TEST_F(LeafSketchTest, IsDrawnWhileTheRestIsCountedAndLoaded) {
    assign(order(1));
    adopt();
    receive(parent_, render(1, 1, by_sketch));
    EXPECT_THAT(absent_, ElementsAre(1)) << "there is none yet";
    tell(Sketched{counts_[0].job, histogram()});
    receive(parent_, render(2, 1, by_sketch));
    ASSERT_THAT(draws_, SizeIs(1));
    EXPECT_EQ(draws_[0].sketch, by_sketch);
    tell(Drawn{draws_[0].job, wire::windows_message(2, 1, {}), true});
    EXPECT_THAT(answered_, ElementsAre(2));
    receive(parent_, render(3, 0, {}));
    EXPECT_THAT(absent_, ElementsAre(1, 3)) << "the cube is not there";
    load();
    receive(parent_, render(4, 1, by_cube));
    ASSERT_THAT(draws_, SizeIs(2)) << "others may not be ready";
    tell(Drawn{draws_[1].job, wire::windows_message(4, 1, {}), true});
    receive(parent_, render(5, 0, {}));
    ASSERT_THAT(draws_, SizeIs(3));
    EXPECT_FALSE(draws_[2].sketch);
    receive(parent_, render(6, 1, by_cube));
    EXPECT_THAT(absent_, ElementsAre(1, 3, 6)) << "with the cube drawn, it is gone";
}

TEST_F(LeafSketchTest, UnderWayIsNotStoppedByTheFirstLoad) {
    assign(order(1));
    adopt();
    tell(Sketched{counts_[0].job, histogram()});
    receive(parent_, render(1, 1, by_sketch));
    receive(parent_, render(2, 1, by_sketch));
    load();
    EXPECT_THAT(stopped_, IsEmpty());
    tell(Drawn{draws_[0].job, wire::windows_message(1, 1, {}), true});
    EXPECT_THAT(draws_, SizeIs(2));
}

// Whatever is drawn or waits is answered as missing before what it would be drawn from goes.
TEST_F(LeafSketchTest, OfAnotherShareIsGivenUp) {
    assign(order(1));
    adopt();
    tell(Sketched{counts_[0].job, histogram()});
    receive(parent_, render(1, 1, by_sketch));
    receive(parent_, render(2, 1, by_sketch));
    pb::Assign another = order(1);
    *another.mutable_box() = wire::to_wire(volume::Box{{0, 0, 0}, {35, 8, 10}});
    assign(another);
    EXPECT_THAT(stopped_, ElementsAre(counts_[0].job, draws_[0].job));
    EXPECT_THAT(absent_, ElementsAre(2, 1));
    receive(parent_, render(3, 1, by_sketch));
    EXPECT_THAT(absent_, ElementsAre(2, 1, 3));
    EXPECT_THAT(draws_, SizeIs(1));
    EXPECT_EQ(counts_.back().sketch_level, 1);
}

TEST_F(LeafSketchTest, FramesOfTheCubeAreGivenUpWhenItIsLoadedByOtherLimits) {
    assign(order(1));
    adopt();
    load();
    receive(parent_, render(1, 0, {}));
    receive(parent_, render(2, 0, {}));
    pb::SetMapping other;
    *other.mutable_mapping() = wire::to_wire(by_sketch);
    receive(parent_, other);
    EXPECT_THAT(absent_, ElementsAre(2, 1));
    EXPECT_THAT(stopped_, ElementsAre(draws_[0].job));
    tell(Loaded{loads_.back().job, {}});
    receive(parent_, render(3, 0, {}));
    EXPECT_THAT(draws_, SizeIs(2));
}

TEST_F(LeafSketchTest, ALoadByGivenLimitsTellsWhatItCountedOnTheWay) {
    pb::Assign with_limits = order(1);
    *with_limits.mutable_mapping() = wire::to_wire(by_cube);
    assign(with_limits);
    adopt();
    ASSERT_THAT(loads_, SizeIs(1));
    EXPECT_THAT(counts_, SizeIs(0));
    EXPECT_TRUE(loads_[0].count);
    tell(Loaded{loads_[0].job, {}, histogram()});
    EXPECT_EQ(leaf_.phase(), pb::PHASE_READY);
    EXPECT_THAT(reports_, ElementsAre(false));
    // By other limits nothing is counted once more.
    pb::SetMapping other;
    *other.mutable_mapping() = wire::to_wire(by_sketch);
    receive(parent_, other);
    ASSERT_THAT(loads_, SizeIs(2));
    EXPECT_FALSE(loads_[1].count);
}

TEST_F(LeafSketchTest, OfAStoppedJobIsIgnored) {
    assign(order(1));
    adopt();
    const Job stopped = counts_[0].job;
    pb::Assign another = order(1);
    another.mutable_cube()->set_path("/other");
    assign(another);
    tell(Sketched{stopped, histogram()});
    EXPECT_THAT(reports_, IsEmpty());
    receive(parent_, render(1, 1, by_sketch));
    EXPECT_THAT(absent_, ElementsAre(1));
}

TEST_F(LeafSketchTest, OfALevelThatTheCubeDoesNotHaveIsRefused) {
    for (const std::uint32_t level : {2U, 31U, 1U << 31, ~0U}) {
        assign(order(level));
        EXPECT_EQ(leaf_.phase(), pb::PHASE_FAILED) << level;
        EXPECT_THAT(counts_, IsEmpty());
    }
    assign(order(0));
    EXPECT_EQ(leaf_.phase(), pb::PHASE_COUNTING);
    EXPECT_EQ(counts_[0].sketch_level, 0);
}

TEST_F(LeafSketchTest, AskedForOnAnotherLevelOrByNoLimitsIsNotDrawn) {
    assign(order(1));
    adopt();
    tell(Sketched{counts_[0].job, histogram()});
    receive(parent_, render(1, 0, by_sketch));
    EXPECT_THAT(absent_, ElementsAre(1));
    pb::Render bad = render(2, 1, by_sketch);
    bad.mutable_sketch()->set_bits(12);
    receive(parent_, bad);
    EXPECT_THAT(closed_, ElementsAre(pb::REASON_INVALID));
    EXPECT_THAT(draws_, IsEmpty());
}

}  // namespace
}  // namespace shearwater::leaf
