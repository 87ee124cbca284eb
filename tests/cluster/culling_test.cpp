// Culling in a tree of daemons: what is hidden is left out once its renderers' functions have come, and the
// picture stays the same.

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include "deploy/local_tree.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"
#include "tests/support/tree_client.h"

namespace shearwater {
namespace {

wire::View view_at(const view::Lattice& lattice, double azimuth, const view::TransferFunction& tf) {
    wire::View view;
    view.camera = view::camera_on({.azimuth = azimuth, .elevation = 15}, lattice);
    view.size = {120, 100};
    view.tf = tf;
    view.level_of_detail = false;
    return view;
}

view::TransferFunction fog(double height) {
    return {.opacity_pins = {view::Ramp{0, height / 2, 1, height}},
            .colour_pins = {{0, {0.2, 0.3, 1}}, {1, {1, 0.8, 0.3}}},
            .background = {}};
}

class CullingTree : public testing::Test {
  protected:
    void start(int branching, int levels, const volume::Index3& n = {114, 81, 85},
               const std::string& by = "auto") {
        ASSERT_TRUE(samples::write_sample("random", n, 3, path_));
        deploy::LocalTree::Options options;
        options.cube.path = path_;
        options.cube.range = {0, 1};
        options.tree.tree = {branching, levels};
        options.serve.culling_by = by;
        auto tree = deploy::LocalTree::start(options, secret_);
        ASSERT_TRUE(tree) << tree.error().message();
        tree_.emplace(*std::move(tree));
        client_.emplace(tree_->address(), secret_);
        ASSERT_TRUE(client_->wait_ready() && client_->wait_described());
    }

    // Draws the view until something of it is left out, found out by renderers if they are to, and compares
    // it with all of it.
    void expect_left_out(wire::View view, bool by_renderers = false) {
        const auto is_left_out = [&](const support::Shot& shot) {
            return shot.stats.leaves().bricks_culled() > 0 && (shot.stats.lookers() > 0 || !by_renderers);
        };
        const auto all = client_->draw(view);
        ASSERT_TRUE(all);
        EXPECT_EQ(all->stats.leaves().bricks_culled(), 0U);
        view.culling = {.kind = culling::Kind::opof};
        std::optional<support::Shot> some;
        auto pause = std::chrono::steady_clock::duration(std::chrono::milliseconds(20));
        for (int n = 0; n < 2000 && (!some || !is_left_out(*some)); ++n) {
            // Functions are found when nothing else has the processors: most of the time is left to them,
            // however long a picture takes.
            std::this_thread::sleep_for(pause);
            const auto begin = std::chrono::steady_clock::now();
            some = client_->draw(view);
            pause = std::max(pause, 4 * (std::chrono::steady_clock::now() - begin));
            ASSERT_TRUE(some);
            EXPECT_LE(support::difference(some->image, all->image).largest, 1);
            if (view.stereo) {
                EXPECT_LE(support::difference(some->right, all->right).largest, 1);
            }
        }
        EXPECT_TRUE(is_left_out(*some));
        std::cout << some->stats.leaves().bricks_culled() << " of " << some->stats.leaves().bricks_total()
                  << " bricks left out, samples " << all->stats.leaves().samples() << " -> "
                  << some->stats.leaves().samples() << "\n";
    }

    const support::TemporaryFolder scratch_;
    const std::string path_ = scratch_.path("cube.fits");
    const link::Secret secret_ = link::Secret::random();
    std::optional<deploy::LocalTree> tree_;
    std::optional<support::TreeClient> client_;
};

TEST_F(CullingTree, LeavesOutWhatIsHidden) {
    start(2, 3);
    for (const double azimuth : {10.0, 130.0}) {
        expect_left_out(view_at(*client_->lattice(), azimuth, fog(0.9)));
    }
    // Another height needs no other functions: what is hidden is known at once.
    wire::View view = view_at(*client_->lattice(), 10, fog(0.9));
    view.culling = {.kind = culling::Kind::opof};
    view.tf.opacity_pins = {view::Ramp{0, 0.48, 1, 0.96}};
    const auto shot = client_->draw(view);
    ASSERT_TRUE(shot);
    EXPECT_GT(shot->stats.leaves().bricks_culled(), 0U);
}

// Each eye has what it sees, and a box that is cropped to hides with whole blocks only.
TEST_F(CullingTree, LeavesOutWhatIsHiddenFromEitherEyeAndInABox) {
    start(2, 2);
    wire::View view = view_at(*client_->lattice(), 30, fog(0.9));
    view.stereo = view::StereoSettings{40, 0, false};
    expect_left_out(view);
    view.crop = volume::Box{{5, 3, 5}, {113, 80, 84}};
    expect_left_out(view);
}

TEST_F(CullingTree, GoesOnOverADeathOfARenderer) {
    start(2, 2);
    expect_left_out(view_at(*client_->lattice(), 30, fog(0.9)));
    ASSERT_EQ(kill(tree_->daemon_ids().at(0), SIGKILL), 0);
    ASSERT_TRUE(client_->wait_until([&] { return !client_->state().ready(); }));
    ASSERT_TRUE(client_->wait_until([&] {
        tree_->keep_alive();
        return client_->state().ready();
    }));
    expect_left_out(view_at(*client_->lattice(), 30, fog(0.9)));
}

// Each renderer looks at a part of the picture, by functions of all blocks; one that comes back is given them
// again.
TEST_F(CullingTree, RenderersFindOutWhatIsHidden) {
    start(2, 3, {70, 41, 66}, "renderers");
    const wire::View view = view_at(*client_->lattice(), 10, fog(0.9));
    expect_left_out(view, true);
    ASSERT_EQ(kill(tree_->daemon_ids().back(), SIGKILL), 0);
    ASSERT_TRUE(client_->wait_until([&] { return !client_->state().ready(); }));
    ASSERT_TRUE(client_->wait_until([&] {
        tree_->keep_alive();
        return client_->state().ready();
    }));
    expect_left_out(view, true);
}

}  // namespace
}  // namespace shearwater
