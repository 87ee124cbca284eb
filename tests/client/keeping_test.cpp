// Undo and redo, jumps that take a moment, and what is kept of a window.

#include "client/model/keeping.h"

#include <gtest/gtest.h>

#include "client/model/history.h"
#include "client/model/transition.h"

namespace shearwater::model {
namespace {

using namespace std::chrono_literals;

const view::Lattice kept_lattice{.n = {64, 32, 16}};
constexpr wire::Time start = wire::Time{} + 1000s;

TEST(History, ADragIsOneStep) {
    History<int> history;
    wire::Time now = start;
    history.observe(0, false, now);
    EXPECT_FALSE(history.can_undo());
    for (int i = 1; i <= 20; ++i) {
        history.observe(i, true, now += 16ms);
    }
    history.observe(20, false, now += 16ms);
    EXPECT_EQ(history.undo(), 0);
    EXPECT_FALSE(history.can_undo());
    EXPECT_EQ(history.redo(), 20);
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.undo(), 0);
}

// A wheel's notches come one by one; a pause ends the step, however long what is held stays still.
TEST(History, AStepEndsWithAPause) {
    History<int> history;
    wire::Time now = start;
    history.observe(0, false, now);
    history.observe(1, true, now += 100ms);
    history.observe(1, false, now += 100ms);
    history.observe(2, true, now += 100ms);
    history.observe(2, false, now += 400ms);
    history.observe(3, true, now += 10ms);
    history.observe(3, true, now += 10s);
    history.observe(4, true, now += 10ms);
    EXPECT_EQ(history.undo(), 2);
    EXPECT_EQ(history.undo(), 0);
}

TEST(History, ChangesThatStandAloneAreSteps) {
    History<int> history;
    history.observe(0, false, start);
    for (int i = 1; i <= 3; ++i) {
        history.observe(i, false, start + i * 1ms);
    }
    EXPECT_EQ(history.undo(), 2);
    EXPECT_EQ(history.undo(), 1);
    EXPECT_EQ(history.redo(), 2);
    history.observe(7, false, start + 1s);
    EXPECT_FALSE(history.can_redo()) << "another way was taken";
    EXPECT_EQ(history.undo(), 2);
    EXPECT_EQ(history.undo(), 1);
    EXPECT_EQ(history.undo(), 0);
    EXPECT_EQ(history.undo(), std::nullopt);
}

// What undo brings back is seen in the next pass, and is no new step.
TEST(History, WhatIsBroughtBackIsNoChange) {
    History<int> history;
    history.observe(0, false, start);
    history.observe(1, false, start + 1ms);
    EXPECT_EQ(history.undo(), 0);
    history.observe(0, false, start + 2ms);
    EXPECT_TRUE(history.can_redo());
    EXPECT_FALSE(history.can_undo());
}

TEST(History, IsBounded) {
    History<int> history;
    for (int i = 0; i < 1000; ++i) {
        history.observe(i, false, start + i * 1s);
    }
    std::size_t steps = 0;
    int last = 0;
    while (const auto state = history.undo()) {
        last = *state;
        ++steps;
    }
    EXPECT_EQ(steps, History<int>::most_steps);
    EXPECT_EQ(last, 999 - static_cast<int>(steps));
}

TEST(Remembered, IsViewpointAndTransferFunction) {
    Wish wish;
    const Remembered before = remembered(wish);
    wish.viewpoint.orbit.azimuth = 77;
    wish.tf.opacity_pins.clear();
    wish.size = {300, 200};
    const Wish changed = wish;
    restore(before, wish);
    EXPECT_EQ(remembered(wish), before);
    EXPECT_EQ(wish.size, changed.size);
}

TEST(Transition, GoesTheShorterWayAndEndsExactly) {
    const Viewpoint from{.orbit = {170, 20, 0, {}, -170}};
    const Viewpoint to{
        .orbit = {-170, 80, 10, {1, 2, 3}, 170}, .projection = view::Projection::parallel, .fov = 60};
    Transition transition;
    EXPECT_FALSE(transition.at(start));
    transition.begin(from, to, start, kept_lattice);
    EXPECT_EQ(*transition.destination(), to);
    EXPECT_NEAR(transition.at(start)->orbit.azimuth, 170, 1e-9);
    const Viewpoint middle = *transition.at(start + Transition::length / 2);
    EXPECT_NEAR(std::abs(middle.orbit.azimuth), 180, 1e-9);
    EXPECT_NEAR(std::abs(middle.orbit.roll), 180, 1e-9);
    EXPECT_NEAR(middle.orbit.elevation, 50, 1e-9);
    EXPECT_NEAR(middle.orbit.target.y, 1, 1e-9);
    EXPECT_NEAR(middle.orbit.distance, std::sqrt(10 * distance_of(from, kept_lattice)), 1e-9);
    EXPECT_EQ(*transition.at(start + Transition::length), to);
    EXPECT_FALSE(transition.under_way());
    EXPECT_FALSE(transition.at(start + 1s));
}

TEST(Transition, IsSmoothAndValidAllTheWay) {
    const Viewpoint from{.orbit = {0, -90, 1, {5, 5, 5}}}, to{.orbit = {180, 90, 0}, .fov = 120};
    Transition transition;
    transition.begin(from, to, start, kept_lattice);
    double last = -90;
    for (auto time = 0ms; time < Transition::length; time += 5ms) {
        const auto at = transition.at(start + time);
        ASSERT_TRUE(at && view::validate(*at));
        EXPECT_TRUE(view::validate(camera(*at, kept_lattice), {64, 64}));
        EXPECT_GE(at->orbit.elevation, last);
        EXPECT_LT(at->orbit.elevation - last, 10);
        last = at->orbit.elevation;
    }
}

TEST(Keeping, ASceneIsAllOfTheWishButTheSize) {
    Wish wish;
    wish.viewpoint.orbit.roll = 12;
    wish.tf.opacity_pins = {view::Flat{0.25}};
    wish.size = {300, 200};
    wish.level_of_detail = false;
    wish.classify = view::Classify::pre_integrated;
    wish.culling.kind = culling::Kind::opof;
    const Effort effort{.fixed = view::Quality::draft, .target_rate = 31};
    const scene::Scene scene = scene_of(wish, effort, "a cube");
    EXPECT_EQ(scene.size, wish.size);
    Wish other;
    other.size = {640, 480};
    Effort of_other;
    apply(scene, other, of_other);
    EXPECT_EQ(of_other, effort);
    EXPECT_EQ(other.size, (view::ImageSize{640, 480}));
    other.size = wish.size;
    EXPECT_EQ(other, wish);
}

Cube cube_named(const std::string& name) {
    Cube cube;
    cube.name = name;
    cube.lattice = kept_lattice;
    return cube;
}

TEST(Keeping, FilesAreNamedAfterTheCube) {
    EXPECT_EQ(stem_for(cube_named("galaxy.fits")), "galaxy");
    EXPECT_EQ(stem_for(cube_named("/data/NGC 6946.fits.gz")), "NGC_6946");
    EXPECT_EQ(stem_for(cube_named("synthetic:random:64")), "synthetic_random_64");
    EXPECT_EQ(stem_for(cube_named("../../etc")), "etc");
    EXPECT_EQ(stem_for(cube_named("..")), "cube..");
    EXPECT_EQ(stem_for(cube_named("")), "cube");
    EXPECT_LE(stem_for(cube_named(std::string(5000, 'x'))).size(), 100U);
}

TEST(Keeping, AutosavesAreKnownByTheirNames) {
    const Cube cube = cube_named("galaxy.fits");
    Cube larger = cube;
    larger.lattice.n = {65, 32, 16};
    EXPECT_TRUE(is_autosave(autosave_name(cube, 7), cube));
    EXPECT_TRUE(is_autosave(autosave_name(cube, 1000), cube));
    for (const std::string& name :
         {autosave_name(larger, 9), std::string("7500.secret"), autosave_name(cube, 7) + "~",
          autosave_name(cube, 7) + ".lock", autosave_name(cube_named("other.fits"), 9),
          std::string("galaxy-x.autosave.toml"), autosave_name(cube, 9) + ".1.part"}) {
        EXPECT_FALSE(is_autosave(name, cube)) << name;
    }
}

TEST(Autosave, IsDueWhenSomethingHasChangedAndNotTooOften) {
    Autosave autosave;
    scene::Scene scene;
    EXPECT_FALSE(autosave.due(scene, start));
    scene.target_rate = 21;
    EXPECT_TRUE(autosave.due(scene, start + 1ms));
    EXPECT_FALSE(autosave.due(scene, start + 1h));
    scene.target_rate = 22;
    EXPECT_TRUE(autosave.due(scene, start + 1h));
    scene.target_rate = 23;
    EXPECT_FALSE(autosave.due(scene, start + 1h + 1s));
    EXPECT_TRUE(autosave.due(scene, start + 1h + Autosave::interval));
}

}  // namespace
}  // namespace shearwater::model
