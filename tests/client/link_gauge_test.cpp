// What a link's speed makes of the pictures that are asked for.

#include "client/model/link_gauge.h"

#include <random>

#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

using Seconds = LinkGauge::Seconds;
constexpr view::ImageSize full{.width = 512, .height = 400};

// A link and a server: how pictures of some bytes a pixel come, by either coding.
struct Link {
    double speed;                             // bytes a second
    double plain = 3, deflated = 1.5;         // bytes a pixel
    double coding = 1e-9, deflating = 60e-9;  // seconds a pixel

    LinkGauge::Carried carry(const view::ImageSize& size, bool deflate) const {
        const double pixels = size.width * size.height;
        const double bytes = pixels * (deflate ? deflated : plain);
        return {.bytes = static_cast<std::size_t>(bytes),
                .size = size,
                .deflated = deflate,
                .coding = Seconds(pixels * (deflate ? deflating : coding)),
                .arriving = Seconds(bytes / speed)};
    }
    // What it settles on at a rate.
    LinkGauge::Carried settle(LinkGauge& gauge, double rate) const {
        LinkGauge::Carried last = carry(full, false);
        for (int i = 0; i < 30; ++i) {
            gauge.count(last);
            const view::ImageSize size = gauge.size_at_rate(full, rate);
            last = carry(size, gauge.wants_deflate(size));
        }
        return last;
    }
};

TEST(LinkGauge, KnowsNothingAtFirst) {
    LinkGauge gauge;
    EXPECT_FALSE(gauge.speed());
    EXPECT_FALSE(gauge.wants_deflate(full));
    EXPECT_EQ(gauge.size_at_rate(full, 20), full);
    gauge.count({.bytes = 1000, .size = full, .deflated = false, .coding = {}, .arriving = Seconds(1e-6)});
    EXPECT_FALSE(gauge.speed()) << "a packet says nothing";
}

TEST(LinkGauge, AFastLinkChangesNothing) {
    LinkGauge gauge;
    const auto settled = Link{.speed = 2e9}.settle(gauge, 20);
    EXPECT_EQ(settled.size, full);
    EXPECT_FALSE(settled.deflated);
    EXPECT_NEAR(*gauge.speed(), 2e9, 1e7);
}

TEST(LinkGauge, ASlowLinkGetsDeflatedPicturesOfASizeThatComesInTime) {
    for (const double speed : {12.5e6, 1.25e6, 0.4e6}) {
        LinkGauge gauge;
        const auto settled = Link{.speed = speed}.settle(gauge, 20);
        EXPECT_TRUE(settled.deflated) << speed;
        EXPECT_LE(settled.arriving.count(), 1.0 / 20) << speed;
        EXPECT_TRUE(settled.size == full || settled.arriving.count() > 0.5 / 20)
            << speed << ": no smaller than that asks for";
        EXPECT_NEAR(static_cast<double>(settled.size.width) / settled.size.height, 512.0 / 400, 0.02);
    }
}

TEST(LinkGauge, PicturesAreNeverSmallerThanTheLeast) {
    LinkGauge gauge;
    const auto settled = Link{.speed = 1e4}.settle(gauge, 20);
    EXPECT_EQ(settled.size.width, 64);
    EXPECT_EQ(settled.size.height, 50);
}

TEST(LinkGauge, DeflatesOnlyWhereItIsWorthTheServersTime) {
    LinkGauge dense;  // what deflate cannot make smaller
    EXPECT_FALSE(Link({.speed = 12.5e6, .plain = 3, .deflated = 2.9}).settle(dense, 20).deflated);
    LinkGauge busy;  // a server that takes longer for it than the link saves
    EXPECT_FALSE(Link({.speed = 12.5e6, .deflating = 400e-9}).settle(busy, 20).deflated);
}

TEST(LinkGauge, SizesDoNotFlicker) {
    LinkGauge gauge;
    const Link link{.speed = 6e6};
    auto last = link.settle(gauge, 20);
    std::mt19937 random(5);
    int changes = 0;
    for (int i = 0; i < 200; ++i) {
        auto carried = link.carry(last.size, last.deflated);
        const double noise = std::uniform_real_distribution<double>(0.9, 1.1)(random);
        carried.arriving *= noise;
        gauge.count(carried);
        const view::ImageSize size = gauge.size_at_rate(full, 20);
        changes += size != last.size ? 1 : 0;
        last.size = size;
    }
    EXPECT_LE(changes, 4);
}

TEST(LinkGauge, HostileFiguresDoNoHarm) {
    LinkGauge gauge;
    for (const double coding : {std::nan(""), -1.0, 1e300, std::numeric_limits<double>::infinity()}) {
        gauge.count({.bytes = 100000,
                     .size = full,
                     .deflated = true,
                     .coding = Seconds(coding),
                     .arriving = Seconds(0.01)});
        const view::ImageSize size = gauge.size_at_rate(full, 20);
        EXPECT_GE(size.width, 16);
        EXPECT_LE(size.width, full.width);
        gauge.wants_deflate(size);
    }
}

// The session at work over such a link: small while it moves, whole when it rests.
TEST_F(SessionTest, PicturesFollowTheLinkWhileTheViewMoves) {
    wish_.size = {512, 512};
    connect();
    std::mt19937 random(1);
    const auto answer_slowly = [&](std::chrono::milliseconds arriving) {
        const wire::View view = views_.back();
        image::Image<image::Rgba8> noise(view.size.width, view.size.height);
        for (auto& p : noise.pixels()) {
            p = {static_cast<std::uint8_t>(random()), 0, 0, 255};
        }
        now_ += 40ms;
        auto f = frame(view.revision);
        f.set_width(static_cast<std::uint32_t>(view.size.width));
        f.set_height(static_cast<std::uint32_t>(view.size.height));
        f.set_encoding(view.deflate ? pb::ENCODING_RLE_DEFLATE : pb::ENCODING_RLE);
        auto bytes = code(noise);
        bytes = view.deflate ? image::deflate(bytes) : bytes;
        event(wire::Received{link(), wire::message(std::move(f), std::move(bytes)), arriving});
    };
    turn();
    EXPECT_FALSE(views_.back().deflate);
    for (int i = 0; i < 8; ++i) {
        turn(Change::dragging);
        answer_slowly(200ms);
    }
    EXPECT_LT(views_.back().size.width, 400);
    EXPECT_TRUE(views_.back().deflate || views_[views_.size() - 2].deflate);
    for (int i = 0; i < 3; ++i) {
        pass(300ms);
        answer_slowly(200ms);
    }
    EXPECT_EQ(views_.back().size, wish_.size);
    EXPECT_EQ(views_.back().quality, view::Quality::high);
    EXPECT_FALSE(status().refining);
    // A fixed quality is the person's own choice: its size too.
    session_.set_effort({.fixed = view::Quality::normal}, now_);
    turn(Change::dragging);
    EXPECT_EQ(views_.back().size, wish_.size);
}

}  // namespace
}  // namespace shearwater::model
