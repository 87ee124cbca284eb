// A junction's bookkeeping, event by event.

#include "protocol/node/branch.h"

#include <gtest/gtest.h>

#include "common/image/over_windows.h"

namespace shearwater::node {
namespace {

namespace pb = wire::pb;
using wire::LinkId;
using namespace std::chrono_literals;

constexpr std::uint64_t epoch = 7;
const wire::Time start{};

// Of one band, or of several where it is asked for a large picture.
view::Factorisation factorisation(int side = 32) {
    const view::Lattice lattice{.n = {9, 9, 9}, .spacing = {1, 1, 1}};
    return view::factorise(view::camera_on({}, lattice), {.width = side, .height = side}, lattice, {1});
}

pb::Render render(std::uint64_t frame) {
    pb::Render message;
    message.set_frame(frame);
    return message;
}

pb::Adopt adopt(std::uint32_t place, std::uint64_t of_epoch = epoch) {
    pb::Adopt message;
    message.set_epoch(of_epoch);
    message.set_place(place);
    return message;
}

wire::Message empty_windows(std::uint64_t frame, std::size_t bands = 1) {
    return wire::windows_message(frame, bands, {});
}

// One pixel in the corner of the last of the bands.
wire::Message pixel(const view::Band& band, std::size_t bands, float alpha) {
    image::Window window{.face = band.face,
                         .rect = {band.rect.x0, band.rect.y0, band.rect.x0 + 1, band.rect.y0 + 1},
                         .pixels = {1, 1}};
    window.pixels.at(0, 0).a = alpha;
    return wire::windows_message(1, bands, image::encode({&window, 1}));
}

template <class T>
std::vector<T> of(const std::vector<wire::NetEffect>& effects) {
    std::vector<T> found;
    for (const wire::NetEffect& effect : effects) {
        if (const auto* one = std::get_if<T>(&effect)) {
            found.push_back(*one);
        }
    }
    return found;
}

class BranchTest : public testing::Test {
  protected:
    void SetUp() override {
        branch_.configure(epoch, {{3, {{0, 0, 0}, {4, 8, 8}}}, {4, {{4, 0, 0}, {8, 8, 8}}}}, effects_);
        EXPECT_EQ(branch_.adopt(left_, adopt(3), effects_), 3);
        EXPECT_EQ(branch_.adopt(right_, adopt(4), effects_), 4);
        EXPECT_TRUE(effects_.empty());
    }

