// What windows leave behind for after a crash: windows here are keepers of one folder, and a crash is a
// process that is killed.

#include "client/view/autosaves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>

#include "tests/support/temporary_folder.h"

namespace shearwater::ui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

scene::Scene turned(double azimuth) {
    scene::Scene scene{.size = {64, 48}};
    scene.viewpoint.orbit.azimuth = azimuth;
    return scene;
}

class AutosavesTest : public testing::Test {
  protected:
    AutosavesTest() {
        cube_.name = "galaxy.fits";
        cube_.lattice.n = {64, 32, 16};
        other_ = cube_;
        other_.lattice.n = {65, 32, 16};
    }
    // A window that keeps a scene and is killed; `before`: while it runs.
    void crash(
        const model::Cube& cube, const scene::Scene& scene, const std::function<void()>& before = [] {}) {
        int ready[2];
        ASSERT_EQ(pipe(ready), 0);
        const pid_t child = fork();
        if (child == 0) {
            Autosaves window(folder_);
            window.keep(cube, scene);
            static_cast<void>(write(ready[1], "x", 1));
            for (;;) {
                pause();
            }
        }
        char kept = 0;
        ASSERT_EQ(read(ready[0], &kept, 1), 1);
        before();
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        close(ready[0]);
        close(ready[1]);
    }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
            names.push_back(entry.path().filename().string());
        }
        return names;
    }

    support::TemporaryFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "state" / "shearwater";
    model::Cube cube_, other_;
};

TEST_F(AutosavesTest, AWindowThatEndsWellLeavesNothing) {
    {
        Autosaves window(folder_);
        EXPECT_EQ(window.left_behind(cube_), std::nullopt) << "there is no folder yet";
        window.keep(cube_, turned(1));
        window.keep(cube_, turned(2));
        EXPECT_THAT(files(), SizeIs(2)) << "the scene and its lock";
        EXPECT_EQ(window.left_behind(cube_), std::nullopt) << "it is its own";
        window.keep(other_, turned(3));
        EXPECT_THAT(files(), SizeIs(2)) << "on one cube at a time";
    }
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(AutosavesTest, WhatACrashLeavesIsOfferedOnce) {
    crash(cube_, turned(7),
          [&] { EXPECT_EQ(Autosaves(folder_).left_behind(cube_), std::nullopt) << "its window runs"; });
    Autosaves next(folder_), another(folder_);
    EXPECT_EQ(next.left_behind(other_), std::nullopt);
    EXPECT_EQ(next.left_behind(cube_), turned(7));
    EXPECT_EQ(another.left_behind(cube_), std::nullopt) << "it is on offer";
    another.keep(cube_, turned(8));
    next.keep(cube_, turned(9));
    next.forget_left_behind();
    EXPECT_EQ(Autosaves(folder_).left_behind(cube_), std::nullopt);
    EXPECT_THAT(files(), SizeIs(4)) << "two windows'";
}

TEST_F(AutosavesTest, AnOfferThatIsNotAnsweredIsMadeAgain) {
    crash(cube_, turned(7));
    {
        Autosaves next(folder_);
        EXPECT_EQ(next.left_behind(cube_), turned(7));
        next.keep(cube_, turned(8));
    }
    EXPECT_EQ(Autosaves(folder_).left_behind(cube_), turned(7));
}

TEST_F(AutosavesTest, TheNewestIsOfferedAndOthersRemoved) {
    const auto aged = [&](std::chrono::hours age) {
        for (const std::string& name : files()) {
            if (name.ends_with(".toml")) {
                const auto path = folder_ / name;
                std::filesystem::last_write_time(path, std::filesystem::last_write_time(path) - age);
            }
        }
    };
    crash(cube_, turned(1));
    aged(std::chrono::hours(2));
    // Windows that looked for nothing.
    crash(cube_, turned(2));
    aged(std::chrono::hours(2));
    crash(cube_, turned(3));
    crash(other_, turned(4));
    Autosaves next(folder_);
    EXPECT_EQ(next.left_behind(cube_), turned(3));
    next.forget_left_behind();
    EXPECT_EQ(next.left_behind(cube_), std::nullopt);
    EXPECT_EQ(next.left_behind(other_), turned(4));
    next.forget_left_behind();
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(AutosavesTest, WhatCannotBeReadIsRemovedAndWhatIsNotOursIsLeft) {
    crash(cube_, turned(1));
    const std::vector<std::string> left = files();
    const auto kept = std::ranges::find_if(left, [](const auto& name) { return name.ends_with(".toml"); });
    ASSERT_NE(kept, left.end());
    { std::ofstream(folder_ / *kept) << "version = 1\ncube = \""; }
    { std::ofstream(folder_ / "recent.toml") << "version = 1\n"; }
    EXPECT_EQ(Autosaves(folder_).left_behind(cube_), std::nullopt);
    EXPECT_THAT(files(), ElementsAre("recent.toml"));
}

TEST_F(AutosavesTest, WhereNothingCanBeKeptNothingIs) {
    { std::ofstream(scratch_ / "file") << "no folder"; }
    Autosaves window(scratch_ / "file");
    window.keep(cube_, turned(1));
    EXPECT_EQ(window.left_behind(cube_), std::nullopt);
}

}  // namespace
}  // namespace shearwater::ui
