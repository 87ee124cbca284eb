// The protocol of joining, drawing, dying and coming back, over many orders of events.

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

constexpr volume::Index3 small_cube{11, 9, 13};

// Whatever the order in which daemons join and messages arrive, the tree becomes ready, its limits are the
// cube's, and the picture is the same.
TEST(Simulation, EveryOrderOfJoiningEndsInTheSamePicture) {
    Waves source(true);
    std::optional<image::Image<image::Rgba8>> first;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        support::Simulation simulation(seed, *tree::full_tree(2, 3), small_cube, source);
        std::vector<tree::Place> places = all_daemons(simulation);
        std::ranges::shuffle(places, simulation.fabric().random());
        const wire::View view = view_of(small_cube);
        const std::uint64_t revision = simulation.ask(view);
        for (const tree::Place place : places) {
            simulation.start_daemon(place);
            simulation.run_some(static_cast<int>(simulation.fabric().random()() % 20));
        }
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); }))
            << "seed " << seed;
        const auto picture = picture_of(*simulation.newest_frame(), view);
        EXPECT_TRUE(support::lit(picture));
        if (!first) {
            first = picture.clone();
        }
        EXPECT_EQ(support::difference(*first, picture).largest, 0) << "seed " << seed;
    }
}

constexpr volume::Index3 large_cube{70, 9, 11};  // with a level of its own for a sketch

// However things fall, whoever welcomes sketches is sent the cube's picture in the end, unasked, and
// the picture of a sketch, where one was sent, is the same for every tree. Whoever does not is never sent
// one.
TEST(Simulation, ASketchComesFirstAndTheCubeByItself) {
    Waves source(true);
    std::optional<image::Image<image::Rgba8>> sketch, whole;
    int sketches = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        const bool welcome = seed % 4 != 0;
        support::Simulation simulation(seed, *tree::full_tree(2, 2 + static_cast<int>(seed % 3)), large_cube,
                                       source, 1);
        wire::View view = view_of(large_cube);
        view.sketch = welcome;
        const std::uint64_t revision = simulation.ask(view);
        for (const tree::Place place : all_daemons(simulation)) {
            simulation.start_daemon(place);
        }
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); }))
            << "seed " << seed;
        const auto picture = picture_of(*simulation.newest_frame(), view);
        whole = whole ? std::move(whole) : picture.clone();
        EXPECT_LE(support::difference(*whole, picture).largest, 1) << "seed " << seed;
        const int frames = simulation.frames();
        simulation.run_some(2000);
        EXPECT_EQ(simulation.frames(), frames) << "nothing more to come";
        EXPECT_FALSE(simulation.newest_sketch() && !welcome);
        const bool is_whole = simulation.newest_sketch() &&
                              std::get<wire::pb::Frame>(simulation.newest_sketch()->body).missing_size() == 0;
        if (is_whole) {
            ++sketches;
            const auto first_look = picture_of(*simulation.newest_sketch(), view);
            EXPECT_TRUE(support::lit(first_look));
            sketch = sketch ? std::move(sketch) : first_look.clone();
            EXPECT_LE(support::difference(*sketch, first_look).largest, 1) << "seed " << seed;
        }
    }
    EXPECT_GT(sketches, 6);
}

// Voxels that can only be had in slabs: no sketch, and no harm.
TEST(Simulation, WhereNoSketchCanBeHadTheCubeIsWaitedFor) {
    Waves source(false);
    support::Simulation simulation(1, *tree::full_tree(2, 3), large_cube, source, 1);
    wire::View view = view_of(large_cube);
    view.sketch = true;
    const std::uint64_t revision = simulation.ask(view);
    for (const tree::Place place : all_daemons(simulation)) {
        simulation.start_daemon(place);
    }
    ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); }));
    EXPECT_FALSE(simulation.newest_sketch());
    EXPECT_EQ(simulation.frames(), 1);
}