    Branch branch_;
    std::vector<wire::NetEffect> effects_;
    LinkId left_{101}, right_{102};
};

TEST_F(BranchTest, AFrameIsCompleteWhenEveryChildHasAnswered) {
    branch_.begin(factorisation(), render(1), start, effects_);
    EXPECT_EQ(of<wire::Send>(effects_).size(), 2U);
    branch_.receive(right_, empty_windows(1), effects_);
    EXPECT_TRUE(branch_.take_complete().empty());
    branch_.receive(left_, empty_windows(1), effects_);
    const auto complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_EQ(complete[0].frame->number, 1U);
    EXPECT_TRUE(complete[0].last());
    EXPECT_TRUE(complete[0].account.missing.empty());
}

TEST_F(BranchTest, FramesOverlapAndMayCompleteOutOfOrder) {
    branch_.begin(factorisation(), render(1), start, effects_);
    branch_.begin(factorisation(), render(2), start, effects_);
    branch_.receive(left_, empty_windows(2), effects_);
    branch_.receive(right_, empty_windows(2), effects_);
    branch_.receive(left_, empty_windows(1), effects_);
    EXPECT_EQ(branch_.take_complete().front().frame->number, 2U);
    branch_.receive(right_, empty_windows(1), effects_);
    EXPECT_EQ(branch_.take_complete().front().frame->number, 1U);
}

TEST_F(BranchTest, AChildThatDiesIsMissingWithItsBox) {
    branch_.begin(factorisation(), render(1), start, effects_);
    branch_.receive(left_, empty_windows(1), effects_);
    branch_.link_down(right_);
    auto complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    ASSERT_EQ(complete[0].account.missing.size(), 1U);
    EXPECT_EQ(complete[0].account.missing[0], (Missing{4, {{4, 0, 0}, {8, 8, 8}}}));
    // And from the start in the next frame, until it is back.
    branch_.begin(factorisation(), render(2), start, effects_);
    branch_.receive(left_, empty_windows(2), effects_);
    EXPECT_EQ(branch_.take_complete()[0].account.missing.size(), 1U);
    EXPECT_EQ(branch_.adopt(LinkId{103}, adopt(4), effects_), 4);
    branch_.begin(factorisation(), render(3), start, effects_);
    branch_.receive(left_, empty_windows(3), effects_);
    branch_.receive(LinkId{103}, empty_windows(3), effects_);
    EXPECT_TRUE(branch_.take_complete()[0].account.missing.empty());
}

TEST_F(BranchTest, WhatIsMissingBelowAChildIsMissingHere) {
    branch_.begin(factorisation(), render(1), start, effects_);
    wire::Message windows = empty_windows(1);
    pb::Missing* const missing = std::get<pb::Windows>(windows.body).add_missing();
    missing->set_place(9);
    *missing->mutable_box() = wire::to_wire(volume::Box{{0, 0, 0}, {4, 4, 8}});
    branch_.receive(left_, windows, effects_);
    branch_.receive(right_, empty_windows(1), effects_);
    const auto complete = branch_.take_complete();
    ASSERT_EQ(complete[0].account.missing.size(), 1U);
    EXPECT_EQ(complete[0].account.missing[0].place, 9);
}

TEST_F(BranchTest, ASilentChildIsGivenUpInTheEnd) {
    branch_.begin(factorisation(), render(1), start, effects_);
    branch_.receive(left_, empty_windows(1), effects_);
    branch_.tick(start + Branch::patience);
    EXPECT_TRUE(branch_.take_complete().empty());
    branch_.tick(start + Branch::patience + 1s);
    ASSERT_EQ(branch_.take_complete().size(), 1U);
    // Its windows, when they come after all, are of no use and do no harm.
    effects_.clear();
    branch_.receive(right_, empty_windows(1), effects_);
    EXPECT_TRUE(effects_.empty());
}

// What all children have given, or will not, goes on; the rest waits.
struct BandsTest : BranchTest {
    void SetUp() override {
        BranchTest::SetUp();
        bands_ = view::bands_of(f_);
        ASSERT_GE(bands_.size(), 4U);
        branch_.begin(f_, render(1), start, effects_);
        effects_.clear();
    }
    void give(LinkId link, std::size_t bands, float alpha) {
        branch_.receive(link, pixel(bands_[bands - 1], bands, alpha), effects_);
    }
    void expect_end(const wire::Message& message, std::string_view what) {
        EXPECT_TRUE(branch_.is_child(left_));
        branch_.receive(left_, message, effects_);
        const auto closed = of<wire::CloseLink>(effects_);
        ASSERT_EQ(closed.size(), 1U);
        EXPECT_EQ(closed[0].link, left_);
        EXPECT_EQ(closed[0].reason, pb::REASON_INVALID);
        EXPECT_NE(closed[0].text.find(what), std::string::npos) << closed[0].text;
        EXPECT_FALSE(branch_.is_child(left_));
    }

