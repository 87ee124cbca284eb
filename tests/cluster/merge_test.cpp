// What a junction makes of its children's windows.

#include "protocol/node/merge.h"

#include <gtest/gtest.h>

#include "common/image/over.h"
#include "common/image/over_windows.h"
#include "protocol/node/branch.h"

namespace shearwater::node {
namespace {

namespace pb = wire::pb;
using image::RgbaF;
using wire::LinkId;

const volume::Box low{{0, 0, 0}, {4, 8, 8}};
const volume::Box high{{4, 0, 0}, {8, 8, 8}};

view::Factorisation merged_view() {
    const view::Lattice lattice{.n = {9, 9, 9}, .spacing = {1, 1, 1}};
    return view::factorise(view::camera_on({}, lattice), {.width = 32, .height = 32}, lattice, {1});
}

image::Window filled(const view::Rect& rect, const RgbaF& pixel) {
    image::Window window{.face = 0, .rect = rect, .pixels = {rect.width(), rect.height()}};
    std::ranges::fill(window.pixels.pixels(), pixel);
    return window;
}

// A leaf's answer: one window, and figures to be told apart.
wire::Message answer(const view::Rect& rect, const RgbaF& pixel, double seconds, std::uint64_t samples) {
    const image::Window window = filled(rect, pixel);
    wire::Message message = wire::windows_message(1, 1, image::encode({&window, 1}));
    Account account;
    account.stats.set_render_seconds(seconds);
    account.stats.set_composite_seconds(2 * seconds);
    account.stats.set_samples(samples);
    put(account, std::get<pb::Windows>(message.body));
    return message;
}

const view::Rect low_rect{2, 3, 12, 9}, high_rect{8, 5, 20, 14};
const RgbaF red{0.5F, 0, 0, 0.5F}, green{0, 0.25F, 0, 0.75F};

// The job that a branch makes of two answers, and what it came in.
struct Merging : testing::Test {
    void SetUp() override {
        std::vector<wire::NetEffect> effects;
        Branch branch;
        branch.configure(7, {{3, low}, {4, high}}, effects);
        for (const auto& [link, place] : {std::pair{LinkId{101}, 3U}, std::pair{LinkId{102}, 4U}}) {
            pb::Adopt adopt;
            adopt.set_epoch(7);
            adopt.set_place(place);
            branch.adopt(link, adopt, effects);
        }
        pb::Render render;
        render.set_frame(1);
        branch.begin(merged_view(), render, {}, effects);
        const wire::Message from_low = answer(low_rect, red, 1e6, 100);
        const wire::Message from_high = answer(high_rect, green, 2e6, 1000);
        payload = from_low.payload_size() + from_high.payload_size();
        branch.receive(LinkId{101}, from_low, effects);
        branch.receive(LinkId{102}, from_high, effects);
        auto complete = branch.take_complete();
        ASSERT_EQ(complete.size(), 1U);
        job = std::move(complete[0]);
    }

