// Cubes on another machine, through ssh's standard streams: a real sshd on loopback, and what can go wrong.

#include <gtest/gtest.h>
#include <pwd.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "common/image/png.h"
#include "deploy/remote.h"
#include "deploy/target.h"
#include "tests/support/command.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"

namespace shearwater {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using support::Outcome;
using support::run;

TEST(Remote, NamesOfCubesElsewhereAreTold) {
    const support::TemporaryFolder scratch;
    const auto is = [](const std::string& name) {
        const auto cube = deploy::remote_cube(name);
        return cube ? cube->host + "|" + cube->path : "";
    };
    EXPECT_EQ(is("ann@big.org:/data/cube.fits"), "ann@big.org|/data/cube.fits");
    EXPECT_EQ(is("big:cube.fits"), "big|cube.fits");
    EXPECT_EQ(is("ann@big:/a:b.fits"), "ann@big|/a:b.fits");
    for (const char* name :
         {"cube.fits", "/data/a:b.fits", "./a:b.fits", "synthetic:ball:64", ":x", "x:", "-o:x", ""}) {
        EXPECT_EQ(is(name), "") << name;
    }
    const std::string here = scratch.path("a:b.fits");
    std::ofstream(here) << "x";
    const fs::path before = fs::current_path();
    fs::current_path(scratch.path());
    EXPECT_EQ(is("a:b.fits"), "") << "a file that is here";
    fs::current_path(before);
}

TEST(Remote, WordsReachTheOtherShellAsTheyAre) {
    EXPECT_EQ(wire::shell_word("a b"), "'a b'");
    EXPECT_EQ(wire::shell_word("it's; rm -rf $HOME"), "'it'\\''s; rm -rf $HOME'");
    deploy::TargetOptions options;
    options.cube.path = "ann@big:/a b/c's.fits";
    options.remote.shell.ssh = "ssh -p 22";
    const auto words = deploy::serving_command(options, "warn");
    ASSERT_EQ(words.size(), 6U);
    EXPECT_EQ(words[4], "ann@big");
    EXPECT_EQ(words[5].rfind("exec 'shearwater' serve --stdio '/a b/c'\\''s.fits'", 0), 0U) << words[5];
}

// A script in ssh's place, or sshd itself.
class RemoteCube : public testing::Test {
  protected:
    void SetUp() override {
        cube_ = scratch_.path("it's a cube.fits");
        ASSERT_TRUE(samples::write_sample("nbody-web", {31, 33, 29}, 3, cube_));
    }

    std::string script(const std::string& text) {
        const std::string path = scratch_.path("ssh-of-the-test");
        std::ofstream(path) << "#!/bin/sh\n" << text << "\n";
        fs::permissions(path, fs::perms::owner_all);
        return path;
    }

    std::string snapshot(const std::string& ssh, const std::string& where, const std::string& png) const {
        return "snapshot \"" + where + "\" --ssh '" + ssh + "' --remote-program " + SHEARWATER_BIN +
               "/shearwater --tree 2,2 --size 120x90 --azimuth 50 -o " + png;
    }

    void expect_the_local_picture(const std::string& png) {
        const std::string here = scratch_.path("here.png");
        ASSERT_EQ(run("snapshot \"" + cube_ + "\" --tree 2,2 --size 120x90 --azimuth 50 -o " + here).status,
                  0);
        const auto a = image::read_png(here), b = image::read_png(png);
        ASSERT_TRUE(a && b);
        EXPECT_TRUE(support::lit(*a));
        EXPECT_EQ(support::difference(*a, *b).largest, 0);
    }