// Daemons die and come back at any moment, several at once, while a client asks: every request is answered,
// and when all are back the picture is whole and right.
struct Storm {
    std::uint64_t seeds;
    volume::Index3 n = small_cube;
    view::ImageSize size = {.width = 24, .height = 20};
    int sketch_level = 0;
};
void storm(const Storm& storm) {
    Waves source(true);
    wire::View view = view_of(storm.n, storm.size);
    view.sketch = storm.sketch_level > 0;
    for (std::uint64_t seed = 0; seed < storm.seeds; ++seed) {
        support::Simulation simulation(seed, *tree::full_tree(2, seed % 2 == 0 ? 3 : 4), storm.n, source,
                                       storm.sketch_level);
        const std::vector<tree::Place> places = all_daemons(simulation);
        std::ranges::for_each(places, [&](tree::Place place) { simulation.start_daemon(place); });
        const std::uint64_t calm = simulation.ask(view);
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(calm); })) << "seed " << seed;
        const auto expected = picture_of(*simulation.newest_frame(), view);

        auto& random = simulation.fabric().random();
        for (int blow = 0; blow < 12; ++blow) {
            const tree::Place place = places[random() % places.size()];
            if (simulation.running(place)) {
                simulation.kill_daemon(place);
            } else {
                simulation.start_daemon(place);
            }
            const std::uint64_t revision = simulation.ask(view);
            simulation.run_some(static_cast<int>(random() % 60));
            if (blow % 3 == 0) {
                ASSERT_TRUE(simulation.run_until([&] { return simulation.answered(revision); }))
                    << "seed " << seed;
            }
        }
        for (const tree::Place place : places) {
            if (!simulation.running(place)) {
                simulation.start_daemon(place);
            }
        }
        const std::uint64_t last = simulation.ask(view);
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(last); })) << "seed " << seed;
        EXPECT_EQ(support::difference(expected, picture_of(*simulation.newest_frame(), view)).largest, 0)
            << "seed " << seed;
        EXPECT_TRUE(simulation.run_until([&] { return simulation.head().roster().all_ready(); }));
        EXPECT_EQ(simulation.pictures(), 0U) << "seed " << seed;
    }
}

TEST(Simulation, AnyStormOfDeathsEndsWhole) {
    storm({.seeds = 24});
}

TEST(Simulation, AnyStormOfDeathsWhileSketchesAreSeenEndsWhole) {
    storm({.seeds = 12, .n = large_cube, .sketch_level = 1});
}

// Of pictures in several bands: a daemon dies between two of a frame's.
TEST(Simulation, AnyStormOfDeathsBetweenBandsEndsWhole) {
    constexpr view::ImageSize size{.width = 180, .height = 560};
    const wire::View view = view_of(small_cube, size);
    const auto factorisation = view::factorise(
        view.camera, view.size, {.n = small_cube, .spacing = {1, 1, 1}}, view::sampling(view.quality));
    ASSERT_GE(view::bands_of(factorisation).size(), 3U);
    storm({.seeds = 10, .size = size});
}

