// What a server's head does with a frame under way once its client's view moves on.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/wire/convert.h"
#include "server/head/head.h"

namespace shearwater::head {
namespace {

namespace pb = wire::pb;
using testing::ElementsAre;
using testing::IsEmpty;
using view::Quality;

// A head with two renderers and two clients, all of them the test.
class RefinementTest : public testing::Test {
  protected:
    RefinementTest() {
        std::uint64_t link = wire::first_accepted;
        for (tree::Place place = 1; place <= 2; ++place) {
            const wire::LinkId control{link++}, child{link++};
            up(control, pb::ROLE_RENDERER);
            pb::Join join;
            join.set_role(pb::ROLE_RENDERER);
            receive(control, join);
            up(child, pb::ROLE_CHILD);
            pb::Adopt adopt;
            adopt.set_epoch(epoch);
            adopt.set_place(static_cast<std::uint32_t>(place));
            receive(child, adopt);
            pb::Report report;
            report.set_place(static_cast<std::uint32_t>(place));
            report.set_phase(pb::PHASE_READY);
            *report.mutable_loaded() = wire::to_wire(*head_.mapping());
            receive(control, report);
            children_.push_back(child);
        }
        take(head_.handle(wire::Tick{}, now_));
        EXPECT_TRUE(head_.serving());
        up(client, pb::ROLE_CLIENT);
        up(other, pb::ROLE_CLIENT);
    }

    static Roster roster() {
        CubeFacts cube;
        cube.name = cube.path = "/cube";
        cube.lattice = {.n = n, .spacing = {1, 1, 1}};
        return {*tree::make_plan(*tree::full_tree(2, 2), n), std::move(cube), epoch, 8};
    }
    void up(wire::LinkId link, pb::Role role) {
        take(head_.handle(wire::LinkUp{link, role, "test", "127.0.0.1"}, now_));
    }
    template <class T>
    void receive(wire::LinkId link, T body) {
        take(head_.handle(wire::Received{link, wire::message(std::move(body))}, now_));
    }
    // They have drawn some of it.
    void draw_some(std::uint64_t frame, std::size_t bands) {
        for (const wire::LinkId child : children_) {
            receive(child, std::get<pb::Windows>(wire::windows_message(frame, bands, {}).body));
        }
    }
    void ask(Quality quality, wire::LinkId from = client) {
        wire::View view;
        view.revision = ++revision_;
        view.camera = view::camera_on({}, {.n = n, .spacing = {1, 1, 1}});
        view.size = size_;
        view.tf = view::default_transfer_function();
        view.quality = quality;
        receive(from, wire::to_wire(view));
    }
    // All renderers have drawn the frame, and it is being finished.
    void draw(std::uint64_t frame) {
        for (const wire::LinkId child : children_) {
            pb::Windows windows;
            windows.set_frame(frame);
            windows.set_bands(static_cast<std::uint32_t>(bands_));
            receive(child, windows);
        }
    }
    void finish(std::uint64_t frame) {
        pb::Frame finished;
        finished.set_number(frame);
        take(head_.handle(Finished{frame, wire::message(finished)}, now_));
    }
    // Sorts what the head did; renderers are told the same, so the first stands for both.
    void take(const Effects& effects) {
        for (const Job& job : effects.jobs) {
            if (const auto* given_up = std::get_if<GiveUp>(&job)) {
                given_up_.push_back(given_up->frame);
            }
        }
        for (const wire::NetEffect& effect : effects.net) {
            const auto* send = std::get_if<wire::Send>(&effect);
            ASSERT_NE(send, nullptr) << "a link was closed";
            if (const auto* frame = std::get_if<pb::Frame>(&send->message.body)) {
                sent_.push_back(frame->number());
            } else if (children_.empty() || send->link != children_[0]) {
                continue;
            } else if (const auto* render = std::get_if<pb::Render>(&send->message.body)) {
                begun_.push_back(render->frame());
                bands_ = view::bands_of(*wire::factorisation_from(render->factorisation())).size();
            } else if (const auto* cancel = std::get_if<pb::Cancel>(&send->message.body)) {
                cancelled_.push_back(cancel->frame());
            }
        }
    }

