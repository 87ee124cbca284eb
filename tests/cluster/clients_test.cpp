// Several clients at once, pacing, and peers that do not behave.

#include <gtest/gtest.h>
#include <unistd.h>

#include <iostream>

#include "deploy/local_tree.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"
#include "tests/support/tree_client.h"

namespace shearwater {
namespace {

namespace pb = wire::pb;

class Clients : public testing::Test {
  protected:
    void SetUp() override {
        path_ = scratch_.path("cube.fits");
        ASSERT_TRUE(samples::write_sample("nbody-web", {33, 35, 37}, 3, path_));
        deploy::LocalTree::Options options;
        options.cube.path = path_;
        options.cube.range = {0, 2};
        options.tree.tree = {2, 3};
        auto tree = deploy::LocalTree::start(options, secret_);
        ASSERT_TRUE(tree) << tree.error().message();
        tree_.emplace(*std::move(tree));
        single_.emplace(path_,
                        volume::Mapping{.lo = 0, .hi = 2, .stretch = volume::Stretch::linear, .bits = 8});
        views_ = support::twenty_views(single_->lattice());
    }

    support::TemporaryFolder scratch_;
    std::string path_;
    link::Secret secret_ = link::Secret::random();
    std::optional<deploy::LocalTree> tree_;
    std::optional<support::Single> single_;
    std::vector<wire::View> views_;
};

TEST_F(Clients, EachHasItsOwnCameraSizeAndTransferFunction) {
    support::TreeClient a(tree_->address(), secret_);
    support::TreeClient b(tree_->address(), secret_);
    support::TreeClient c(tree_->address(), secret_);
    ASSERT_TRUE(a.wait_ready() && b.wait_ready() && c.wait_ready());
    views_[1].tf.colour_pins = *view::colour_map("viridis");
    for (int round = 0; round < 5; ++round) {
        const auto ra = a.ask(views_[0]);
        const auto rb = b.ask(views_[1]);
        const auto rc = c.ask(views_[3]);
        const auto sc = c.wait_whole(rc);
        const auto sb = b.wait_whole(rb);
        const auto sa = a.wait_whole(ra);
        ASSERT_TRUE(sa && sb && sc);
        EXPECT_LE(support::difference(sa->image, single_->draw(views_[0])).largest, 1);
        EXPECT_LE(support::difference(sb->image, single_->draw(views_[1])).largest, 1);
        EXPECT_LE(support::difference(sc->image, single_->draw(views_[3])).largest, 1);
    }
}

// A client that acknowledges nothing gets two frames and no more; the newest view wins when it wakes.
TEST_F(Clients, AtMostTwoFramesAreOnTheirWayAndTheNewestViewWins) {
    support::TreeClient client(tree_->address(), secret_);
    ASSERT_TRUE(client.wait_ready());
    client.acknowledge(false);
    for (std::size_t i = 0; i < 2; ++i) {
        client.ask(views_[i]);
        ASSERT_TRUE(client.wait_until([&] { return client.frames_received() == i + 1; }));
    }
    std::uint64_t last = 0;
    for (std::size_t i = 0; i < 50; ++i) {
        last = client.ask(views_[i % views_.size()]);
    }
    EXPECT_FALSE(client.wait_until([&] { return client.frames_received() > 2; }, std::chrono::seconds(1)));
    client.acknowledge(true);
    pb::FrameShown shown;
    for (std::uint64_t number = 1; number <= 2; ++number) {
        shown.set_number(number);
        client.send(wire::message(shown));
    }
    const auto newest = client.wait_whole(last);
    ASSERT_TRUE(newest);
    EXPECT_EQ(newest->revision, last);
    EXPECT_LT(client.frames_received(), 10U);
}

TEST_F(Clients, AClientThatLeavesMidFrameHurtsNobody) {
    support::TreeClient stays(tree_->address(), secret_);
    ASSERT_TRUE(stays.wait_ready());
    for (int i = 0; i < 10; ++i) {
        support::TreeClient leaves(tree_->address(), secret_);
        ASSERT_TRUE(leaves.wait_described());
        leaves.ask(views_[2]);
        leaves.wait_until([] { return false; }, std::chrono::seconds(0));
    }
    ASSERT_TRUE(stays.draw(views_[0]));
}

TEST_F(Clients, AWrongSecretIsRefusedByName) {
    support::TreeClient client(tree_->address(), link::Secret::random());
    ASSERT_TRUE(client.wait_until([&] { return client.down().has_value(); }));
    EXPECT_EQ(client.down()->reason, pb::REASON_BAD_SECRET);
}

TEST_F(Clients, AnImpossibleViewEndsThatLinkAlone) {
    support::TreeClient good(tree_->address(), secret_);
    support::TreeClient bad(tree_->address(), secret_);
    ASSERT_TRUE(good.wait_ready() && bad.wait_ready());
    wire::View view = views_[0];
    view.size = {.width = 1000000, .height = 1000000};
    bad.ask(view);
    ASSERT_TRUE(bad.wait_until([&] { return bad.down().has_value(); }));
    EXPECT_EQ(bad.down()->reason, pb::REASON_INVALID);
    EXPECT_TRUE(good.draw(views_[0]));
}

TEST_F(Clients, AMessageThatIsNotAClientsEndsTheLink) {
    support::TreeClient client(tree_->address(), secret_);
    ASSERT_TRUE(client.wait_described());
    client.send(wire::message(pb::Adopt{}));
    ASSERT_TRUE(client.wait_until([&] { return client.down().has_value(); }));
    EXPECT_EQ(client.down()->reason, pb::REASON_BAD_TYPE);
}

// One daemon more than the tree has places for is told so.
TEST_F(Clients, ADaemonTooManyIsTurnedAway) {
    auto spare = deploy::Process::start(
        "shearwater-renderer", {"--server", wire::to_string(tree_->address()), "--log", "off"}, secret_);
    ASSERT_TRUE(spare);
    support::TreeClient client(tree_->address(), secret_);
    ASSERT_TRUE(client.wait_ready());
    ASSERT_TRUE(client.draw(views_[0]));
    EXPECT_EQ(client.state().nodes_size(), 7);
    EXPECT_FALSE(spare->ended());
}

TEST_F(Clients, MemoryAtRestIsBounded) {
    // A renderer at rest: at most 1.3 bytes a voxel and 64 MiB; while loading 1.6 and 128 MiB.
    const support::TemporaryFolder scratch;
    const std::string path = scratch.path("big.fits");
    const volume::Index3 n{320, 320, 320};
    ASSERT_TRUE(samples::write_sample("random", n, 1, path));
    deploy::LocalTree::Options options;
    options.cube.path = path;
    options.tree.tree = {1, 2};
    auto tree = deploy::LocalTree::start(options, secret_);
    ASSERT_TRUE(tree);
    support::TreeClient client(tree->address(), secret_);
    ASSERT_TRUE(client.wait_ready());
    ASSERT_TRUE(client.wait_until([&] { return client.state().nodes(1).memory_bytes() > 0; }));
    const auto& renderer = client.state().nodes(1);
    std::cout << "resident " << renderer.memory_bytes() << ", peak " << renderer.peak_bytes()
              << " bytes for 320^3\n";
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers take memory of their own";
#else
    const double voxels = 320.0 * 320.0 * 320.0;
    const double mib = 1 << 20;
    EXPECT_LE(static_cast<double>(renderer.memory_bytes()), 1.3 * voxels + 64 * mib);
    EXPECT_LE(static_cast<double>(renderer.peak_bytes()), 1.6 * voxels + 128 * mib);
#endif
}

}  // namespace
}  // namespace shearwater
