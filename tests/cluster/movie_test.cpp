// Movies as a person makes them: frames that equal stills, stopped and gone on with, films.

#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <thread>

#include "common/image/png.h"
#include "tests/support/command.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"

namespace shearwater {
namespace {

namespace fs = std::filesystem;
using support::expect_mistake;
using support::Outcome;
using support::run;

class Movie : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(samples::write_sample("nbody-web", {31, 33, 29}, 3, scratch_.path("web.fits")));
        ASSERT_TRUE(samples::write_sample("hi-galaxy", {40, 38, 24}, 5, scratch_.path("galaxy.fits")));
        write_path(10);
        std::ofstream(scratch_.path("second.toml")) << "colourmap = \"viridis\"\n[[opacity]]\nkind = "
                                                       "\"ramp\"\nx0 = 0.1\na0 = 0.0\nx1 = 0.9\na1 = 0.4\n";
    }

    // Of two cubes, 1.1 seconds long.
    void write_path(int fps) const {
        std::ofstream(scratch_.path("path.toml")) << "fps = " << fps << R"(
[[cube]]
path = "web.fits"
[[cube]]
path = "galaxy.fits"
percentile = 99.0
[[key]]
time = 0
azimuth = 20
distance = 110
[[key]]
time = 0.6
cube = 2
azimuth = 50
distance = 90
[key.tf]
colourmap = "viridis"
[[key.tf.opacity]]
kind = "ramp"
x0 = 0.1
a0 = 0.0
x1 = 0.9
a1 = 0.4
[[key]]
time = 0.9
limits = [-0.01, 0.08]
stretch = "sqrt"
[[key]]
time = 1.1
azimuth = 95
limits = [0, 0.1]
)";
    }

    std::string command(const std::string& output, const std::string& more = "") const {
        return "movie " + scratch_.path("path.toml") + " -o " + output + " --size 90x71 --tree 2,2 " + more;
    }

    image::Image<image::Rgba8> frame(const std::string& folder, int number) const {
        char name[32];
        std::snprintf(name, sizeof name, "/frame-%06d.png", number);
        auto picture = image::read_png(folder + name);
        EXPECT_TRUE(picture) << folder << name;
        return picture ? *std::move(picture) : image::Image<image::Rgba8>(1, 1);
    }

    static int frames_in(const fs::path& folder) {
        std::error_code none;
        int count = 0;
        for (const auto& entry : fs::directory_iterator(folder, none)) {
            count += entry.path().extension() == ".png" ? 1 : 0;
        }
        return count;
    }

    support::TemporaryFolder scratch_;
};

TEST_F(Movie, FramesEqualStills) {
    const std::string folder = scratch_.path("frames/");
    const Outcome outcome = run(command(folder));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(frames_in(folder), 12);
    const std::string still = scratch_.path("still.png");
    const std::string size = " --size 90x71 --quality high -o " + still;
    const std::pair<int, std::string> stills[] = {
        {0, "web.fits --azimuth 20 --distance 110"},
        {6, "galaxy.fits --percentile 99 --azimuth 50 --distance 90 --tf " + scratch_.path("second.toml")},
        {11, "galaxy.fits --range 0 0.1 --stretch sqrt --azimuth 95 --distance 90 --tf " +
                 scratch_.path("second.toml")}};
    for (const auto& [number, view] : stills) {
        ASSERT_EQ(run("snapshot " + scratch_.path("") + view + size).status, 0);
        const auto picture = image::read_png(still);
        ASSERT_TRUE(picture);
        EXPECT_TRUE(support::lit(*picture));
        EXPECT_EQ(support::difference(frame(folder, number), *picture).largest, 0) << number;
    }
    EXPECT_GT(support::difference(frame(folder, 2), frame(folder, 3)).largest, 8) << "it moves";
    // Without daemons the same, to a level.
    ASSERT_EQ(run("movie " + scratch_.path("path.toml") + " -o " + scratch_.path("single/") +
                  " --size 90x71 --tree 1,1")
                  .status,
              0);
    for (const int number : {0, 5, 8, 10, 11}) {
        EXPECT_LE(support::difference(frame(folder, number), frame(scratch_.path("single/"), number)).largest,
                  1);
    }
}

