// Flight paths as files.

#include "common/flight/path_toml.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace shearwater::flight {
namespace {

const std::string whole_path = R"(fps = 30

[[cube]]
path = "a.fits"
percentile = 99.0
stretch = "log"
bits = 16
hdu = 1
plane = 2
spacing = [1.0, 1.0, 2.5]

[[cube]]
path = "/there/b.fits"
range = [0.5, 3.0]

[[key]]
time = 0
azimuth = 10
distance = 200.5
limits = [-1, 2.5]
stretch = "log"
[key.tf]
colourmap = "viridis"
[[key.tf.opacity]]
kind = "flat"
height = 0.25

[[key]]
time = 1.5
limits = [0, 3]

[[key]]
time = 2.5
cube = 2
azimuth = 370
elevation = -5
target = [1, 2, 3]
projection = "parallel"
fov = 40
)";

TEST(FlightFile, IsReadAndInheritsFromKeyToKey) {
    const auto path = path_from_toml(whole_path, "here", "/folder");
    ASSERT_TRUE(path) << path.error().message();
    EXPECT_EQ(path->fps, 30);
    ASSERT_EQ(path->cubes.size(), 2U);
    EXPECT_EQ(path->cubes[0].path, "/folder/a.fits");
    EXPECT_EQ(path->cubes[0].stretch, "log");
    EXPECT_EQ(path->cubes[0].bits, 16);
    EXPECT_EQ(path->cubes[0].hdu, 1);
    EXPECT_EQ(path->cubes[0].plane, 2);
    EXPECT_EQ(path->cubes[0].spacing, (std::vector<double>{1, 1, 2.5}));
    EXPECT_EQ(path->cubes[1].path, "/there/b.fits");
    EXPECT_EQ(path->cubes[1].range, (std::vector<double>{0.5, 3}));
    ASSERT_EQ(path->keys.size(), 3U);
    EXPECT_EQ(path->keys[0].viewpoint.orbit.elevation, view::Orbit{}.elevation);
    EXPECT_EQ(path->keys[0].scaling, (volume::Scaling{-1, 2.5, volume::Stretch::log}));
    EXPECT_EQ(path->keys[1].scaling, (volume::Scaling{0, 3, volume::Stretch::log}));
    const Key& last = path->keys[2];
    EXPECT_FALSE(last.scaling) << "of another cube";
    EXPECT_EQ(last.cube, 1U);
    EXPECT_EQ(last.viewpoint.orbit.azimuth, 370);
    EXPECT_EQ(last.viewpoint.orbit.distance, 200.5) << "as before";
    EXPECT_EQ(last.viewpoint.orbit.target, view::Vec3(1, 2, 3));
    EXPECT_EQ(last.viewpoint.projection, view::Projection::parallel);
    EXPECT_EQ(last.tf, path->keys[0].tf);
    EXPECT_EQ(last.tf.opacity_pins, (std::vector<view::OpacityPin>{view::Flat{0.25}}));
}

TEST(FlightFile, ReadsBackAsWritten) {
    const auto path = path_from_toml(whole_path, "here", "/folder");
    ASSERT_TRUE(path);
    const std::string text = to_toml(*path);
    const auto again = path_from_toml(text, "again", "");
    ASSERT_TRUE(again) << again.error().message() << "\n" << text;
    EXPECT_EQ(to_toml(*again), text);
    EXPECT_EQ(again->keys, path->keys);
    EXPECT_EQ(again->cubes[1].range, path->cubes[1].range);
}

TEST(FlightFile, FindsTransferFunctionsBesideIt) {
    const support::TemporaryFolder scratch;
    std::ofstream(scratch.path("shell.toml")) << "[[opacity]]\nkind = \"flat\"\nheight = 0.5\n";
    std::ofstream(scratch.path("path.toml")) << "[[key]]\ntime = 0\ntf = \"shell.toml\"\n";
    const auto path = read_path(scratch.path("path.toml"));
    ASSERT_TRUE(path) << path.error().message();
    EXPECT_EQ(path->keys[0].tf.opacity_pins, (std::vector<view::OpacityPin>{view::Flat{0.5}}));
}

TEST(FlightFile, MistakesAreNamed) {
    const auto fault = [](const std::string& text) {
        const auto path = path_from_toml(text, "here", "");
        return path ? "none" : path.error().message();
    };
    const std::string key = "[[key]]\ntime = 0\n";
    const std::pair<std::string, std::string> cases[] = {
        {"", "key"},
        {"fps = 0\n" + key, "fps"},
        {"fps = 2.5\n" + key, "fps"},
        {"speed = 3\n" + key, "speed"},
        {"key = 3", "[[key]]"},
        {"[[key]]\nazimuth = 3", "time"},
        {key + "azimuth = 'north'", "azimuth"},
        {key + "target = [1, 2]", "target"},
        {key + "projection = 'fisheye'", "fisheye"},
        {key + "zoom = 3", "zoom"},
        {key + "cube = 0", "from 1"},
        {key + "tf = '/nowhere.toml'", "tf"},
        {key + "[key.tf]\ncolourmap = 'mud'", "mud"},
        {key + "[[key]]\ntime = 0", "key 2"},
        {"[[cube]]\npercentile = 5\n" + key, "path"},
        {"[[cube]]\npath = 'x'\nbits = 12\n" + key, "bits"},
        {"[[cube]]\npath = 'x'\nstretch = 'cubic'\n" + key, "cubic"},
        {"[[cube]]\npath = 'x'\nrange = [2, 1]\n" + key, "below"},
        {"[[cube]]\npath = 'x'\n" + key + "cube = 2", "cube 2"},
        {"[[key", "line 1"},
    };
    for (const auto& [text, word] : cases) {
        EXPECT_NE(fault(text).find(word), std::string::npos) << text << "\n" << fault(text);
    }
}

TEST(FlightFile, CutAnywhereItIsAPathOrAMistake) {
    for (std::size_t cut = 0; cut < whole_path.size(); ++cut) {
        const auto path = path_from_toml(whole_path.substr(0, cut), "here", "");
        if (path) {
            EXPECT_TRUE(validate(*path));
        } else {
            EXPECT_FALSE(path.error().message().empty());
        }
    }
}

}  // namespace
}  // namespace shearwater::flight
