// Real daemons on a plain file: a picture of a sketch, and the cube's by itself once all is loaded.

#include <gtest/gtest.h>

#include <fstream>

#include "common/volume/statistics.h"
#include "deploy/local_tree.h"
#include "tests/support/cubes.h"
#include "tests/support/held_renderer.h"
#include "tests/support/pictures.h"
#include "tests/support/tree_client.h"

namespace shearwater {
namespace {

// A server and a renderer as processes, and another renderer that the test keeps from loading.
class FirstLook : public testing::Test {
  protected:
    void start(const std::vector<double>& range) {
        ASSERT_TRUE(samples::write_sample("nbody-web", n, 3, path_));
        std::ofstream(topology_) << "[tree]\nbranching = 2\nlevels = 2\n[placement]\nlauncher = 'manual'\n";
        deploy::LocalTree::Options options;
        options.cube.path = path_;
        options.cube.range = range;
        options.tree.topology_file = topology_;
        auto tree = deploy::LocalTree::start(options, secret_);
        ASSERT_TRUE(tree) << tree.error().message();
        tree_.emplace(*std::move(tree));
        auto renderer = deploy::Process::start(
            "shearwater-renderer",
            {"--server", wire::to_string(tree_->address()), "--node", "renderer-1", "--log", "warn"},
            secret_);
        ASSERT_TRUE(renderer);
        renderer_.emplace(*std::move(renderer));
        held_.emplace(tree_->address(), secret_, "renderer-2");
    }
    volume::Mapping percentile_mapping() {
        auto cube = fits::Cube::open(path_);
        base::Workers workers(1);
        const auto histogram = volume::count_values(*cube, volume::whole(n), n, workers);
        const volume::Limits limits = volume::percentile_limits(*histogram, 99.5);
        return {.lo = limits.lo, .hi = limits.hi};
    }
    wire::View view(bool welcomes_sketch) const {
        wire::View view = support::twenty_views({.n = n, .spacing = {1, 1, 1}})[0];
        view.sketch = welcomes_sketch;
        return view;
    }
    // Of one client that welcomes sketches and one that has never heard of them.
    void expect_sketch_then_cube(const volume::Mapping& mapping) {
        // Drawn before the clients are there: meanwhile nothing would answer the server's pings.
        const auto expected = support::Single(path_, mapping).draw(view(true));
        support::TreeClient client(tree_->address(), secret_), older(tree_->address(), secret_);
        ASSERT_TRUE(client.wait_described() && older.wait_described());
        const std::uint64_t waits = older.ask(view(false));
        const std::uint64_t looks = client.ask(view(true));
        const auto first = client.next(looks);
        ASSERT_TRUE(first);
        EXPECT_TRUE(first->sketch);
        EXPECT_TRUE(first->missing.empty());
        EXPECT_TRUE(support::lit(first->image));
        const std::uint64_t again = client.ask(view(true));
        const auto second = client.next(again);
        ASSERT_TRUE(second);
        EXPECT_TRUE(second->sketch);
        EXPECT_EQ(client.frames_received(), 2U);
        EXPECT_EQ(older.frames_received(), 0U);
        EXPECT_FALSE(client.state().ready());

        held_->let_load();
        const auto whole = client.next(again);
        ASSERT_TRUE(whole);
        EXPECT_FALSE(whole->sketch);
        EXPECT_TRUE(whole->missing.empty());
        EXPECT_LE(support::difference(expected, whole->image).largest, 1);
        EXPECT_GT(support::difference(expected, first->image).psnr, 20);
        const auto only = older.next(waits);
        ASSERT_TRUE(only);
        EXPECT_FALSE(only->sketch);
        EXPECT_LE(support::difference(expected, only->image).largest, 1);
        EXPECT_EQ(client.frames_received(), 3U);
        EXPECT_EQ(older.frames_received(), 1U);
    }

    static constexpr volume::Index3 n{140, 132, 129};

    support::TemporaryFolder scratch_;
    std::string path_ = scratch_.path("cube.fits"), topology_ = scratch_.path("tree.toml");
    link::Secret secret_ = link::Secret::random();
    std::optional<deploy::LocalTree> tree_;
    std::optional<deploy::Process> renderer_;
    std::optional<support::HeldRenderer> held_;
};

TEST_F(FirstLook, ComesBeforeTheCubeAndTheCubeByItself) {
    start({});
    expect_sketch_then_cube(percentile_mapping());
}

TEST_F(FirstLook, ComesByTheLimitsThatAreGiven) {
    start({0, 2});
    support::TreeClient client(tree_->address(), secret_);
    ASSERT_TRUE(client.wait_described());
    const std::uint64_t looks = client.ask(view(true));
    // The held renderer makes its sketch when it begins to load.
    EXPECT_EQ(client.frames_received(), 0U);
    held_->let_load();
    const auto whole = client.wait_whole(looks);
    ASSERT_TRUE(whole);
    EXPECT_LE(support::difference(support::Single(path_, {.lo = 0, .hi = 2}).draw(view(true)), whole->image)
                  .largest,
              1);
}

}  // namespace
}  // namespace shearwater