    MergeJob job;
    std::size_t payload = 0;
};

image::Canvas canvas_of(const MergeJob& job) {
    image::Canvas canvas;
    canvas.begin(job.frame->factorisation);
    return canvas;
}

TEST_F(Merging, LaysTheNearerOverTheFarther) {
    image::Canvas canvas = canvas_of(job);
    merge_into(canvas, job);
    ASSERT_EQ(canvas.windows().size(), 1U);
    const image::Window& window = canvas.windows()[0];
    const bool low_first = view::visibility_order(job.frame->factorisation, {low, high}).front() == 0;
    std::vector<RgbaF> both{low_first ? red : green};
    image::over(both, std::vector<RgbaF>{low_first ? green : red});
    const RgbaF& seen = window.pixels.at(9, 6);
    EXPECT_NEAR(seen.r, both[0].r, 2.0 / 65535);
    EXPECT_NEAR(seen.g, both[0].g, 2.0 / 65535);
    EXPECT_NEAR(seen.a, both[0].a, 2.0 / 65535);
    EXPECT_EQ(window.pixels.at(0, 0).a, 0) << "where nobody has anything";
}

TEST_F(Merging, SendsUpWhatItWouldHaveMerged) {
    image::Canvas canvas = canvas_of(job);
    merge_into(canvas, job);
    const wire::Message up = merge_coded(job);
    EXPECT_EQ(std::get<pb::Windows>(up.body).frame(), 1U);
    const auto band = wire::windows_from(up, job.frame->bands, 0);
    ASSERT_TRUE(band);
    EXPECT_EQ(band->window.rect, view::bounding(low_rect, high_rect));
    image::Canvas sent = canvas_of(job);
    sent.lay(job.frame->bands[0], {&band->window, 1});
    const auto wanted = canvas.windows()[0].pixels.pixels();
    const auto got = sent.windows()[0].pixels.pixels();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_NEAR(got[i].g, wanted[i].g, 0.51 / 65535);
        EXPECT_NEAR(got[i].a, wanted[i].a, 0.51 / 65535);
    }
}

// The slowest path's time, everyone's work, and the time and the bytes of this junction on top.
TEST_F(Merging, AddsUpWhatItCost) {
    EXPECT_EQ(job.bytes(), payload);
    job.frame->seconds = 1;  // of bands before
    const wire::Message up = merge_coded(job);
    const pb::LeafStats& stats = std::get<pb::Windows>(up.body).stats();
    EXPECT_EQ(stats.render_seconds(), 2e6);
    EXPECT_GT(stats.composite_seconds(), 4e6 + 1) << "coding, and merging here";
    EXPECT_LT(stats.composite_seconds(), 5e6) << "not the sum of both paths";
    EXPECT_EQ(stats.samples(), 1100U);
    EXPECT_EQ(stats.window_bytes(), payload);
}

TEST_F(Merging, NamesWhatIsMissing) {
    job.windows.pop_back();
    job.payloads.pop_back();
    job.account.missing.push_back({4, high});
    const wire::Message up = merge_coded(job);
    const auto& body = std::get<pb::Windows>(up.body);
    ASSERT_EQ(body.missing_size(), 1);
    EXPECT_EQ(body.missing(0).place(), 4U);
    EXPECT_TRUE(wire::windows_from(up, job.frame->bands, 0));
}

TEST_F(Merging, PassesOnWhatOneChildAloneHas) {
    job.windows.pop_back();
    job.payloads.pop_back();
    const wire::Message up = merge_coded(job);
    EXPECT_EQ(up.payload, job.payloads[0]) << "not a copy";
    EXPECT_EQ(wire::windows_from(up, job.frame->bands, 0)->window.rect, job.windows[0].rect);
}

// Before the last band nobody knows yet.
TEST_F(Merging, SaysWhatItCostWithTheLastBandAlone) {
    job.frame->bands.push_back(job.frame->bands[0]);
    const wire::Message up = merge_coded(job);
    const auto& body = std::get<pb::Windows>(up.body);
    EXPECT_EQ(body.bands(), 1U);
    EXPECT_FALSE(body.has_stats());
    EXPECT_GT(job.frame->seconds, 0);
}

// Bands before the one that has something are made transparent.
TEST_F(Merging, LaysEmptyBands) {
    MergedFrame& frame = *job.frame;
    const view::Rect whole = frame.bands[0].rect;
    frame.bands = {{0, {0, 0, whole.x1, 1}}, {0, {0, 1, whole.x1, 2}}, {0, {0, 2, whole.x1, whole.y1}}};
    job.end = 3;
    image::Canvas canvas = canvas_of(job);
    const image::Window dirt = filled(whole, red);
    const image::CodedWindows coded = image::encode({&dirt, 1});
    canvas.lay({0, whole}, coded.windows);
    merge_into(canvas, job);
    const image::Window& window = canvas.windows()[0];
    for (int y = 0; y < 3; ++y) {
        EXPECT_TRUE(
            std::ranges::all_of(window.pixels.row(y).first(2), [](const RgbaF& p) { return p.a == 0; }));
    }
}

}  // namespace
}  // namespace shearwater::node