    view::Factorisation f_ = factorisation(400);
    std::vector<view::Band> bands_;
};

TEST_F(BandsTest, GoOnOnceEveryChildHasGivenThem) {
    const std::size_t all = bands_.size();
    give(left_, 1, 0.25F);
    give(left_, 2, 0.25F);
    EXPECT_TRUE(branch_.take_complete().empty());
    give(right_, 1, 0.5F);
    auto complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_EQ(complete[0].first, 0U);
    EXPECT_EQ(complete[0].end, 1U);
    EXPECT_FALSE(complete[0].last());
    // Front to back.
    const bool left_first =
        view::visibility_order(f_, {{{0, 0, 0}, {4, 8, 8}}, {{4, 0, 0}, {8, 8, 8}}}).front() == 0;
    ASSERT_EQ(complete[0].windows.size(), 2U);
    const auto nearest = image::merge_front_to_back(std::span(complete[0].windows).first(1));
    EXPECT_NEAR(nearest.at(0).pixels.at(0, 0).a, left_first ? 0.25 : 0.5, 1e-4);
    // Bands that come together go on one by one.
    give(right_, 3, 0.5F);
    complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 1U);
    EXPECT_EQ(complete[0].windows.size(), 1U) << "the right one said nothing of the second";
    branch_.receive(left_, empty_windows(1, all), effects_);
    branch_.receive(right_, empty_windows(1, all), effects_);
    complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 2U);
    EXPECT_EQ(complete[0].end, 3U);
    EXPECT_FALSE(complete[0].last());
    EXPECT_TRUE(complete[1].last()) << "the others have nothing, and go together";
    EXPECT_TRUE(complete[1].windows.empty());
    EXPECT_FALSE(branch_.pending(1));
}

TEST_F(BandsTest, OfAChildThatDiesGoOnAndItIsMissing) {
    give(left_, 1, 0.25F);
    give(left_, 2, 0.25F);
    give(right_, 1, 0.5F);
    EXPECT_EQ(branch_.take_complete().size(), 1U);
    branch_.link_down(left_);
    EXPECT_TRUE(branch_.take_complete().empty()) << "the right one still draws the second";
    branch_.receive(right_, empty_windows(1, bands_.size()), effects_);
    const auto complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 2U);
    EXPECT_EQ(complete[0].windows.size(), 1U) << "what it gave before counts";
    EXPECT_TRUE(complete[1].last());
    ASSERT_EQ(complete[1].account.missing.size(), 1U);
    EXPECT_EQ(complete[1].account.missing[0].place, 3);
}

// What it was merging when its link broke still comes, on the new one.
TEST_F(BandsTest, OfAChildThatIsBackAreTooLateForTheFrame) {
    give(left_, 1, 0.25F);
    branch_.link_down(left_);
    const LinkId again{103};
    EXPECT_EQ(branch_.adopt(again, adopt(3), effects_), 3);
    effects_.clear();
    give(again, 2, 0.25F);
    EXPECT_TRUE(effects_.empty());
    EXPECT_TRUE(branch_.is_child(again));
    branch_.receive(right_, empty_windows(1, bands_.size()), effects_);
    const auto complete = branch_.take_complete();
    ASSERT_EQ(complete.size(), 2U);
    EXPECT_EQ(complete[0].end, 1U);
    EXPECT_TRUE(complete[1].windows.empty());
}

TEST_F(BandsTest, OfACancelledFrameAreForgotten) {
    give(left_, 1, 0.25F);
    branch_.cancel(1, effects_);
    effects_.clear();
    give(right_, 1, 0.25F);
    give(left_, 1, 0.25F);
    EXPECT_TRUE(effects_.empty());
    EXPECT_TRUE(branch_.take_complete().empty());
}

TEST_F(BandsTest, GivenTwiceEndTheLink) {
    give(left_, 2, 0.25F);
    expect_end(pixel(bands_[1], 2, 0.25F), "windows.bands: 2 of");
}

TEST_F(BandsTest, OutOfOrderEndTheLink) {
    give(left_, 2, 0.25F);
    expect_end(pixel(bands_[0], 1, 0.25F), "windows.bands: 1 of");
}

TEST_F(BandsTest, BeyondTheLastEndTheLink) {
    expect_end(empty_windows(1, bands_.size() + 1), "windows.bands: ");
}

TEST_F(BandsTest, AfterTheLastEndTheLink) {
    branch_.receive(left_, empty_windows(1, bands_.size()), effects_);
    expect_end(empty_windows(1, bands_.size()), "all of the frame's bands were known");
}

TEST_F(BandsTest, WithAnothersWindowEndTheLink) {
    expect_end(pixel(bands_[2], 2, 0.25F), "leaves its band");
}

