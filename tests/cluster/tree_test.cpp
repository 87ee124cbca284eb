// One picture for every tree: daemons over TCP against the whole cube in one piece.

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "deploy/local_tree.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"
#include "tests/support/tree_client.h"

namespace shearwater {
namespace {

struct Case {
    int branching;
    int levels;
    volume::Index3 n;
    int copies = 1;
};

std::string name_of(const Case& c) {
    std::ostringstream name;
    name << "Of" << c.branching << "By" << c.levels << "Over" << c.n[0] << "x" << c.n[1] << "x" << c.n[2]
         << (c.copies == 2 ? "InTwoCopies" : "");
    return name.str();
}

class EveryTree : public testing::TestWithParam<Case> {};

TEST_P(EveryTree, GivesTheSamePicture) {
    const Case& c = GetParam();
    const support::TemporaryFolder scratch;
    const std::string path = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("nbody-web", c.n, 3, path));
    auto cube = fits::Cube::open(path);
    ASSERT_TRUE(cube);

    deploy::LocalTree::Options options;
    options.cube.path = path;
    options.cube.range = {0, 2};
    options.cube.copies = c.copies;
    options.tree.tree = {c.branching, c.levels};
    const link::Secret secret = link::Secret::random();
    auto tree = deploy::LocalTree::start(options, secret);
    ASSERT_TRUE(tree) << tree.error().message();
    support::TreeClient client(tree->address(), secret);
    ASSERT_TRUE(client.wait_ready());
    ASSERT_TRUE(client.wait_described());

    support::Single single(path, {.lo = 0, .hi = 2, .stretch = volume::Stretch::linear, .bits = 8});
    ASSERT_EQ(*client.lattice(), single.lattice());
    int lit = 0;
    support::Difference worst;
    for (const wire::View& view : support::twenty_views(single.lattice())) {
        const auto shot = client.draw(view);
        ASSERT_TRUE(shot);
        const auto expected = single.draw(view);
        const auto difference = support::difference(shot->image, expected);
        EXPECT_LE(difference.largest, 1);
        EXPECT_GE(difference.psnr, 60);
        worst.largest = std::max(worst.largest, difference.largest);
        worst.psnr = std::min(worst.psnr, difference.psnr);
        lit += support::lit(expected) ? 1 : 0;
    }
    std::cout << "worst of 20 views: " << worst.largest << "/255, " << worst.psnr << " dB\n";
    EXPECT_GE(lit, 18);  // views that show nothing would prove nothing
}

INSTANTIATE_TEST_SUITE_P(Trees, EveryTree,
                         testing::Values(Case{2, 2, {61, 47, 53}}, Case{2, 3, {37, 41, 43}},
                                         Case{2, 3, {37, 41, 43}, 2}, Case{2, 4, {47, 31, 29}},
                                         Case{3, 2, {31, 61, 37}}, Case{4, 2, {53, 29, 31}},
                                         Case{5, 2, {23, 67, 33}}, Case{8, 2, {71, 19, 41}}),
                         [](const auto& tested) { return name_of(tested.param); });

// Unequal shares, a compositor that is left out, 16 bits, a stretch and a spacing: still one picture.
TEST(UnevenTree, GivesTheSamePicture) {
    const support::TemporaryFolder scratch;
    const std::string path = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("nbody-web", {45, 39, 51}, 5, path));
    std::ofstream(scratch.path("t.toml")) << R"(
[[node]]
name = "a"
role = "renderer"
weight = 2.5
[[node]]
name = "mid"
role = "compositor"
[[node]]
name = "b"
role = "renderer"
parent = "mid"
[[node]]
name = "c"
role = "renderer"
parent = "mid"
weight = 3.0
[[node]]
name = "d"
role = "renderer"
parent = "mid"
)";
    deploy::LocalTree::Options options;
    options.cube.path = path;
    options.cube.range = {0, 2};
    options.cube.bits = 16;
    options.cube.stretch = "asinh";
    options.cube.spacing = {1, 1.5, 0.75};
    options.tree.topology_file = scratch.path("t.toml");
    const link::Secret secret = link::Secret::random();
    auto tree = deploy::LocalTree::start(options, secret);
    ASSERT_TRUE(tree) << tree.error().message();
    support::TreeClient client(tree->address(), secret);
    ASSERT_TRUE(client.wait_ready());
    support::Single single(path, {.lo = 0, .hi = 2, .stretch = volume::Stretch::asinh, .bits = 16},
                           {1, 1.5, 0.75});
    for (const wire::View& view : support::twenty_views(single.lattice())) {
        const auto shot = client.draw(view);
        ASSERT_TRUE(shot);
        const auto difference = support::difference(shot->image, single.draw(view));
        EXPECT_LE(difference.largest, 1);
        EXPECT_GE(difference.psnr, 60);
    }
}