    support::TemporaryFolder scratch_;
    std::string cube_;
};

TEST_F(RemoteCube, IsDrawnThroughAProgramsStreams) {
    // It gets: -T HOST COMMAND.
    const std::string ssh = script("exec sh -c \"$3\"");
    const std::string png = scratch_.path("there.png");
    const Outcome outcome = run(snapshot(ssh, "somewhere:" + cube_, png));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    expect_the_local_picture(png);
}

TEST_F(RemoteCube, WhatTheProgramSaysIsTold) {
    const std::string png = scratch_.path("none.png");
    support::expect_mistake(
        snapshot(script("echo 'connect to host: refused' >&2; exit 255"), "somewhere:" + cube_, png),
        "refused");
    support::expect_mistake(snapshot(script("exec sh -c \"$3\""), "somewhere:/nowhere.fits", png),
                            "nowhere.fits");
    support::expect_mistake(snapshot("no-such-ssh", "somewhere:" + cube_, png), "no-such-ssh");
    support::expect_mistake(snapshot(script("exit 0"), "somewhere:" + cube_, png), "closed");
    support::expect_mistake(
        snapshot(script("echo 'Welcome to this machine, which prints what it should not'; cat >/dev/null"),
                 "somewhere:" + cube_, png),
        "shearwater snapshot");
    support::expect_mistake("serve --stdio " + wire::shell_word(cube_), "secret");
}

TEST_F(RemoteCube, IsDrawnThroughSsh) {
    const std::string sshd = "/usr/sbin/sshd";
    if (!fs::exists(sshd) || std::system("ssh-keygen -? >/dev/null 2>&1; command -v ssh >/dev/null") != 0) {
        GTEST_SKIP() << "there is no sshd here";
    }
    const auto shell = [](const std::string& line) { return std::system(line.c_str()); };
    for (const char* key : {"host", "user"}) {
        ASSERT_EQ(shell("ssh-keygen -q -t ed25519 -N '' -f " + scratch_.path(key)), 0);
    }
    if (geteuid() == 0) {
        fs::create_directories("/run/sshd");  // where it wants to be when it is root's
    }
    const int port = 20000 + getpid() % 12000;  // below those that connections beside it are given
    std::ofstream(scratch_.path("sshd_config"))
        << "ListenAddress 127.0.0.1\nPort " << port << "\nHostKey " << scratch_.path("host")
        << "\nAuthorizedKeysFile " << scratch_.path("user.pub")
        << "\nStrictModes no\nUsePAM no\nPidFile none\nPasswordAuthentication no\nPermitRootLogin yes\n";
    const pid_t daemon = fork();
    if (daemon == 0) {
        execl(sshd.c_str(), sshd.c_str(), "-D", "-q", "-f", scratch_.path("sshd_config").c_str(), nullptr);
        _exit(127);
    }
    const passwd* const user = getpwuid(geteuid());
    ASSERT_NE(user, nullptr);
    const std::string ssh = "ssh -p " + std::to_string(port) + " -i " + scratch_.path("user") +
                            " -o BatchMode=yes -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null "
                            "-o LogLevel=ERROR -o ConnectTimeout=10";
    const std::string there = std::string(user->pw_name) + "@127.0.0.1";
    int reached = 1;
    for (int i = 0; i < 100 && reached != 0; ++i) {
        reached = shell(ssh + " " + there + " true 2>/dev/null");
        std::this_thread::sleep_for(50ms);
    }
    EXPECT_EQ(reached, 0) << "sshd lets us in";
    const std::string png = scratch_.path("there.png");
    const Outcome outcome = run(snapshot(ssh, there + ":" + cube_, png));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    if (outcome.status == 0) {
        expect_the_local_picture(png);
    }
    // The far end goes with us.
    int left = 1;
    for (int i = 0; i < 100 && left != 0; ++i) {
        left = shell("pgrep -f \"[s]hearwater-server " + cube_ + "\" >/dev/null") == 0 ? 1 : 0;
        std::this_thread::sleep_for(50ms);
    }
    EXPECT_EQ(left, 0) << "no server is left behind";
    kill(daemon, SIGTERM);
    waitpid(daemon, nullptr, 0);
}

}  // namespace
}  // namespace shearwater