TEST_F(BranchTest, ACancelGoesToThoseStillAtWork) {
    branch_.begin(factorisation(), render(1), start, effects_);
    branch_.receive(left_, empty_windows(1), effects_);
    effects_.clear();
    branch_.cancel(1, effects_);
    const auto sends = of<wire::Send>(effects_);
    ASSERT_EQ(sends.size(), 1U);
    EXPECT_EQ(sends[0].link, right_);
    EXPECT_TRUE(std::holds_alternative<pb::Cancel>(sends[0].message.body));
    EXPECT_FALSE(branch_.pending(1));
}

TEST_F(BranchTest, FramesThatNobodyFinishesDoNotPileUp) {
    for (std::uint64_t frame = 1; frame <= 3 * Branch::max_pending; ++frame) {
        branch_.begin(factorisation(), render(frame), start, effects_);
    }
    EXPECT_FALSE(branch_.pending(1));
    EXPECT_TRUE(branch_.pending(3 * Branch::max_pending));
}

TEST_F(BranchTest, FaultyMessagesEndTheChildsLinkByName) {
    branch_.begin(factorisation(), render(1), start, effects_);
    effects_.clear();
    wire::Message windows = empty_windows(1);
    std::get<pb::Windows>(windows.body).add_windows()->set_face(99);
    branch_.receive(left_, windows, effects_);
    ASSERT_EQ(of<wire::CloseLink>(effects_).size(), 1U);
    EXPECT_EQ(of<wire::CloseLink>(effects_)[0].reason, pb::REASON_INVALID);
    EXPECT_FALSE(branch_.is_child(left_));
    effects_.clear();
    branch_.receive(right_, wire::message(pb::SetView{}), effects_);
    EXPECT_EQ(of<wire::CloseLink>(effects_)[0].reason, pb::REASON_BAD_TYPE);
}

TEST_F(BranchTest, RepliesArePutTogetherOnceAllAreThere) {
    pb::Look look;
    look.set_request(5);
    branch_.ask(5, wire::message(look), start, effects_);
    EXPECT_EQ(of<wire::Send>(effects_).size(), 2U);
    branch_.receive(right_, wire::message(wire::to_wire(wire::Reply{5, false, "\x01"})), effects_);
    EXPECT_TRUE(branch_.take_replies().empty());
    branch_.receive(left_, wire::message(wire::to_wire(wire::Reply{5, false, "\x04"})), effects_);
    const auto replies = branch_.take_replies();
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].request, 5U);
    EXPECT_EQ(replies[0].visible, "\x05");
    EXPECT_FALSE(replies[0].incomplete);
}

TEST_F(BranchTest, RepliesOfThoseWhoAreGoneAreLacking) {
    const auto incomplete = [&] {
        const auto replies = branch_.take_replies();
        EXPECT_EQ(replies.size(), 1U);
        return !replies.empty() && replies[0].incomplete;
    };
    branch_.ask(5, wire::message(pb::Look()), start, effects_);
    branch_.receive(right_, wire::message(wire::to_wire(wire::Reply{5})), effects_);
    branch_.tick(start + Branch::reply_patience + 1ms);
    EXPECT_TRUE(incomplete()) << "silent";
    branch_.ask(6, wire::message(pb::Look()), start, effects_);
    branch_.receive(right_, wire::message(wire::to_wire(wire::Reply{6})), effects_);
    branch_.link_down(left_);
    EXPECT_TRUE(incomplete()) << "gone since";
    branch_.ask(7, wire::message(pb::Look()), start, effects_);
    branch_.receive(right_, wire::message(wire::to_wire(wire::Reply{7})), effects_);
    EXPECT_TRUE(incomplete()) << "gone before";
}