// Limits by percentile: every renderer's histogram, merged up the tree, cuts where the whole cube's does.
TEST(Limits, AreThoseOfTheWholeCube) {
    const support::TemporaryFolder scratch;
    const std::string path = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("random", {33, 35, 37}, 9, path));
    auto cube = fits::Cube::open(path);
    ASSERT_TRUE(cube);
    std::vector<float> values(33 * 35 * 37);
    ASSERT_TRUE(cube->read(volume::whole({33, 35, 37}), values));
    volume::Histogram histogram;
    histogram.add(values);
    const auto limits = volume::percentile_limits(histogram, 98);

    deploy::LocalTree::Options options;
    options.cube.path = path;
    options.cube.percentile = 98;
    options.tree.tree = {2, 3};
    const link::Secret secret = link::Secret::random();
    auto tree = deploy::LocalTree::start(options, secret);
    ASSERT_TRUE(tree);
    support::TreeClient client(tree->address(), secret);
    ASSERT_TRUE(client.wait_ready());
    support::Single single(path,
                           {.lo = limits.lo, .hi = limits.hi, .stretch = volume::Stretch::linear, .bits = 8});
    const wire::View view = support::twenty_views(single.lattice()).front();
    const auto shot = client.draw(view);
    ASSERT_TRUE(shot);
    EXPECT_LE(support::difference(shot->image, single.draw(view)).largest, 1);
}

// A renderer that cannot see the file is sent its voxels down the tree.
TEST(Voxels, ComeDownTheTree) {
    const support::TemporaryFolder scratch;
    const std::string path = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("nbody-web", {43, 47, 41}, 3, path));
    support::Single single(path, {.lo = 0, .hi = 2, .stretch = volume::Stretch::linear, .bits = 8});

    deploy::LocalTree::Options options;
    options.cube.path = path;
    options.cube.range = {0, 2};
    options.tree.topology_file = scratch.path("t.toml");
    std::ofstream(options.tree.topology_file)
        << "[tree]\nbranching = 2\nlevels = 3\n[placement]\nlauncher = 'manual'\n";
    const link::Secret secret = link::Secret::random();
    auto tree = deploy::LocalTree::start(options, secret);
    ASSERT_TRUE(tree) << tree.error().message();
    // The server has the file open; nobody else will find it.
    std::filesystem::rename(path, scratch.path("hidden.fits"));
    std::vector<deploy::Process> daemons;
    for (const char* program : {"shearwater-compositor", "shearwater-compositor", "shearwater-renderer",
                                "shearwater-renderer", "shearwater-renderer", "shearwater-renderer"}) {
        auto daemon = deploy::Process::start(
            program, {"--server", wire::to_string(tree->address()), "--log", "error"}, secret);
        ASSERT_TRUE(daemon);
        daemons.push_back(*std::move(daemon));
    }
    support::TreeClient client(tree->address(), secret);
    ASSERT_TRUE(client.wait_ready());
    for (const wire::View& view : support::twenty_views(single.lattice())) {
        const auto shot = client.draw(view);
        ASSERT_TRUE(shot);
        EXPECT_LE(support::difference(shot->image, single.draw(view)).largest, 1);
    }
}

}  // namespace
}  // namespace shearwater
