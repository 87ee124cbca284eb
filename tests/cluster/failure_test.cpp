// Daemons that die, stand still, come back.

#include <gtest/gtest.h>
#include <signal.h>

#include "common/tree/plan.h"
#include "deploy/local_tree.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"
#include "tests/support/tree_client.h"

namespace shearwater {
namespace {

class Failures : public testing::Test {
  protected:
    void start(int branching, int levels, const volume::Index3& n, const std::string& sample = "nbody-web") {
        path_ = scratch_.path("cube.fits");
        ASSERT_TRUE(samples::write_sample(sample, n, 3, path_));
        // Loaded before the client is there: while it loads nothing would answer the server's pings.
        expected_.emplace(path_,
                          volume::Mapping{.lo = 0, .hi = 2, .stretch = volume::Stretch::linear, .bits = 8});
        options_.cube.path = path_;
        options_.cube.range = {0, 2};
        options_.tree.tree = {branching, levels};
        auto tree = deploy::LocalTree::start(options_, secret_);
        ASSERT_TRUE(tree) << tree.error().message();
        tree_.emplace(*std::move(tree));
        plan_ = *tree::make_plan(*options_.tree.topology(), n);
        client_.emplace(tree_->address(), secret_);
        ASSERT_TRUE(client_->wait_ready());
        ASSERT_TRUE(client_->wait_described());
        view_ = support::twenty_views(*client_->lattice())[0];
    }

    pid_t pid_of(tree::Place place) const { return tree_->daemon_ids()[static_cast<std::size_t>(place) - 1]; }

    bool restart_until(const std::function<bool()>& holds) {
        return client_->wait_until([&] {
            tree_->keep_alive();
            return holds();
        });
    }
    void expect_whole_picture() {
        const auto shot = client_->draw(view_);
        ASSERT_TRUE(shot);
        EXPECT_LE(support::difference(shot->image, expected_->draw(view_)).largest, 1);
    }

    support::TemporaryFolder scratch_;
    std::string path_;
    deploy::LocalTree::Options options_;
    link::Secret secret_ = link::Secret::random();
    std::optional<deploy::LocalTree> tree_;
    tree::Plan plan_;
    std::optional<support::TreeClient> client_;
    std::optional<support::Single> expected_;
    wire::View view_;
};

TEST_F(Failures, ARendererThatDiesMidFrameIsNamedAndComesBack) {
    ASSERT_NO_FATAL_FAILURE(start(2, 3, {33, 35, 37}));
    const tree::Place victim = plan_.renderers_below(0)[2];
    // Standing still, it has been asked for the frame and cannot have answered when it dies.
    ASSERT_EQ(kill(pid_of(victim), SIGSTOP), 0);
    const std::uint64_t revision = client_->ask(view_);
    EXPECT_FALSE(
        client_->wait_until([&] { return client_->frames_received() > 0; }, std::chrono::seconds(1)));
    const pid_t killed = pid_of(victim);
    ASSERT_EQ(kill(killed, SIGKILL), 0);
    const auto shot = client_->next(revision);
    ASSERT_TRUE(shot);
    ASSERT_EQ(shot->missing.size(), 1U);
    EXPECT_EQ(shot->missing[0], plan_.at(victim).box);
    EXPECT_TRUE(support::lit(shot->image));

    // It is started again, gets its place back, and the server sends the same view whole by itself.
    // Its links end before its process does.
    ASSERT_TRUE(restart_until([&] { return pid_of(victim) > 0 && pid_of(victim) != killed; }));
    const auto whole = client_->wait_whole(revision);
    ASSERT_TRUE(whole);
    EXPECT_LE(support::difference(whole->image, expected_->draw(view_)).largest, 1);
}

TEST_F(Failures, ACompositorThatDiesTakesItsBoxAlongAndBringsItBack) {
    ASSERT_NO_FATAL_FAILURE(start(2, 3, {33, 35, 37}));
    const tree::Place victim = 2;
    ASSERT_EQ(plan_.at(victim).spec.role, tree::Role::compositor);
    ASSERT_EQ(kill(pid_of(victim), SIGKILL), 0);
    ASSERT_TRUE(client_->wait_until([&] { return !client_->state().ready(); }));
    const auto shot = client_->next(client_->ask(view_));
    ASSERT_TRUE(shot);
    ASSERT_EQ(shot->missing.size(), 1U);
    EXPECT_EQ(shot->missing[0], plan_.at(victim).box);
    ASSERT_TRUE(restart_until([&] { return client_->state().ready(); }));
    expect_whole_picture();
}

// Stopped, not dead: its links fall silent. When it goes on, it finds its way back by itself.
TEST_F(Failures, ARendererThatStandsStillIsGivenUpAndComesBack) {
    ASSERT_NO_FATAL_FAILURE(start(2, 2, {33, 35, 37}));
    const tree::Place victim = 1;
    ASSERT_EQ(kill(pid_of(victim), SIGSTOP), 0);
    const auto shot = client_->next(client_->ask(view_));
    ASSERT_TRUE(shot);
    ASSERT_EQ(shot->missing.size(), 1U);
    EXPECT_EQ(shot->missing[0], plan_.at(victim).box);
    ASSERT_EQ(kill(pid_of(victim), SIGCONT), 0);
    ASSERT_TRUE(client_->wait_until([&] { return client_->state().ready(); }));
    expect_whole_picture();
}

TEST_F(Failures, TheServersEndIsSaid) {
    ASSERT_NO_FATAL_FAILURE(start(2, 2, {17, 19, 23}));
    ASSERT_EQ(kill(tree_->server_id(), SIGKILL), 0);
    ASSERT_TRUE(client_->wait_until([&] { return client_->down().has_value(); }));
    EXPECT_EQ(client_->down()->reason, wire::pb::REASON_LOST);
    EXPECT_TRUE(client_->wait_until([&] { return !tree_->keep_alive(); }));
}

TEST_F(Failures, AnOrderlyEndSaysGoodbye) {
    ASSERT_NO_FATAL_FAILURE(start(2, 2, {17, 19, 23}));
    ASSERT_EQ(kill(tree_->server_id(), SIGTERM), 0);
    ASSERT_TRUE(client_->wait_until([&] { return client_->down().has_value(); }));
    EXPECT_EQ(client_->down()->reason, wire::pb::REASON_SHUTDOWN);
}

// Fifteen nodes, the server one of them: every daemon is killed in turn while a client keeps asking.
TEST_F(Failures, FifteenNodesKilledOneByOneEndWhole) {
    ASSERT_NO_FATAL_FAILURE(start(2, 4, {256, 256, 256}, "random"));
    ASSERT_EQ(tree_->daemon_ids().size(), 14U);
    const std::size_t daemons = tree_->daemon_ids().size();
    for (std::size_t i = 0; i < daemons; ++i) {
        const pid_t before = tree_->daemon_ids()[i];
        ASSERT_EQ(kill(before, SIGKILL), 0);
        const std::uint64_t revision = client_->ask(view_);
        ASSERT_TRUE(client_->next(revision))
            << "no answer after daemon " << i << " died; the client's link is "
            << (client_->down() ? "down: " + client_->down()->text : "up");
        ASSERT_TRUE(
            restart_until([&] { return tree_->daemon_ids()[i] > 0 && tree_->daemon_ids()[i] != before; }));
    }
    ASSERT_TRUE(restart_until([&] { return client_->state().ready(); }));
    expect_whole_picture();
    EXPECT_FALSE(client_->down());
}

}  // namespace
}  // namespace shearwater
