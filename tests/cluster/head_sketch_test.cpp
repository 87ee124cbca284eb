// What a server's head does with sketches, and for clients that welcome them or have never heard of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/wire/convert.h"
#include "server/head/head.h"

namespace shearwater::head {
namespace {

namespace pb = wire::pb;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::uint64_t epoch = 11;
constexpr volume::Index3 n{70, 9, 11};
constexpr int level = 1;

// A head with two renderers and two clients, all of them the test.
class HeadSketchTest : public testing::Test {
  protected:
    void start(const Limits& limits = {}) {
        CubeFacts cube;
        cube.name = cube.path = "/cube";
        cube.lattice = {.n = n, .spacing = {1, 1, 1}};
        cube.sketch_level = level;
        cube.copies = 2;
        head_.emplace(Roster(*tree::make_plan(*tree::full_tree(2, 2), n), std::move(cube), epoch, 8), limits);
        for (std::uint32_t place = 1; place <= 2; ++place) {
            join(place);
        }
        up(client, pb::ROLE_CLIENT);
        up(other, pb::ROLE_CLIENT);
    }
    static wire::LinkId control(std::uint32_t place) {
        return wire::LinkId{wire::first_accepted + 2 * place};
    }
    static wire::LinkId child(std::uint32_t place) {
        return wire::LinkId{wire::first_accepted + 2 * place + 1};
    }
    void join(std::uint32_t place) {
        up(control(place), pb::ROLE_RENDERER);
        pb::Join join;
        join.set_role(pb::ROLE_RENDERER);
        receive(control(place), join);
        up(child(place), pb::ROLE_CHILD);
        pb::Adopt adopt;
        adopt.set_epoch(epoch);
        adopt.set_place(place);
        receive(child(place), adopt);
    }
    void up(wire::LinkId link, pb::Role role) {
        take(head_->handle(wire::LinkUp{link, role, "test", "127.0.0.1"}, now_));
    }
    template <class T>
    void receive(wire::LinkId link, T body) {
        take(head_->handle(wire::Received{link, wire::message(std::move(body))}, now_));
    }
    void tick() {
        now_ += std::chrono::milliseconds(100);
        take(head_->handle(wire::Tick{}, now_));
    }
    void report(std::uint32_t place, pb::Phase phase) {
        pb::Report report;
        report.set_place(place);
        report.set_phase(phase);
        if (phase == pb::PHASE_READY && head_->mapping()) {
            *report.mutable_loaded() = wire::to_wire(*head_->mapping());
        }
        receive(control(place), report);
    }
    void count(std::uint32_t place, std::initializer_list<float> values, bool sketch) {
        volume::Histogram histogram;
        for (const float value : values) {
            histogram.add(value);
        }
        pb::HistogramReport report = wire::to_wire(histogram);
        report.set_sketch(sketch);
        receive(child(place), report);
    }
    void sketch_all() {
        count(1, {1, 2}, true);
        count(2, {3}, true);
    }
    void count_all() {
        count(1, {0, 2}, false);
        count(2, {5}, false);
    }
    void load_all() {
        report(1, pb::PHASE_READY);
        report(2, pb::PHASE_READY);
        tick();
    }
    wire::View view(bool welcomes_sketch) {
        wire::View view;
        view.revision = ++revision_;
        view.camera = view::camera_on({}, {.n = n, .spacing = {1, 1, 1}});
        view.size = {.width = 24, .height = 20};
        view.tf = view::default_transfer_function();
        view.sketch = welcomes_sketch;
        return view;
    }
    void ask(bool welcomes_sketch, wire::LinkId from = client) {
        receive(from, wire::to_wire(view(welcomes_sketch)));
    }
    void draw(std::uint64_t frame) {
        for (std::uint32_t place = 1; place <= 2; ++place) {
            pb::Windows windows;
            windows.set_frame(frame);
            windows.set_bands(1);  // so small a picture has no more
            receive(child(place), windows);
        }
    }
    // As the service does it.
    void finish(const Finish& job) {
        pb::Frame frame;
        frame.set_number(job.frame);
        frame.set_revision(job.view->revision);
        frame.set_sketch(job.sketch);
        take(head_->handle(Finished{job.frame, wire::message(frame)}, now_));
    }
    void show(std::uint64_t number) {
        pb::FrameShown shown;
        shown.set_number(number);
        receive(client, shown);
    }
    // Sorts what the head did; renderers are told the same, so the first stands for both.
    void take(Effects effects) {
        for (Job& job : effects.jobs) {
            if (!std::holds_alternative<Lay>(job)) {
                jobs_.push_back(std::get<Finish>(std::move(job)));
            }
        }
        for (const wire::NetEffect& effect : effects.net) {
            const auto* send = std::get_if<wire::Send>(&effect);
            ASSERT_NE(send, nullptr) << "a link was closed";
            if (const auto* frame = std::get_if<pb::Frame>(&send->message.body)) {
                sent_.push_back(*frame);
            } else if (const auto* cube = std::get_if<pb::CubeDescription>(&send->message.body)) {
                described_.push_back(*cube);
            } else if (const auto* assign = std::get_if<pb::Assign>(&send->message.body)) {
                assigned_.push_back(*assign);
            } else if (const auto* render = std::get_if<pb::Render>(&send->message.body);
                       render != nullptr && send->link == child(1)) {
                begun_.push_back(*render);
            } else if (const auto* cancel = std::get_if<pb::Cancel>(&send->message.body);
                       cancel != nullptr && send->link == child(1)) {
                cancelled_.push_back(cancel->frame());
            }
        }
    }