TEST_F(BranchTest, StrangersAreNotAdopted) {
    EXPECT_EQ(branch_.adopt(LinkId{200}, adopt(5), effects_), -1);
    EXPECT_EQ(branch_.adopt(LinkId{201}, adopt(3, epoch + 1), effects_), -1);
    EXPECT_EQ(of<wire::CloseLink>(effects_).size(), 2U);
    effects_.clear();
    // The same child on a new link: the old one is closed.
    EXPECT_EQ(branch_.adopt(LinkId{202}, adopt(3), effects_), 3);
    ASSERT_EQ(of<wire::CloseLink>(effects_).size(), 1U);
    EXPECT_EQ(of<wire::CloseLink>(effects_)[0].link, left_);
}

TEST_F(BranchTest, HistogramsAreSummedOnceAllHaveReported) {
    volume::Histogram a;
    a.add(1.0F);
    volume::Histogram b;
    b.add(2.0F);
    branch_.receive(left_, wire::message(wire::to_wire(a)), effects_);
    EXPECT_FALSE(branch_.histogram(Branch::Counted::voxels));
    branch_.receive(right_, wire::message(wire::to_wire(b)), effects_);
    branch_.receive(right_, wire::message(wire::to_wire(b)), effects_);  // said again after a reconnect
    ASSERT_TRUE(branch_.histogram(Branch::Counted::voxels));
    EXPECT_EQ(branch_.histogram(Branch::Counted::voxels)->valid(), 2U);
    EXPECT_EQ(branch_.histogram(Branch::Counted::voxels)->max(), 2.0);
}

TEST_F(BranchTest, SketchesAreSummedApartFromVoxels) {
    using Counted = Branch::Counted;
    const auto report = [](float value, bool sketch) {
        volume::Histogram histogram;
        histogram.add(value);
        pb::HistogramReport message = wire::to_wire(histogram);
        message.set_sketch(sketch);
        return wire::message(message);
    };
    branch_.receive(left_, report(1, true), effects_);
    branch_.receive(left_, report(5, false), effects_);
    EXPECT_TRUE(branch_.take_histogram_news(Counted::sketches));
    EXPECT_FALSE(branch_.take_histogram_news(Counted::sketches));
    branch_.receive(right_, report(2, true), effects_);
    EXPECT_FALSE(branch_.histogram(Counted::voxels));
    ASSERT_TRUE(branch_.histogram(Counted::sketches));
    EXPECT_EQ(branch_.histogram(Counted::sketches)->max(), 2);
    branch_.receive(right_, report(7, false), effects_);
    EXPECT_EQ(branch_.histogram(Counted::voxels)->max(), 7);
    EXPECT_EQ(branch_.histogram(Counted::sketches)->valid(), 2U);
    EXPECT_TRUE(branch_.take_histogram_news(Counted::voxels));
}

TEST_F(BranchTest, VoxelsFindTheirWayBack) {
    pb::NeedVoxels need;
    need.set_place(12);
    need.set_request(5);
    *need.mutable_box() = wire::to_wire(volume::Box{{0, 0, 0}, {2, 2, 2}});
    const auto up = branch_.receive(left_, wire::message(need), effects_);
    ASSERT_TRUE(up);
    EXPECT_EQ(up->place(), 12U);
    // Until then they can be asked for again: who is asked may not be there yet.
    ASSERT_EQ(branch_.unanswered().size(), 1U);
    EXPECT_EQ(branch_.unanswered()[0].request(), 5U);
    pb::Voxels voxels;
    voxels.set_place(12);
    branch_.deliver_voxels(wire::message(voxels), effects_);
    ASSERT_EQ(of<wire::Send>(effects_).size(), 1U);
    EXPECT_EQ(of<wire::Send>(effects_)[0].link, left_);
    EXPECT_TRUE(branch_.unanswered().empty());
    // Not what another child holds.
    *need.mutable_box() = wire::to_wire(volume::Box{{5, 0, 0}, {7, 2, 2}});
    EXPECT_FALSE(branch_.receive(left_, wire::message(need), effects_));
    EXPECT_EQ(of<wire::CloseLink>(effects_)[0].reason, pb::REASON_INVALID);
}

}  // namespace
}  // namespace shearwater::node
