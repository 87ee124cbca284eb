// The command as a person types it: pictures, mistakes, unusable files.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <tuple>

#include "common/image/png.h"
#include "common/scene/file.h"
#include "tests/support/command.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"

namespace shearwater {
namespace {

using support::expect_mistake;
using support::Outcome;
using support::run;

class Commands : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(samples::write_sample("nbody-web", {31, 33, 29}, 3, cube_)); }

    support::TemporaryFolder scratch_;
    std::string cube_ = scratch_.path("cube.fits");
    std::string png_ = scratch_.path("out.png");
};

TEST_F(Commands, SnapshotIsTheSameWithAndWithoutDaemons) {
    for (const std::string view : {"--azimuth 77 --elevation -20 --size 201x133", "--parallel --quality high",
                                   "--azimuth 130 --classify pre-integrated --size 150x140"}) {
        ASSERT_EQ(run("snapshot " + cube_ + " -o " + png_ + " --tree 1,1 " + view).status, 0);
        const auto single = image::read_png(png_);
        ASSERT_EQ(run("snapshot " + cube_ + " -o " + png_ + " --tree 3,2 " + view).status, 0);
        const auto tree = image::read_png(png_);
        ASSERT_TRUE(single && tree);
        EXPECT_TRUE(support::lit(*single));
        EXPECT_LE(support::difference(*single, *tree).largest, 1);
    }
}

// Pairs and crops too; and a pair's parts are its eyes'.
TEST_F(Commands, PairsOfEyesAreTheSameWithAndWithoutDaemons) {
    const std::string view = "snapshot " + cube_ + " -o " + png_ + " --azimuth 70 --size 120x90 ";
    const auto picture = [&](const std::string& more) {
        const Outcome outcome = run(view + more);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        auto read = image::read_png(png_);
        EXPECT_TRUE(read);
        return read ? *std::move(read) : image::Image<image::Rgba8>();
    };
    for (const auto& [mode, width, height] : {std::tuple("side-by-side", 240, 90),
                                              {"top-bottom", 120, 180},
                                              {"anaglyph", 120, 90},
                                              {"interlaced", 120, 90}}) {
        const std::string options = "--stereo " + std::string(mode) + " --eye-separation 4 --convergence 50 ";
        const auto single = picture(options + "--tree 1,1");
        const auto tree = picture(options + "--tree 2,3");
        ASSERT_EQ(single.width(), width);
        ASSERT_EQ(single.height(), height);
        EXPECT_TRUE(support::lit(single));
        // An anaglyph takes from one what leaks from the other, and the dark of sRGB is steep.
        EXPECT_LE(support::difference(single, tree).largest, mode == std::string("anaglyph") ? 6 : 1) << mode;
    }
    const auto pair = picture("--tree 1,1 --stereo side-by-side");
    const auto left = picture("--tree 1,1 --stereo left"), right = picture("--tree 1,1 --stereo right");
    const auto swapped = picture("--tree 1,1 --stereo side-by-side --swap-eyes");
    const auto one = picture("--tree 1,1 --stereo off");
    EXPECT_GT(support::difference(left, right).largest, 8);
    EXPECT_GT(support::difference(left, one).largest, 8);
    for (int y = 0; y < 90; ++y) {
        for (int x = 0; x < 120; ++x) {
            ASSERT_EQ(pair.at(x, y), left.at(x, y));
            ASSERT_EQ(pair.at(120 + x, y), right.at(x, y));
            ASSERT_EQ(swapped.at(x, y), right.at(x, y));
            ASSERT_EQ(swapped.at(120 + x, y), left.at(x, y));
        }
    }
    const std::string crop = "--crop 5 20 0 32 9 25 --tree ";
    const auto cropped = picture(crop + "1,1");
    EXPECT_LE(support::difference(cropped, picture(crop + "3,2")).largest, 1);
    EXPECT_GT(support::difference(cropped, one).largest, 20);
    EXPECT_TRUE(support::lit(cropped));
}

