// What is kept of a window, there and back, and what is refused.

#include "common/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "common/image/png.h"
#include "common/scene/file.h"
#include "tests/support/temporary_folder.h"

namespace shearwater::scene {
namespace {

using testing::HasSubstr;

Scene example() {
    Scene scene{.cube = "galaxy \"7\".fits",
                .viewpoint = {.orbit = {-123.456, 17.25, 0.1 + 0.2, {1, -2.5, 1.0 / 3}, 12},
                              .projection = view::Projection::parallel,
                              .fov = 42.5},
                .size = {656, 614}};
    scene.tf.opacity_pins = {view::Ramp{0.1, 0, 0.9, 0.3}, view::Hat{0.5, 0.1, 0.2, 0.7}, view::Flat{0.001},
                             view::Blank{0.2, 0.3}};
    scene.tf.colour_pins = {{0, {0, 0, 0}}, {0.25, {0.1, 0.9, 1.0 / 3}}, {1, {1, 1, 1}}};
    scene.tf.background = {0.1, 0.2, 0.3};
    scene.level_of_detail = false;
    scene.classify = view::Classify::pre_integrated;
    scene.culling = {culling::Kind::opof_linear, 0.75};
    scene.quality = view::Quality::draft;
    scene.target_rate = 33;
    scene.crop = volume::Box{{1, 0, 3}, {10, 20, 30}};
    scene.scaling = {-0.25, 1.0 / 3, volume::Stretch::asinh};
    scene.stereo =
        Pair{{.separation = 0.1 + 0.2, .convergence = 70, .swap = true}, image::StereoMode::anaglyph};
    return scene;
}

TEST(Scene, ComesBackExactly) {
    const Scene plain{.size = {800, 600}};
    for (const Scene& scene : {example(), plain}) {
        const auto back = scene_from_toml(to_toml(scene), "test");
        ASSERT_TRUE(back) << back.error().message() << "\n" << to_toml(scene);
        EXPECT_EQ(*back, scene) << to_toml(scene);
    }
    for (int i = 0; i < 4; ++i) {
        Scene scene = example();
        scene.quality = i > 0 ? std::optional(static_cast<view::Quality>(i - 1)) : std::nullopt;
        scene.level_of_detail = i < 2 ? std::optional(i == 0) : std::nullopt;
        scene.culling.kind = static_cast<culling::Kind>(i);
        EXPECT_EQ(scene_from_toml(to_toml(scene), "test").value(), scene);
    }
}

// A text cut at any byte but its last line's end lacks something, and says so.
TEST(Scene, CutAtAnyByteIsRefused) {
    const std::string whole = to_toml(example());
    ASSERT_EQ(whole.back(), '\n');
    for (std::size_t bytes = 0; bytes + 1 < whole.size(); ++bytes) {
        const auto cut = scene_from_toml(whole.substr(0, bytes), "test");
        ASSERT_FALSE(cut) << whole.substr(0, bytes);
        EXPECT_EQ(cut.error().message().find('\n'), std::string::npos);
    }
}

TEST(Scene, WhatIsWrongIsSaidWithItsLine) {
    const std::string good = to_toml(example());
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        const auto read = scene_from_toml(text, "test");
        return read ? std::string("it was taken") : read.error().message();
    };
    EXPECT_THAT(with("version = 1", "version = 2"), HasSubstr("version 2"));
    EXPECT_THAT(with("version = 1", ""), HasSubstr("no session"));
    EXPECT_THAT(with("version = 1", "version = 1\nmode = 3"), HasSubstr("line 3: unknown key \"mode\""));
    EXPECT_THAT(with("roll = 12.0", "roll = \"much\""), HasSubstr("roll should be a number"));
    EXPECT_THAT(with("roll = 12.0\n", ""), HasSubstr("roll is missing"));
    EXPECT_THAT(with("roll = 12.0", "roll = nan"), HasSubstr("roll should be a number"));
    EXPECT_THAT(with("elevation = 17.25", "elevation = 91"), HasSubstr("elevation"));
    EXPECT_THAT(with("fov = 42.5", "fov = 0"), HasSubstr("field of view"));
    EXPECT_THAT(with("size = [656, 614]", "size = [656, 61400]"), HasSubstr("8192"));
    EXPECT_THAT(with("size = [656, 614]", "size = [656]"), HasSubstr("size should be 2 numbers"));
    EXPECT_THAT(with("target = [1.0,", "target = [inf,"), HasSubstr("target"));
    EXPECT_THAT(with("distance = 0.3", "distance = -0.3"), HasSubstr("distance"));
    EXPECT_THAT(with("\"pre-integrated\"", "\"sometimes\""), HasSubstr("post, pre-integrated"));
    EXPECT_THAT(with("target_rate = 33.0", "target_rate = 1e9"), HasSubstr("60"));
    EXPECT_THAT(with("culling_threshold = 0.75", "culling_threshold = 7"), HasSubstr("threshold"));
    EXPECT_THAT(with("kind = \"hat\"", "kind = \"cap\""), HasSubstr("unknown kind"));
    EXPECT_THAT(with("[camera]", "[camera"), HasSubstr("line "));
    EXPECT_THAT(with("[camera]\n", "[camera]\nzoom = 1\n"), HasSubstr("unknown key \"zoom\" in [camera]"));
    EXPECT_FALSE(scene_from_toml(std::string(2 << 20, ' '), "test"));
}

// Bytes changed at random are refused, or give a scene that is in range.
TEST(Scene, AnyTextIsTakenWholeOrRefused) {
    const std::string good = to_toml(example());
    std::mt19937 random(5);
    for (int i = 0; i < 3000; ++i) {
        std::string text = good;
        for (int n = 0; n < 3; ++n) {
            text[random() % text.size()] = static_cast<char>(random() % (i % 2 == 0 ? 256 : 128));
        }
        if (const auto read = scene_from_toml(text, "test")) {
            EXPECT_TRUE(validate(*read));
        }
    }
}

class SceneFile : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    support::TemporaryFolder folder_;
};

TEST_F(SceneFile, IsTomlOrAPicture) {
    ASSERT_TRUE(write(path("a.toml"), example()));
    EXPECT_EQ(read(path("a.toml")).value(), example());
    Scene other = example();
    other.viewpoint.orbit.azimuth = 5;
    ASSERT_TRUE(write(path("a.toml"), other)) << "a session is written over";
    EXPECT_EQ(read(path("a.toml")).value(), other);

    const image::Image<image::Rgba8> picture(12, 9);
    ASSERT_TRUE(write_picture(path("a.png"), example(), picture));
    EXPECT_EQ(read(path("a.png")).value(), example());
    EXPECT_TRUE(image::read_png(path("a.png")));
}

TEST_F(SceneFile, OfAnyOtherKindIsRefusedAndLeftAlone) {
    const std::string data = "SIMPLE  =                    T";
    std::ofstream(path("cube.fits")) << data;
    ASSERT_TRUE(image::write_png(path("plain.png"), image::Image<image::Rgba8>(12, 9)));
    for (const char* name : {"cube.fits", "plain.png"}) {
        EXPECT_FALSE(read(path(name)));
        EXPECT_FALSE(write(path(name), example()));
    }
    std::ifstream kept(path("cube.fits"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), data);
    EXPECT_TRUE(image::read_png(path("plain.png")));
    EXPECT_FALSE(read(path("none.toml")));
    EXPECT_FALSE(read(folder_.path().string()));
}

}  // namespace
}  // namespace shearwater::scene