    static constexpr std::uint64_t epoch = 11;
    static constexpr volume::Index3 n{11, 9, 13};
    static constexpr wire::LinkId client{wire::first_accepted + 100}, other{wire::first_accepted + 101};

    wire::Time now_ = wire::Time{} + std::chrono::seconds(1000);
    Head head_{roster(), {.range = volume::Limits{.lo = 0, .hi = 1}}};
    std::vector<wire::LinkId> children_;
    std::uint64_t revision_ = 0;
    view::ImageSize size_{.width = 24, .height = 20};
    std::size_t bands_ = 0;  // of the newest frame
    std::vector<std::uint64_t> begun_, cancelled_, sent_, given_up_;
};

TEST_F(RefinementTest, IsGivenUpForALesserPicture) {
    ask(Quality::high);
    ask(Quality::draft);
    EXPECT_THAT(begun_, ElementsAre(1, 2));
    EXPECT_THAT(cancelled_, ElementsAre(1));
    ask(Quality::draft);
    EXPECT_THAT(begun_, ElementsAre(1, 2, 3)) << "what was given up is not on its way";
    draw(2);
    finish(2);
    EXPECT_THAT(sent_, ElementsAre(2));
    draw(1);  // too late
    finish(1);
    EXPECT_THAT(sent_, ElementsAre(2));
}

TEST_F(RefinementTest, OfBothUnderWayOnlyTheBetterIsGivenUp) {
    ask(Quality::normal);
    ask(Quality::high);
    ask(Quality::normal);
    EXPECT_THAT(cancelled_, ElementsAre(2));
    EXPECT_THAT(begun_, ElementsAre(1, 2, 3));
}

TEST_F(RefinementTest, FramesOfOneQualityAreAllFinished) {
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::high}) {
        ask(quality);
    }
    for (int i = 0; i < 5; ++i) {
        ask(Quality::high);
    }
    EXPECT_THAT(cancelled_, IsEmpty());
    EXPECT_THAT(begun_, ElementsAre(1, 2)) << "the others wait, and the newest wins";
}

TEST_F(RefinementTest, IsSentWhenItIsDrawnAlready) {
    ask(Quality::high);
    draw(1);
    ask(Quality::draft);
    EXPECT_THAT(cancelled_, IsEmpty());
    finish(1);
    EXPECT_THAT(sent_, ElementsAre(1));
}

TEST_F(RefinementTest, OfAnotherClientGoesOn) {
    ask(Quality::high, other);
    ask(Quality::draft);
    EXPECT_THAT(begun_, ElementsAre(1, 2));
    EXPECT_THAT(cancelled_, IsEmpty());
}

// What is laid of it is let go, and of nothing else.
TEST_F(RefinementTest, IsGivenUpBetweenItsBands) {
    size_ = {.width = 300, .height = 300};
    ask(Quality::high);
    ASSERT_GE(bands_, 3U);
    draw_some(1, 2);
    ask(Quality::draft);
    EXPECT_THAT(cancelled_, ElementsAre(1));
    EXPECT_THAT(given_up_, ElementsAre(1));
    ask(Quality::draft);
    ask(Quality::draft);
    EXPECT_THAT(given_up_, ElementsAre(1));
    draw(2);
    finish(2);
    EXPECT_THAT(sent_, ElementsAre(2));
}

TEST_F(RefinementTest, OfAClientThatLeavesIsGivenUp) {
    size_ = {.width = 300, .height = 300};
    ask(Quality::high);
    ask(Quality::high);
    draw_some(1, 2);
    take(head_.handle(wire::LinkDown{client, pb::REASON_LOST, "gone"}, now_));
    EXPECT_THAT(cancelled_, ElementsAre(1, 2));
    EXPECT_THAT(given_up_, ElementsAre(1)) << "nothing of the second was laid";
}

}  // namespace
}  // namespace shearwater::head