// By the values of the cube, which a tree counts, with limits given too.
TEST_F(Commands, AFunctionOnAScaleIsDrawnTheSameWithAndWithoutDaemons) {
    for (const std::string unit : {"percentile", "sigma", "value"}) {
        const std::string tf = scratch_.path(unit + ".toml");
        std::ofstream(tf) << "density = 3\n[scale]\nunit = \"" << unit << "\"\n[[opacity]]\nkind = \"ramp\"\n"
                          << (unit == "percentile" ? "x0 = 60\nx1 = 99\n" : "x0 = 0.1\nx1 = 2\n")
                          << "a0 = 0.001\na1 = 0.4\n";
        for (const std::string limits : {"", " --range 0 2"}) {
            const std::string view = " --size 90x70 --tf " + tf + limits + " --tree ";
            const Outcome one = run("snapshot " + cube_ + " -o " + png_ + view + "1,1");
            ASSERT_EQ(one.status, 0) << one.err;
            const auto single = image::read_png(png_);
            const Outcome two = run("snapshot " + cube_ + " -o " + png_ + view + "2,2");
            ASSERT_EQ(two.status, 0) << two.err;
            const auto tree = image::read_png(png_);
            ASSERT_TRUE(single && tree);
            EXPECT_TRUE(support::lit(*single)) << unit << limits;
            EXPECT_LE(support::difference(*single, *tree).largest, 1) << unit << limits;
        }
    }
    expect_mistake("bench frame " + cube_ + " --tf " + scratch_.path("sigma.toml"), "the cube is not known");
    ASSERT_EQ(run("sample slab --size 9 9 9 -o " + cube_).status, 0);
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --tree 1,1 --tf " + scratch_.path("sigma.toml"),
                   "sigma");
}

TEST_F(Commands, ACubeByFormulaIsDrawnLikeTheFileOfIt) {
    const std::string view = " --range 0 255 --azimuth 40 --size 120x90 --tree ";
    ASSERT_EQ(run("sample noise-sources --size 40 34 29 --seed 6 -o " + cube_).status, 0);
    ASSERT_EQ(run("snapshot " + cube_ + " -o " + png_ + view + "1,1").status, 0);
    const auto file = image::read_png(png_);
    ASSERT_TRUE(file);
    EXPECT_TRUE(support::lit(*file));
    for (const std::string tree : {"1,1", "2,3"}) {
        const Outcome outcome = run("snapshot synthetic:noise-sources:40,34,29:6 -o " + png_ + view + tree);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const auto formula = image::read_png(png_);
        ASSERT_TRUE(formula);
        EXPECT_LE(support::difference(*file, *formula).largest, tree == "1,1" ? 0 : 1);
    }
    const Outcome info = run("info synthetic:noise-sources:40,34,29:6");
    EXPECT_EQ(info.status, 0);
    EXPECT_NE(info.out.find("40 x 34 x 29"), std::string::npos) << info.out;
}

TEST_F(Commands, InfoSaysWhatIsMeasuredAlongEachAxis) {
    ASSERT_EQ(run("sample hi-galaxy --size 33 33 21 -o " + cube_).status, 0);
    const Outcome info = run("info " + cube_);
    EXPECT_EQ(info.status, 0);
    // Right ascension falls, declination rises about 30 degrees, velocities about the galaxy's.
    for (const char* line : {"  x         right ascension, 10h0[0-9hms.]+ to 09h5[0-9hms.]+\n",
                             "  y         declination, \\+29\u00b0[0-9'.]+\" to \\+30\u00b0[0-9'.]+\"\n",
                             "  z         radio velocity, -?[0-9.]+ km/s to [0-9.]+ km/s\n"}) {
        EXPECT_TRUE(std::regex_search(info.out, std::regex(line))) << line << info.out;
    }
}

TEST_F(Commands, SnapshotReportsInJson) {
    for (const std::string tree : {"1,1", "2,3"}) {
        const Outcome outcome =
            run("snapshot " + cube_ + " -o " + png_ + " --json - --repeat 3 --tree " + tree);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        for (const char* key : {"seconds", "load", "preprocess", "look", "render", "composite", "warp",
                                "encode", "total", "samples", "bricks", "empty", "culled", "rendered",
                                "culling_by", "bytes", "peak_bytes", "tree"}) {
            EXPECT_NE(outcome.out.find('"' + std::string(key) + '"'), std::string::npos) << key << "\n"
                                                                                         << outcome.out;
        }
        EXPECT_NE(outcome.out.find('"' + tree + '"'), std::string::npos);
        EXPECT_TRUE(outcome.err.empty()) << outcome.err;
    }
}

