// What a junction makes of its children's windows.

#include "protocol/node/merge.h"

#include <gtest/gtest.h>

#include "common/image/over.h"
#include "protocol/node/branch.h"

namespace shearwater::node {
namespace {

namespace pb = wire::pb;
using image::RgbaF;
using wire::LinkId;

const volume::Box low{{0, 0, 0}, {4, 8, 8}};
const volume::Box high{{4, 0, 0}, {8, 8, 8}};

view::Factorisation factorisation() {
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
    Merged drawn{.frame = 1, .windows = {}, .missing = {}, .stats = {}};
    drawn.windows.push_back(filled(rect, pixel));
    drawn.stats.set_render_seconds(seconds);
    drawn.stats.set_composite_seconds(2 * seconds);
    drawn.stats.set_samples(samples);
    return to_message(drawn);
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
        branch.begin(factorisation(), render, {}, effects);
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

TEST_F(Merging, LaysTheNearerOverTheFarther) {
    const Merged merged = merge(job);
    ASSERT_EQ(merged.windows.size(), 1U);
    const image::Window& window = merged.windows[0];
    EXPECT_EQ(window.rect, view::bounding(low_rect, high_rect));
    const bool low_first = view::visibility_order(job.factorisation, {low, high}).front() == 0;
    std::vector<RgbaF> both{low_first ? red : green};
    image::over(both, std::vector<RgbaF>{low_first ? green : red});
    const RgbaF& seen = window.pixels.at(9 - window.rect.x0, 6 - window.rect.y0);
    EXPECT_NEAR(seen.r, both[0].r, 2.0 / 65535);
    EXPECT_NEAR(seen.g, both[0].g, 2.0 / 65535);
    EXPECT_NEAR(seen.a, both[0].a, 2.0 / 65535);
}

TEST_F(Merging, SendsUpWhatItWouldHaveMerged) {
    const wire::Message up = merge_coded(job);
    EXPECT_EQ(std::get<pb::Windows>(up.body).frame(), 1U);
    const auto windows = wire::windows_from(up, job.factorisation);
    ASSERT_TRUE(windows);
    const auto got = image::merge_front_to_back(*windows);
    const Merged merged = merge(job);
    ASSERT_EQ(got.size(), 1U);
    ASSERT_EQ(got[0].rect, merged.windows.at(0).rect);
    const auto wanted = merged.windows[0].pixels.pixels();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_NEAR(got[0].pixels.pixels()[i].g, wanted[i].g, 0.51 / 65535);
        EXPECT_NEAR(got[0].pixels.pixels()[i].a, wanted[i].a, 0.51 / 65535);
    }
}

// The slowest path's time, everyone's work, and the time and the bytes of this junction on top.
TEST_F(Merging, AddsUpWhatItCost) {
    EXPECT_EQ(job.bytes(), payload);
    for (const pb::LeafStats& stats :
         {merge(job).stats, std::get<pb::Windows>(merge_coded(job).body).stats()}) {
        EXPECT_EQ(stats.render_seconds(), 2e6);
        EXPECT_GT(stats.composite_seconds(), 4e6) << "coding, and merging here";
        EXPECT_LT(stats.composite_seconds(), 5e6) << "not the sum of both paths";
        EXPECT_EQ(stats.samples(), 1100U);
        EXPECT_EQ(stats.window_bytes(), payload);
    }
}

TEST_F(Merging, NamesWhatIsMissing) {
    job.parts[1].present = false;
    job.parts[1].windows.clear();
    job.missing.push_back({4, high});
    const wire::Message up = merge_coded(job);
    const auto& body = std::get<pb::Windows>(up.body);
    ASSERT_EQ(body.missing_size(), 1);
    EXPECT_EQ(body.missing(0).place(), 4U);
    const auto windows = wire::windows_from(up, job.factorisation);
    ASSERT_EQ(windows->size(), 1U);
    EXPECT_EQ((*windows)[0].rect, low_rect);
}

}  // namespace
}  // namespace shearwater::node