// A client's limits, asked for at any moment and taken back, with and without sketches, while daemons die: in
// the end pictures are those of a tree that had the limits first, and those of one that never had them.
TEST(Simulation, OtherLimitsEndAsIfTheyHadBeenThereFirst) {
    Waves source(true);
    const wire::View plain = view_of(large_cube);
    wire::View scaled = plain;
    scaled.scaling = volume::Scaling{4, 31, volume::Stretch::sqrt};
    std::vector<image::Image<image::Rgba8>> expected;
    for (const wire::View& view : {plain, scaled}) {
        support::Simulation simulation(1, *tree::full_tree(2, 3), large_cube, source);
        std::ranges::for_each(all_daemons(simulation), [&](tree::Place p) { simulation.start_daemon(p); });
        const std::uint64_t revision = simulation.ask(view);
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); }));
        expected.push_back(picture_of(*simulation.newest_frame(), view));
    }
    EXPECT_GT(support::difference(expected[0], expected[1]).largest, 20);
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        const bool sketched = seed % 2 == 0, deadly = seed % 3 == 0;
        support::Simulation simulation(seed, *tree::full_tree(2, 3), large_cube, source, sketched ? 1 : 0);
        const std::vector<tree::Place> places = all_daemons(simulation);
        std::ranges::for_each(places, [&](tree::Place place) { simulation.start_daemon(place); });
        auto& random = simulation.fabric().random();
        for (int change = 0; change < 5; ++change) {
            wire::View view = change % 2 == 0 ? scaled : plain;
            view.sketch = sketched;
            simulation.run_some(static_cast<int>(random() % 300));
            const std::uint64_t revision = simulation.ask(view);
            if (deadly) {
                const tree::Place victim = places[random() % places.size()];
                simulation.run_some(static_cast<int>(random() % 60));
                simulation.kill_daemon(victim);
                simulation.run_some(static_cast<int>(random() % 60));
                simulation.start_daemon(victim);
            }
            if (change > 2 || random() % 2 == 0) {
                ASSERT_TRUE(simulation.run_until([&] {
                    return simulation.answered_whole(revision) && simulation.head().serving();
                })) << "seed "
                    << seed << " change " << change;
                const auto picture = picture_of(*simulation.newest_frame(), view);
                EXPECT_LE(support::difference(expected[change % 2 == 0 ? 1 : 0], picture).largest, 1)
                    << "seed " << seed << " change " << change;
                EXPECT_EQ(simulation.head().mapping()->scaling() == *scaled.scaling, change % 2 == 0);
            }
        }
        EXPECT_TRUE(simulation.run_until([&] { return simulation.head().roster().all_ready(); }));
        EXPECT_EQ(simulation.pictures(), 0U) << "seed " << seed;
    }
}

// Both eyes arrive together, whole, whatever the order of events and whoever dies meanwhile, and nothing is
// left behind of pairs that are given up.
TEST(Simulation, PairsOfEyesComeTogether) {
    Waves source(true);
    std::vector<image::Image<image::Rgba8>> first;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        support::Simulation simulation(seed, *tree::full_tree(2, 2 + static_cast<int>(seed % 2)), small_cube,
                                       source);
        const std::vector<tree::Place> places = all_daemons(simulation);
        for (const tree::Place place : places) {
            simulation.start_daemon(place);
        }
        wire::View view = view_of(small_cube);
        view.stereo = view::StereoSettings();
        view.crop = volume::Box{{1, 0, 2}, {9, 8, 12}};
        if (seed % 3 == 0) {
            view.culling.kind = culling::Kind::opof;
        }
        const tree::Place victim = places.back();
        for (int asked = 0; asked < 4; ++asked) {
            view.quality = asked % 2 == 0 ? view::Quality::high : view::Quality::draft;
            simulation.ask(view);
            simulation.run_some(static_cast<int>(simulation.fabric().random()() % 150));
            if (asked == 2 && seed % 2 == 0) {
                simulation.kill_daemon(victim);
                simulation.run_some(30);
            }
        }
        view.quality = view::Quality::normal;
        const std::uint64_t revision = simulation.ask(view);
        if (!simulation.running(victim)) {
            ASSERT_TRUE(simulation.run_until([&] { return simulation.answered(revision); }));
            EXPECT_TRUE(wire::pictures_from(*simulation.newest_frame(), view.size, 2));
            simulation.start_daemon(victim);
        }
        ASSERT_TRUE(simulation.run_until([&] { return simulation.answered_whole(revision); }))
            << "seed " << seed;
        const auto pair = wire::pictures_from(*simulation.newest_frame(), view.size, 2);
        ASSERT_TRUE(pair) << pair.error().text;
        EXPECT_EQ(simulation.pictures(), 0U) << "seed " << seed;
        if (first.empty()) {
            for (const auto& eye : *pair) {
                first.push_back(eye.clone());
                EXPECT_TRUE(support::lit(eye));
            }
            EXPECT_GT(support::difference(first[0], first[1]).largest, 4);
        }
        EXPECT_LE(support::difference(first[0], pair->front()).largest, 1) << "seed " << seed;
        EXPECT_LE(support::difference(first[1], pair->back()).largest, 1) << "seed " << seed;
    }
}

}  // namespace
}  // namespace shearwater