TEST_F(Commands, SnapshotWritesToStandardOutput) {
    const Outcome outcome = run("snapshot " + cube_ + " -o - --tree 1,1");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out.substr(1, 3), "PNG");
}

// A session says what options would, and may be given in a picture of it.
TEST_F(Commands, ASessionIsDrawnLikeItsOptions) {
    scene::Scene kept{.viewpoint = {.orbit = {40, 10, 60, {}, 15}, .fov = 35}, .size = {96, 71}};
    kept.quality = view::Quality::normal;
    kept.classify = view::Classify::pre_integrated;
    ASSERT_TRUE(scene::write(scratch_.path("kept.toml"), kept));
    ASSERT_TRUE(scene::write_picture(scratch_.path("kept.png"), kept, image::Image<image::Rgba8>(9, 9)));
    const std::string options =
        " --azimuth 40 --elevation 10 --roll 15 --distance 60 --fov 35 --size 96x71 "
        "--classify pre-integrated --tree 1,1";
    ASSERT_EQ(run("snapshot " + cube_ + " -o " + png_ + options).status, 0);
    const auto expected = image::read_png(png_);
    ASSERT_TRUE(expected && support::lit(*expected));
    for (const std::string file : {"kept.toml", "kept.png"}) {
        const std::string by_session =
            "snapshot " + cube_ + " -o " + png_ + " --tree 1,1 --session " + scratch_.path(file);
        const Outcome outcome = run(by_session);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(support::difference(*expected, image::read_png(png_).value()).largest, 0);
        ASSERT_EQ(run(by_session + " --size 48x30 --quality draft").status, 0);
        EXPECT_EQ(image::read_png(png_).value().width(), 48);
        expect_mistake(by_session + " --azimuth 3", "azimuth");
        expect_mistake(by_session + " --lod off", "lod");
    }
    std::ofstream(scratch_.path("kept.toml")) << "version = 1\n[camera]\n";
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --session " + scratch_.path("kept.toml"),
                   "cube is missing");
    expect_mistake("view " + cube_ + " --session " + scratch_.path("kept.toml"), "cube is missing");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --session " + cube_, "session");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --session /nowhere.png", "nowhere");
}

