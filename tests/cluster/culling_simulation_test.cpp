// What is hidden is left out of a simulated tree's pictures, whoever finds out what is: the head, or its
// renderers.

#include <gtest/gtest.h>

#include "tests/support/pictures.h"
#include "tests/support/simulated_views.h"
#include "tests/support/simulation.h"

namespace shearwater {
namespace {

using support::all_daemons;
using support::picture_of;
using support::view_of;
using support::Waves;

class CullingSimulation : public testing::TestWithParam<head::Deciding> {
  protected:
    static bool shared() { return GetParam() == head::Deciding::by_renderers; }

    static void start_all(support::Simulation& simulation) {
        for (const tree::Place place : all_daemons(simulation)) {
            simulation.start_daemon(place);
        }
    }
    // Along an axis, so that blocks lie behind one another.
    static wire::View from_the_front(const volume::Index3& n) {
        wire::View view = view_of(n);
        view.level_of_detail = false;
        view.camera = view::camera_on({.azimuth = 0, .elevation = 0}, {.n = n, .spacing = {1, 1, 1}},
                                      view::Projection::parallel);
        return view;
    }
    // Until a picture is looked at by renderers alone, if they are to.
    static void wait_for_sharing(const support::Simulation& simulation, const std::function<void()>& draw) {
        bool is_shared = false;
        for (int n = 0; n < 100 && !is_shared; ++n) {
            const int by_head = simulation.head_looks(), by_renderers = simulation.renderer_looks();
            draw();
            is_shared = simulation.head_looks() == by_head && simulation.renderer_looks() > by_renderers;
            if (!shared()) {
                break;
            }
        }
        EXPECT_EQ(is_shared, shared());
    }
};

// Functions do for all heights of a pin: changing them asks renderers for none.
TEST_P(CullingSimulation, ChangingHeightsFindsNoFunctions) {
    const volume::Index3 n{97, 97, 65};
    Waves source(true);
    support::Simulation simulation(3, *tree::full_tree(2, 2), n, source, 0, GetParam());
    start_all(simulation);
    wire::View view = from_the_front(n);
    view.culling = {.kind = culling::Kind::opof};
    // Culled bricks of the frame by a height.
    const auto draw = [&](double height) {
        view.tf.opacity_pins = {view::Flat{height}};
        const std::uint64_t culled = simulation.culled_bricks();
        const std::uint64_t revision = simulation.ask(view);
        EXPECT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); }));
        simulation.fabric().pass_time(std::chrono::seconds(1));
        simulation.run_until([] { return false; }, std::chrono::seconds(1));
        return simulation.culled_bricks() - culled;
    };
    const int finds = 2 * 2;  // each renderer's, of blocks and of columns
    for (int frame = 0; frame < 50 && (draw(0.5) == 0 || simulation.finds() < finds); ++frame) {
    }
    EXPECT_EQ(simulation.finds(), finds);
    wait_for_sharing(simulation, [&] { draw(0.5); });
    const int head_looks = simulation.head_looks(), renderer_looks = simulation.renderer_looks();
    std::uint64_t most = 0;
    for (const double height : {0.01, 0.2, 0.35, 0.65, 0.9, 0.99, 0.3, 1.0}) {
        most = std::max(most, draw(height));
    }
    EXPECT_GT(most, 0U);
    EXPECT_EQ(simulation.finds(), finds);
    const int pictures = 8;
    EXPECT_EQ(simulation.head_looks() - head_looks, shared() ? 0 : pictures);
    EXPECT_EQ(simulation.renderer_looks() - renderer_looks, shared() ? 2 * pictures : 0) << "each a part";
}

// Functions are found, lost with whoever carries them, and found again; whole pictures stay the same
// throughout.
TEST_P(CullingSimulation, OverAnyStormOfDeathsEndsWhole) {
    const volume::Index3 n{97, 97, 65};
    Waves source(true);
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
        const tree::Topology topology = *tree::full_tree(2, 3);
        support::Simulation simulation(seed, topology, n, source, 0, GetParam());
        start_all(simulation);
        wire::View view = from_the_front(n);
        view.tf.opacity_pins = {view::Flat{0.8}};
        std::uint64_t revision = simulation.ask(view);
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); })) << seed;
        const auto expected = picture_of(*simulation.newest_frame(), view);
        view.culling = {.kind = culling::Kind::opof};
        std::mt19937_64& random = simulation.fabric().random();
        const std::vector<tree::Place> places = all_daemons(simulation);
        for (int death = 0; death < 4; ++death) {
            simulation.ask(view);
            simulation.run_some(static_cast<int>(random() % 400));
            const tree::Place victim = places[random() % places.size()];
            simulation.kill_daemon(victim);
            simulation.run_some(static_cast<int>(random() % 50));
            simulation.start_daemon(victim);
        }
        bool any = false;
        for (int n_asked = 0; n_asked < 100 && !any; ++n_asked) {
            const std::uint64_t culled = simulation.culled_bricks();
            revision = simulation.ask(view);
            ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); })) << seed;
            EXPECT_LE(support::difference(picture_of(*simulation.newest_frame(), view), expected).largest, 1)
                << seed;
            any = simulation.culled_bricks() > culled;
            simulation.fabric().pass_time(std::chrono::seconds(20));
        }
        EXPECT_TRUE(any) << seed;
        wait_for_sharing(simulation, [&] {
            revision = simulation.ask(view);
            ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); })) << seed;
            EXPECT_LE(support::difference(picture_of(*simulation.newest_frame(), view), expected).largest, 1);
            simulation.fabric().pass_time(std::chrono::seconds(20));
        });
    }
}

INSTANTIATE_TEST_SUITE_P(, CullingSimulation,
                         testing::Values(head::Deciding::by_server, head::Deciding::by_renderers),
                         [](const auto& of) {
                             return of.param == head::Deciding::by_server ? "ByServer" : "ByRenderers";
                         });

}  // namespace
}  // namespace shearwater
