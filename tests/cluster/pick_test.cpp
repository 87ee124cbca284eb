// What is under a point of the picture, asked of whole trees: the same as of one process, whatever the tree.

#include <gtest/gtest.h>

#include <cmath>

#include "common/volume/interpolate.h"
#include "renderer/shear/ray_samples.h"
#include "tests/support/simulated_views.h"
#include "tests/support/simulation.h"

namespace shearwater {
namespace {

constexpr volume::Index3 cube{21, 18, 25};
constexpr view::ImageSize size{64, 48};

std::vector<wire::PickRequest> questions() {
    std::vector<wire::PickRequest> all;
    const view::Lattice lattice{.n = cube};
    for (int i = 0; i < 12; ++i) {
        const double distance = i % 3 == 0 ? 5 : 0;  // inside, and afar
        const view::Orbit orbit{40.0 * i, 13.0 * i - 70, distance, {0.5, 1, -1}, 11.0 * i};
        const auto projection = i % 4 == 3 ? view::Projection::parallel : view::Projection::perspective;
        all.push_back({.revision = static_cast<std::uint64_t>(i + 1),
                       .camera = view::camera_on(orbit, lattice, projection),
                       .size = size,
                       .at = {20.0 + 2.1 * i, 30.0 - i},
                       .tf = view::default_transfer_function()});
        if (i % 3 == 1) {
            all.back().crop = volume::Box{{4, 2, 6}, {15, 16, 19}};
        }
    }
    return all;
}

void start_all(support::Simulation& simulation) {
    for (std::size_t place = 1; place < simulation.plan().nodes.size(); ++place) {
        simulation.start_daemon(static_cast<tree::Place>(place));
    }
    ASSERT_TRUE(simulation.run_until([&] { return simulation.head().serving(); }));
}

wire::PickAnswer ask(support::Simulation& simulation, const wire::PickRequest& question) {
    const std::size_t before = simulation.picked().size();
    simulation.pick(question);
    EXPECT_TRUE(simulation.run_until([&] { return simulation.picked().size() > before; }));
    return simulation.picked().back();
}

TEST(Pick, IsAnsweredAlikeByEveryTree) {
    support::Waves source(true);
    std::optional<shear::BrickVolume> whole;
    base::Workers workers{1};
    const view::Lattice lattice{.n = cube};
    int hits = 0;
    for (const tree::Topology& topology : {*tree::full_tree(2, 2), *tree::full_tree(2, 3)}) {
        support::Simulation simulation(3, topology, cube, source);
        start_all(simulation);
        if (!whole) {
            whole = *shear::BrickVolume::load(source, volume::whole(cube), cube, *simulation.head().mapping(),
                                              workers);
        }
        for (const wire::PickRequest& question : questions()) {
            const wire::PickAnswer answer = ask(simulation, question);
            EXPECT_EQ(answer.revision, question.revision);
            EXPECT_FALSE(answer.incomplete);
            auto ray = view::factorise_ray(question.camera, size, question.at, lattice);
            ray.crop = question.crop;
            const shear::OpacityTable table(question.tf, whole->mapping().levels());
            const auto expected = view::half_way(ray, shear::sample_ray(*whole, table, ray));
            ASSERT_EQ(answer.hit.has_value(), expected.has_value()) << question.revision;
            if (expected) {
                ++hits;
                for (int axis = 0; question.crop && axis < 3; ++axis) {
                    const auto a = static_cast<std::size_t>(axis);
                    EXPECT_GE(answer.hit->voxel[axis], static_cast<double>(question.crop->lo[a]) - 1e-6);
                    EXPECT_LE(answer.hit->voxel[axis], static_cast<double>(question.crop->hi[a]) + 1e-6);
                }
                EXPECT_LT(glm::length(answer.hit->voxel - expected->voxel), 1e-9);
                EXPECT_NEAR(answer.hit->opacity, expected->opacity, 1e-9);
                const view::Vec3& at = expected->voxel;
                EXPECT_NEAR(answer.value, *volume::value_at(source, cube, {at.x, at.y, at.z}), 1e-6);
            }
        }
    }
    EXPECT_GT(hits, 10);
}

// A leaf that is gone makes an answer incomplete if the ray may meet its part, and holds up none.
TEST(Pick, IsAnsweredWithoutALeafThatIsGone) {
    support::Waves source(true);
    support::Simulation simulation(5, *tree::full_tree(2, 3), cube, source);
    start_all(simulation);
    const std::vector<wire::PickRequest> all = questions();
    ASSERT_FALSE(ask(simulation, all[1]).incomplete);
    for (std::size_t place = 1; place < simulation.plan().nodes.size(); ++place) {
        if (simulation.plan().at(static_cast<tree::Place>(place)).children.empty()) {
            simulation.kill_daemon(static_cast<tree::Place>(place));
        }
    }
    const wire::PickAnswer answer = ask(simulation, all[1]);
    EXPECT_TRUE(answer.incomplete);
    EXPECT_FALSE(answer.hit);
}

// While a leaf counts and loads it has nothing to say.
TEST(Pick, IsAnsweredBeforeTheTreeIsReady) {
    support::Waves source(true);
    support::Simulation simulation(6, *tree::full_tree(2, 2), cube, source);
    const wire::PickAnswer answer = ask(simulation, questions()[1]);
    EXPECT_TRUE(answer.incomplete);
    EXPECT_FALSE(answer.hit);
}

// Of picks that come faster than answers the newest is answered, and nothing piles up.
TEST(Pick, TheNewestWins) {
    support::Waves source(true);
    support::Simulation simulation(7, *tree::full_tree(2, 3), cube, source);
    start_all(simulation);
    wire::PickRequest question = questions()[1];
    for (int i = 0; i < 50; ++i) {
        question.revision = static_cast<std::uint64_t>(100 + i);
        simulation.pick(question);
    }
    ASSERT_TRUE(simulation.run_until(
        [&] { return !simulation.picked().empty() && simulation.picked().back().revision == 149; }));
    EXPECT_LE(simulation.picked().size(), 50U);
}

// A pick that is none ends its client's link, and nothing else.
TEST(Pick, OneThatIsNoneEndsTheLink) {
    support::Waves source(true);
    wire::PickRequest outside = questions()[1], elsewhere = outside, beyond = questions()[3];
    outside.at.x = -1;
    elsewhere.crop = volume::Box{{0, 0, 0}, {400, 400, 400}};
    beyond.camera.height = 1e156;
    for (const wire::PickRequest& question : {outside, elsewhere, beyond}) {
        support::Simulation simulation(8, *tree::full_tree(2, 2), cube, source);
        start_all(simulation);
        ASSERT_EQ(simulation.head().clients(), 1U);
        simulation.pick(question);
        ASSERT_TRUE(simulation.run_until([&] { return simulation.head().clients() == 0; }));
        EXPECT_TRUE(simulation.picked().empty());
        EXPECT_TRUE(simulation.head().serving());
    }
}

}  // namespace
}  // namespace shearwater
