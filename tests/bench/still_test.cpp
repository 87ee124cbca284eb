// A client without a window asks for one view after another, and turns in between.

#include "deploy/still.h"

#include <gtest/gtest.h>

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

TEST(Still, TurnsFromPictureToPicture) {
    const view::Lattice lattice{.n = {20, 20, 20}};
    const view::ImageSize size{.width = 8, .height = 6};
    ViewOptions options;
    options.orbit.azimuth = 10;
    options.size = "8x6";
    constexpr int times = 3;
    Still still({.host = "127.0.0.1", .port = 1}, options, view::default_transfer_function(), size,
                {.times = times, .turn = 25});
    wire::Time now{};
    still.start(now);
    pb::CubeDescription cube;
    *cube.mutable_lattice() = wire::to_wire(lattice);
    wire::NetEvent event = wire::Received{.link = wire::LinkId{1}, .message = wire::message(cube)};
    for (int i = 0; i < times; ++i) {
        const auto view = asked(still.handle(event, now));
        ASSERT_TRUE(view) << i;
        EXPECT_FALSE(view->sketch) << "it waits for the cube";
        ViewOptions expected = options;
        expected.orbit.azimuth = 10 + 25 * i;
        EXPECT_EQ(view->camera, *expected.camera(lattice));
        EXPECT_FALSE(still.done());
        EXPECT_LT(still.progress(), 1);
        base::Workers workers(1);
        pb::Frame frame;
        frame.set_number(static_cast<std::uint64_t>(i) + 1);
        frame.set_revision(view->revision);
        event =
            wire::Received{.link = wire::LinkId{1},
                           .message = wire::frame_message(
                               frame, image::Image<image::Rgba8>(size.width, size.height), false, workers)};
    }
    still.handle(event, now);
    EXPECT_TRUE(still.done());
    const auto picture = still.take();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->each.size(), 3U);
}

}  // namespace
}  // namespace shearwater::deploy