TEST_F(Commands, MistakesGetOneLine) {
    expect_mistake("", "subcommand");
    expect_mistake("paint", "paint");
    expect_mistake("snapshot", "output");
    expect_mistake("snapshot -o " + png_, "cube");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --colour 3", "colour");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --size 0x10", "picture");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --size 99999x99999 --tree 1,1", "pixels");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --size pear", "pear");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --fov 180 --tree 1,1", "field of view");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --fov nan --tree 1,1", "field of view");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --range 2 1", "range");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --spacing 1 0 1", "spacing");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --bits 12", "bits");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --copies 3", "copies");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --lod some", "lod");
    const std::string snapshot = "snapshot " + cube_ + " -o " + png_;
    expect_mistake(snapshot + " --stereo blue", "stereo");
    expect_mistake(snapshot + " --eye-separation 2", "stereo");
    expect_mistake(snapshot + " --swap-eyes", "stereo");
    for (const std::string tree : {" --tree 1,1", " --tree 2,2"}) {
        expect_mistake(snapshot + tree + " --stereo anaglyph --eye-separation -1", "eye-separation");
        expect_mistake(snapshot + tree + " --stereo anaglyph --convergence 0", "convergence");
        expect_mistake(snapshot + tree + " --stereo anaglyph --convergence 0.01 --eye-separation 9", "eyes");
        expect_mistake(snapshot + tree + " --stereo side-by-side --size 8192x4096", "pixels");
        expect_mistake(snapshot + tree + " --crop 0 1 2", "crop");
        expect_mistake(snapshot + tree + " --crop 0 1 2 3 x 5", "crop");
        expect_mistake(snapshot + tree + " --crop 0 31 0 32 0 28", "axis 1");
        expect_mistake(snapshot + tree + " --crop 0 30 0 32 -1 28", "axis 3");
        expect_mistake(snapshot + tree + " --crop 0 30 7 7 0 28", "two voxels");
        expect_mistake(snapshot + tree + " --crop 0 30 7 5 0 28", "two voxels");
    }
    expect_mistake("serve " + cube_ + " --lod some", "lod");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --classify", "classify");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --classify preintegrated", "classify");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --classify post --classify post", "classify");
    expect_mistake("view " + cube_ + " --crop 0 5 0 5 0 999", "crop");
    expect_mistake("view " + cube_ + " --crop 0 5 0 5", "crop");
    expect_mistake("view " + cube_ + " --stereo cinema", "stereo");
    expect_mistake("view " + cube_ + " --convergence 5", "stereo");
    expect_mistake("view " + cube_ + " --classify ''", "classify");
    expect_mistake("bench frame --classify both", "classify");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --tree 2", "tree");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --tree 65,2", "branching");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --tree 40,2", "too few");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --tf /nowhere.toml", "nowhere");
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --topology /nowhere.toml", "nowhere");
    expect_mistake("snapshot " + cube_ + " -o /nowhere/out.png --tree 1,1", "nowhere");
    expect_mistake("snapshot /nowhere.fits -o " + png_, "nowhere");
    expect_mistake("snapshot --connect 127.0.0.1:1 -o " + png_, "127.0.0.1:1");
    expect_mistake("snapshot --connect nonsense -o " + png_, "nonsense");
    expect_mistake("info /nowhere.fits", "nowhere");
    expect_mistake("info synthetic:duck:9", "duck");
    expect_mistake("snapshot synthetic:ball -o " + png_, "synthetic:ball");
    expect_mistake("snapshot synthetic:ball:1 -o " + png_ + " --tree 1,1", "axis");
    expect_mistake("sample ball --bitpix 8 -o " + png_, "BITPIX");
    expect_mistake("sample duck -o " + png_, "duck");
    expect_mistake("sample ball -o " + png_ + " --size 0 1 2", "axis");
    expect_mistake("sample ball -o /nowhere/x.fits", "nowhere");
    std::ofstream(scratch_.path("bad.toml")) << "[[opacity]]\nkind = 'rump'\n";
    expect_mistake("snapshot " + cube_ + " -o " + png_ + " --tf " + scratch_.path("bad.toml"), "rump");
}

TEST_F(Commands, HelpEndsWithZero) {
    for (const std::string command : {"", "view", "serve", "snapshot", "movie", "info", "sample", "bench"}) {
        const Outcome outcome = run(command + " --help");
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.out.find("--help"), std::string::npos);
    }
}

// Every file that people may have: a picture, or one clear line. Never a crash, a hang, or a picture of
// something that is not a cube.
TEST(SharedData, GivesAPictureOrOneClearLine) {
    const std::filesystem::path folder = SHEARWATER_SHARED_DATA;
    if (!std::filesystem::is_directory(folder)) {
        GTEST_SKIP() << "the folder of sample data is not here";
    }
    const support::TemporaryFolder scratch;
    int pictures = 0;
    int refusals = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        const std::string png = scratch.path("out.png");
        std::filesystem::remove(png);
        const Outcome outcome = run("snapshot '" + entry.path().string() + "' -o " + png +
                                    " --tree 2,2 --size 64x64 --quality draft");
        if (outcome.status == 0) {
            ++pictures;
            EXPECT_TRUE(image::read_png(png)) << entry.path();
            std::istringstream lines(outcome.err);
            for (std::string line; std::getline(lines, line);) {
                // What was repaired or assumed is said.
                EXPECT_NE(line.find("warning: "), std::string::npos) << entry.path() << "\n" << line;
            }
        } else {
            ++refusals;
            EXPECT_EQ(outcome.status, 2) << entry.path() << "\n" << outcome.err;
            EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << entry.path() << "\n" << outcome.err;
            EXPECT_FALSE(std::filesystem::exists(png)) << entry.path();
        }
        for (const char c : outcome.err) {
            EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << entry.path();
        }
    }
    EXPECT_GE(pictures, 45);
    EXPECT_GE(refusals, 25);
}

}  // namespace
}  // namespace shearwater