    static constexpr wire::LinkId client{wire::first_accepted + 100}, other{wire::first_accepted + 101};

    wire::Time now_ = wire::Time{} + std::chrono::seconds(1000);
    std::optional<Head> head_;
    std::uint64_t revision_ = 0;
    std::vector<pb::Assign> assigned_;
    std::vector<pb::CubeDescription> described_;
    std::vector<pb::Render> begun_;
    std::vector<std::uint64_t> cancelled_;
    std::vector<Finish> jobs_;
    std::vector<pb::Frame> sent_;
};

TEST_F(HeadSketchTest, IsOfOneLevelForAll) {
    start();
    ASSERT_THAT(assigned_, SizeIs(2));
    EXPECT_EQ(assigned_[0].sketch_level(), 1U);
    EXPECT_EQ(assigned_[1].sketch_level(), 1U);
    EXPECT_EQ(assigned_[0].copies(), 2U);
}

TEST_F(HeadSketchTest, DescribesTheCubeByItsSketchAndThenByItself) {
    start();
    count(1, {1, 2}, true);
    EXPECT_THAT(described_, IsEmpty());
    count(2, {3}, true);
    ASSERT_THAT(described_, SizeIs(2)) << "one for each client";
    EXPECT_TRUE(described_[0].provisional());
    EXPECT_GE(described_[0].mapping().lo(), 1);
    EXPECT_LE(described_[0].mapping().hi(), 3);
    count_all();
    ASSERT_THAT(described_, SizeIs(4));
    EXPECT_FALSE(described_[2].provisional());
    EXPECT_GT(described_[2].mapping().hi(), 4);
}

TEST_F(HeadSketchTest, TellsOfTheValuesAsSoonAsTheyAreCounted) {
    start();
    sketch_all();
    ASSERT_THAT(described_, SizeIs(2));
    const auto first = wire::summary_from(described_[0].values());
    ASSERT_TRUE(first);
    EXPECT_TRUE(described_[0].values().provisional());
    EXPECT_EQ(first->min, 1);
    EXPECT_EQ(first->max, 3);
    count_all();
    const auto whole = wire::summary_from(described_[2].values());
    ASSERT_TRUE(whole);
    EXPECT_FALSE(described_[2].values().provisional());
    EXPECT_EQ(whole->min, 0);
    EXPECT_EQ(whole->max, 5);
    EXPECT_NEAR(whole->median, 2, 0.001);
    // A daemon that comes back counts again: that is no news. A client that comes is told all at once.
    count_all();
    EXPECT_THAT(described_, SizeIs(4));
    up(wire::LinkId{wire::first_accepted + 102}, pb::ROLE_CLIENT);
    ASSERT_THAT(described_, SizeIs(5));
    EXPECT_EQ(wire::summary_from(described_[4].values()).value(), *whole);
}

// They need not wait for counts to load; what is counted meanwhile is told afterwards, by the limits given.
TEST_F(HeadSketchTest, TellsOfTheValuesWhenLimitsAreGivenToo) {
    start({.range = volume::Limits{.lo = 1, .hi = 9}});
    ASSERT_THAT(described_, SizeIs(2));
    EXPECT_FALSE(described_[0].has_values());
    sketch_all();
    ASSERT_THAT(described_, SizeIs(4));
    EXPECT_TRUE(described_[2].values().provisional());
    EXPECT_FALSE(described_[2].provisional()) << "the limits stay";
    count_all();
    ASSERT_THAT(described_, SizeIs(6));
    const auto whole = wire::summary_from(described_[4].values());
    ASSERT_TRUE(whole);
    EXPECT_FALSE(described_[4].values().provisional());
    EXPECT_EQ(described_[4].mapping().hi(), 9);
    EXPECT_EQ(whole->below, 1U) << "the 0";
}

TEST_F(HeadSketchTest, IsDrawnUntilTheCubeIsAndThenUnaskedTheCube) {
    start();
    ask(true);
    EXPECT_THAT(begun_, IsEmpty()) << "not all have a sketch";
    sketch_all();
    ASSERT_THAT(begun_, SizeIs(1)) << "at once";
    EXPECT_TRUE(begun_[0].has_sketch());
    EXPECT_LE(begun_[0].sketch().hi(), 3);
    EXPECT_EQ(begun_[0].factorisation().slice_exponent(), level);
    draw(1);
    ASSERT_THAT(jobs_, SizeIs(1));
    finish(jobs_[0]);
    ASSERT_THAT(sent_, SizeIs(1));
    EXPECT_TRUE(sent_[0].sketch());
    show(1);
    count_all();
    tick();
    EXPECT_THAT(begun_, SizeIs(1));
    load_all();
    ASSERT_THAT(begun_, SizeIs(2));
    EXPECT_FALSE(begun_[1].has_sketch());
    draw(2);
    finish(jobs_[1]);
    ASSERT_THAT(sent_, SizeIs(2));
    EXPECT_FALSE(sent_[1].sketch());
    EXPECT_EQ(sent_[1].revision(), sent_[0].revision());
    show(2);
    for (int i = 0; i < 20; ++i) {
        tick();
    }
    EXPECT_THAT(begun_, SizeIs(2)) << "and no more of it";
}

TEST_F(HeadSketchTest, IsNotForClientsThatHaveNotSaidSo) {
    start();
    sketch_all();
    ask(false);
    tick();
    EXPECT_THAT(begun_, IsEmpty());
    ask(true, other);
    EXPECT_THAT(begun_, SizeIs(1));
    count_all();
    load_all();
    ASSERT_THAT(begun_, SizeIs(3));
    EXPECT_FALSE(begun_[1].has_sketch());
    EXPECT_FALSE(begun_[2].has_sketch());
}

// The client has it on its screen, or not yet: either way one of the cube follows, and what is still drawn of
// the sketch is given up.
TEST_F(HeadSketchTest, UnderWayIsGivenUpWhenTheCubeIsThere) {
    start();
    sketch_all();
    ask(true);
    ask(true);
    ask(true);
    EXPECT_THAT(begun_, SizeIs(2)) << "two at a time";
    count_all();
    load_all();
    EXPECT_THAT(cancelled_, ElementsAre(1, 2));
    ASSERT_THAT(begun_, SizeIs(3));
    draw(3);
    finish(jobs_[0]);
    EXPECT_EQ(sent_[0].revision(), 3U);
    EXPECT_FALSE(sent_[0].sketch());
}

TEST_F(HeadSketchTest, OnceDrawnIsFinishedBeforeTheCubes) {
    start();
    sketch_all();
    ask(true);
    draw(1);
    count_all();
    load_all();
    EXPECT_THAT(cancelled_, IsEmpty());
    draw(2);
    finish(jobs_[0]);
    finish(jobs_[1]);
    ASSERT_THAT(sent_, SizeIs(2));
    EXPECT_TRUE(sent_[0].sketch());
    EXPECT_FALSE(sent_[1].sketch());
}

TEST_F(HeadSketchTest, IsDrawnByTheCubesLimitsOnceTheyAreKnown) {
    start();
    sketch_all();
    count_all();
    ask(true);
    ASSERT_THAT(begun_, SizeIs(1));
    EXPECT_GT(begun_[0].sketch().hi(), 4);
    start({.range = volume::Limits{.lo = -7, .hi = 9}});
    ASSERT_FALSE(described_.back().provisional());
    begun_.clear();
    ask(true);
    EXPECT_THAT(begun_, IsEmpty()) << "limits are given, but there are no sketches yet";
    sketch_all();
    ASSERT_THAT(begun_, SizeIs(1));
    EXPECT_EQ(begun_[0].sketch().lo(), -7);
    EXPECT_EQ(begun_[0].sketch().hi(), 9);
}

TEST_F(HeadSketchTest, IsNotMadeForOnePlaceOfATreeThatServes) {
    start();
    sketch_all();
    count_all();
    load_all();
    take(head_->handle(wire::LinkDown{control(2), pb::REASON_LOST, "gone"}, now_));
    take(head_->handle(wire::LinkDown{child(2), pb::REASON_LOST, "gone"}, now_));
    join(2);
    ask(true);
    EXPECT_EQ(assigned_.back().place(), 2U);
    EXPECT_EQ(assigned_.back().sketch_level(), 0U);
    ASSERT_FALSE(begun_.empty());
    EXPECT_FALSE(begun_.back().has_sketch());
}

// Levels of detail are the client's wish, and the server's only where it has none.
TEST_F(HeadSketchTest, LevelsOfDetailAreTheServersWhereTheClientDoesNotSay) {
    for (const bool by_default : {true, false}) {
        begun_.clear();
        start({.range = volume::Limits{.lo = 0, .hi = 1}, .level_of_detail = by_default});
        load_all();
        for (const std::optional<bool> wish :
             {std::optional<bool>(), std::optional(true), std::optional(false)}) {
            wire::View far = view(false);
            far.camera = view::camera_on({.distance = 400}, {.n = n, .spacing = {1, 1, 1}});
            far.level_of_detail = wish;
            receive(client, wire::to_wire(far));
            ASSERT_FALSE(begun_.empty());
            EXPECT_EQ(begun_.back().factorisation().slice_exponent(), wish.value_or(by_default) ? 1 : 0);
            show(begun_.back().frame());
        }
    }
}

// Renderers that were ready are not, whatever they still say of the limits before.
TEST_F(HeadSketchTest, OtherLimitsAreWaitedForAndReachEveryClient) {
    start();
    sketch_all();
    count_all();
    load_all();
    ask(false);
    ask(false, other);
    ASSERT_THAT(begun_, SizeIs(2));
    draw(1);
    draw(2);
    const volume::Mapping before = *head_->mapping();
    wire::View scaled = view(false);
    scaled.scaling = volume::Scaling{1, 2, volume::Stretch::log};
    described_.clear();
    receive(client, wire::to_wire(scaled));
    EXPECT_EQ(head_->mapping(), volume::Mapping::of(*scaled.scaling, 8));
    ASSERT_THAT(described_, SizeIs(2));
    EXPECT_EQ(described_[1].mapping().lo(), 1);
    pb::Report late;
    late.set_place(1);
    late.set_phase(pb::PHASE_READY);
    *late.mutable_loaded() = wire::to_wire(before);
    receive(control(1), late);
    report(2, pb::PHASE_READY);
    tick();
    EXPECT_FALSE(head_->serving());
    EXPECT_THAT(begun_, SizeIs(2)) << "nothing is drawn by two limits";
    report(1, pb::PHASE_READY);
    tick();
    EXPECT_TRUE(head_->serving());
    EXPECT_THAT(begun_, SizeIs(4)) << "the other client's too, unasked";

    // The same again, and another client that says nothing of limits, change nothing.
    receive(client, wire::to_wire(scaled));
    ask(false, other);
    EXPECT_TRUE(head_->serving());
    ask(false);
    EXPECT_EQ(head_->mapping(), before) << "taken back";
    EXPECT_FALSE(head_->serving());
}

}  // namespace
}  // namespace shearwater::head
