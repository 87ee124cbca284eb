// A client without a window asks for one view after another, and turns in between.

#include "deploy/still.h"

#include <gtest/gtest.h>

#include "common/image/rle.h"
#include "protocol/wire/picture.h"

namespace shearwater::deploy {
namespace {

namespace pb = wire::pb;

// The view that the effects ask for.
std::optional<wire::View> asked(const std::vector<wire::NetEffect>& effects) {
    for (const wire::NetEffect& effect : effects) {
        if (const auto* send = std::get_if<wire::Send>(&effect)) {
            if (const auto* view = std::get_if<pb::SetView>(&send->message.body)) {
                const auto parsed = wire::view_from(*view);
                return parsed ? std::optional(*parsed) : std::nullopt;
            }
        }
    }
    return std::nullopt;
}

const view::Lattice lattice{.n = {20, 20, 20}};
const view::ImageSize size{.width = 8, .height = 6};

ViewOptions options_from(double azimuth) {
    ViewOptions options;
    options.orbit.azimuth = azimuth;
    options.size = "8x6";
    return options;
}

Still still_of(int pictures, int in_flight) {
    return {wire::Address{.host = "127.0.0.1", .port = 1},
            options_from(10),
            size,
            script_of(options_from(10), {.tf = view::default_transfer_function()}, pictures, 25, in_flight)};
}

wire::NetEvent description() {
    pb::CubeDescription cube;
    *cube.mutable_lattice() = wire::to_wire(lattice);
    return wire::Received{.link = wire::LinkId{1}, .message = wire::message(cube)};
}

wire::NetEvent frame_of(std::uint64_t revision) {
    base::Workers workers(1);
    pb::Frame frame;
    frame.set_number(revision);
    frame.set_revision(revision);
    const image::Image<image::Rgba8> picture(size.width, size.height);
    return wire::Received{
        .link = wire::LinkId{1},
        .message = wire::frame_message(frame, size, 1, image::encode_rle(picture.pixels(), workers), false)};
}

TEST(Still, TurnsFromPictureToPicture) {
    constexpr int times = 3;
    Still still = still_of(times, 1);
    const wire::Time now{};
    still.start(now);
    wire::NetEvent event = description();
    for (int i = 0; i < times; ++i) {
        const auto view = asked(still.handle(event, now));
        ASSERT_TRUE(view) << i;
        EXPECT_FALSE(view->sketch) << "it waits for the cube";
        EXPECT_EQ(view->camera, *options_from(10 + 25 * i).camera(lattice));
        EXPECT_FALSE(still.done());
        EXPECT_LT(still.progress(), 1);
        EXPECT_FALSE(asked(still.handle(wire::Tick{}, now))) << "one after the other";
        event = frame_of(view->revision);
    }
    still.handle(event, now);
    EXPECT_TRUE(still.done());
    const auto picture = still.take();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->each.size(), 3U);
}

// From the second on, and never two views at once, of which the newer would take the other's place.
TEST(Still, AsksAhead) {
    Still still = still_of(4, 2);
    const wire::Time now{};
    still.start(now);
    const auto revision = [&](const wire::NetEvent& event) -> std::uint64_t {
        const auto view = asked(still.handle(event, now));
        return view ? view->revision : 0;
    };
    EXPECT_EQ(revision(description()), 1U);
    EXPECT_EQ(revision(wire::Tick{}), 0U)
        << "the cube may be loading, and only the newest view be drawn then";
    EXPECT_EQ(revision(frame_of(1)), 2U);
    EXPECT_EQ(revision(wire::Tick{}), 3U);
    EXPECT_EQ(revision(wire::Tick{}), 0U);
    EXPECT_EQ(revision(frame_of(2)), 4U);
    EXPECT_EQ(revision(frame_of(3)), 0U) << "there are no more";
    EXPECT_FALSE(still.done());
    EXPECT_EQ(revision(frame_of(4)), 0U);
    EXPECT_TRUE(still.done());
    const auto picture = still.take();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->each.size(), 4U);
}

// A server that is busy draws only the newest of what waits: each picture comes all the same.
TEST(Still, AsksAgainForWhatWasPassedOver) {
    std::vector<int> kept;
    Script script = script_of(options_from(10), {.tf = view::default_transfer_function()}, 4, 25, 2);
    script.keep = [&](int index, const image::Image<image::Rgba8>&) {
        kept.push_back(index);
        return base::Status{};
    };
    Still still(wire::Address{.host = "127.0.0.1", .port = 1}, options_from(10), size, script);
    const wire::Time now{};
    still.start(now);
    const auto view_after = [&](const wire::NetEvent& event) { return asked(still.handle(event, now)); };
    ASSERT_TRUE(view_after(description()));
    ASSERT_TRUE(view_after(frame_of(1)));
    const auto third = view_after(wire::Tick{});
    ASSERT_TRUE(third);
    auto next = view_after(frame_of(third->revision));  // the second never came
    ASSERT_TRUE(next);
    EXPECT_EQ(next->camera, *options_from(35).camera(lattice));
    next = view_after(frame_of(next->revision));
    ASSERT_TRUE(next);
    view_after(frame_of(next->revision));
    EXPECT_TRUE(still.done());
    EXPECT_EQ(kept, (std::vector<int>{0, 2, 1, 3}));
}

}  // namespace
}  // namespace shearwater::deploy
