// Pairs of pictures and crops from daemons over TCP: the same for every tree.

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <string>
#include <utility>

#include "deploy/local_tree.h"
#include "tests/support/cubes.h"
#include "tests/support/pictures.h"
#include "tests/support/tree_client.h"

namespace shearwater {
namespace {

using volume::Box;

class StereoTree : public testing::TestWithParam<std::pair<int, int>> {
  protected:
    void SetUp() override {
        ASSERT_TRUE(samples::write_sample("nbody-web", {61, 47, 53}, 3, path_));
        deploy::LocalTree::Options options;
        options.cube.path = path_;
        options.cube.range = {0, 2};
        options.tree.tree = {GetParam().first, GetParam().second};
        const link::Secret secret = link::Secret::random();
        auto tree = deploy::LocalTree::start(options, secret);
        ASSERT_TRUE(tree) << tree.error().message();
        tree_.emplace(*std::move(tree));
        client_.emplace(tree_->address(), secret);
        ASSERT_TRUE(client_->wait_ready() && client_->wait_described());
        single_.emplace(path_, volume::Mapping{.lo = 0, .hi = 2});
    }

    const support::TemporaryFolder scratch_;
    const std::string path_ = scratch_.path("cube.fits");
    std::optional<deploy::LocalTree> tree_;
    std::optional<support::TreeClient> client_;
    std::optional<support::Single> single_;
};

// What each eye gets is what a camera in its place would.
TEST_P(StereoTree, GivesEachEyeThePictureOfItsCamera) {
    int lit = 0;
    for (wire::View view : support::twenty_views(single_->lattice())) {
        view.stereo = view::StereoSettings{0, 0, view.deflate};
        view.crop = view.quality == view::Quality::normal ? std::optional(Box{{7, 0, 11}, {46, 40, 50}})
                                                          : std::nullopt;
        const auto shot = client_->draw(view);
        ASSERT_TRUE(shot);
        EXPECT_TRUE(shot->missing.empty());
        const auto eyes = view::eyes_of(view.camera, *view.stereo);
        for (std::size_t n = 0; n < 2; ++n) {
            view.camera = eyes[n];
            // Meanwhile the link is kept: a sanitizer on a busy machine may take longer than silence is
            // borne.
            auto drawing = std::async(std::launch::async, [&] { return single_->draw(view); });
            client_->wait_until(
                [&] { return drawing.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
            const auto expected = drawing.get();
            const auto difference = support::difference(n == 0 ? shot->image : shot->right, expected);
            EXPECT_LE(difference.largest, 1);
            EXPECT_GE(difference.psnr, 60);
            lit += support::lit(expected) ? 1 : 0;
        }
    }
    EXPECT_GE(lit, 30);
}

// Both at once, as one frame, however many are asked for meanwhile; and one picture again when that is
// wanted.
TEST_P(StereoTree, SendsBothEyesAsOneFrame) {
    wire::View view = support::twenty_views(single_->lattice()).front();
    const std::size_t before = client_->frames_received();
    std::uint64_t last = 0;
    constexpr int views = 9;
    for (int n = 0; n < views; ++n) {
        view.stereo = n % 3 == 2 ? std::nullopt : std::optional(view::StereoSettings{4, 0, n % 2 == 1});
        last = client_->ask(view);
    }
    const auto shot = client_->wait_whole(last);
    ASSERT_TRUE(shot);
    EXPECT_TRUE(shot->right.empty());
    EXPECT_LE(client_->frames_received() - before, std::size_t{views});
    EXPECT_LE(support::difference(shot->image, single_->draw(view)).largest, 1);
}

INSTANTIATE_TEST_SUITE_P(Trees, StereoTree,
                         testing::Values(std::pair{2, 2}, std::pair{2, 3}, std::pair{3, 2}),
                         [](const auto& tested) {
                             return "Of" + std::to_string(tested.param.first) + "By" +
                                    std::to_string(tested.param.second);
                         });

// A crop that is not of the cube ends the link with a reason, and nobody else's.
TEST(CropOfAnotherCube, EndsTheLink) {
    const support::TemporaryFolder scratch;
    const std::string path = scratch.path("cube.fits");
    ASSERT_TRUE(samples::write_sample("nbody-web", {21, 23, 25}, 3, path));
    deploy::LocalTree::Options options;
    options.cube.path = path;
    options.cube.range = {0, 2};
    options.tree.tree = {2, 2};
    const link::Secret secret = link::Secret::random();
    auto tree = deploy::LocalTree::start(options, secret);
    ASSERT_TRUE(tree) << tree.error().message();
    support::TreeClient client(tree->address(), secret), other(tree->address(), secret);
    ASSERT_TRUE(client.wait_ready() && client.wait_described() && other.wait_ready());
    wire::View view = support::twenty_views(*client.lattice()).front();
    view.crop = Box{{0, 0, 0}, {20, 22, 25}};
    client.ask(view);
    ASSERT_TRUE(client.wait_until([&] { return client.down().has_value(); }));
    EXPECT_EQ(client.down()->reason, wire::pb::REASON_INVALID);
    EXPECT_NE(client.down()->text.find("crop"), std::string::npos) << client.down()->text;
    view.crop->hi[2] = 24;
    EXPECT_TRUE(other.draw(view));
}

}  // namespace
}  // namespace shearwater