// As many frames as the films of DVR section 5 have; killed half-way.
TEST_F(Movie, GoesOnWhereItWasStopped) {
    constexpr int frames = 130;
    write_path(118);
    const std::string whole = scratch_.path("whole/");
    ASSERT_EQ(run(command(whole)).status, 0);
    ASSERT_EQ(frames_in(whole), frames);
    // Killed without a word once half of the frames are there.
    const std::string stopped = scratch_.path("stopped/");
    const std::string line = std::string("exec ") + SHEARWATER_BIN + "/shearwater " + command(stopped);
    const pid_t child = fork();
    if (child == 0) {
        execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        _exit(127);
    }
    for (int i = 0; i < 24000 && frames_in(stopped) < frames / 2; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    std::map<std::string, fs::file_time_type> before;
    for (const auto& entry : fs::directory_iterator(stopped)) {
        if (entry.path().extension() == ".png") {
            before[entry.path().filename()] = entry.last_write_time();
        }
    }
    ASSERT_GE(before.size(), std::size_t{frames / 2});
    ASSERT_LT(before.size(), std::size_t{frames}) << "it was not stopped before its end";
    ASSERT_EQ(run(command(stopped)).status, 0);
    EXPECT_EQ(frames_in(stopped), frames);
    for (const auto& [name, time] : before) {
        EXPECT_EQ(fs::last_write_time(stopped + name), time) << name << " was drawn already";
    }
    for (int number = 0; number < frames; ++number) {
        EXPECT_EQ(support::difference(frame(whole, number), frame(stopped, number)).largest, 0) << number;
    }
}

TEST_F(Movie, FramesOfAnotherAreNotMixedIn) {
    const std::string folder = scratch_.path("frames/");
    ASSERT_EQ(run(command(folder)).status, 0);
    expect_mistake(command(folder, "--classify pre-integrated"), "another movie");
    EXPECT_EQ(frames_in(folder), 12);
    EXPECT_EQ(run(command(folder, "--classify pre-integrated --anew")).status, 0);
}

TEST_F(Movie, BecomesAFilm) {
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "there is no ffmpeg here";
    }
    const std::string film = scratch_.path("film.mp4");
    const Outcome outcome = run(command(film));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(fs::exists(film + ".frames"));
    const std::string seen = scratch_.path("seen/");
    fs::create_directories(seen);
    ASSERT_EQ(std::system(("ffmpeg -loglevel error -i " + film + " " + seen + "frame-%06d.png").c_str()), 0);
    EXPECT_EQ(frames_in(seen), 12);
    const auto picture = frame(seen, 7);
    EXPECT_EQ(picture.width(), 90);
    EXPECT_EQ(picture.height(), 72) << "films are of even size";
    EXPECT_TRUE(support::lit(picture));
}

TEST_F(Movie, MistakesGetOneLine) {
    const std::string path = scratch_.path("path.toml");
    expect_mistake("movie", "path");
    expect_mistake("movie " + path, "output");
    expect_mistake("movie " + path + " -o film.gif", "neither");
    expect_mistake("movie " + path + " -o /nowhere/x.mp4", "nowhere");
    expect_mistake("movie /nowhere.toml -o x.mp4", "nowhere");
    expect_mistake("movie " + path + " " + scratch_.path("web.fits") + " -o x/", "names its cubes");
    expect_mistake("movie " + path + " -o x.mp4 --size pear", "pear");
    std::ofstream(scratch_.path("bare.toml")) << "[[key]]\ntime = 0\n";
    expect_mistake("movie " + scratch_.path("bare.toml") + " -o x.mp4", "names no cube");
    fs::remove(scratch_.path("galaxy.fits"));
    expect_mistake(command(scratch_.path("f/")), "galaxy.fits");
}

}  // namespace
}  // namespace shearwater
