// Flights between key frames: through every key, smooth, and never beyond them.

#include "common/flight/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace shearwater::flight {
namespace {

const view::Lattice lattice{.n = {40, 50, 60}};

Key key(double time, double azimuth, double distance = 100) {
    Key made;
    made.time = time;
    made.viewpoint.orbit = {.azimuth = azimuth, .elevation = 0, .distance = distance, .target = {}};
    return made;
}

// The azimuth that a camera at a distance looks from, within +-180 degrees.
double azimuth_of(const Shot& shot) {
    const auto from = shot.camera.eye - shot.camera.target;
    return std::atan2(from.x, from.z) * 180 / M_PI;
}

double distance_of(const Shot& shot) {
    return glm::length(shot.camera.eye - shot.camera.target);
}

TEST(Flight, PassesThroughItsKeysExactly) {
    Path path;
    path.keys = {key(0, 10, 300), key(1.2, 40, 0), key(3, -20, 77)};
    path.keys[1].viewpoint.fov = 50;
    path.keys[2].viewpoint.projection = view::Projection::parallel;
    ASSERT_TRUE(validate(path));
    for (const Key& k : path.keys) {
        const Shot shot = shot_at(path, k.time, lattice);
        EXPECT_EQ(shot.camera, view::camera(k.viewpoint, lattice));
        EXPECT_EQ(shot.tf, k.tf);
    }
}

TEST(Flight, TwoKeysAreAStraightLineAndDistancesGoByFactors) {
    Path path;
    path.keys = {key(0, 0, 100), key(4, 80, 400)};
    EXPECT_NEAR(azimuth_of(shot_at(path, 1, lattice)), 20, 1e-9);
    EXPECT_NEAR(distance_of(shot_at(path, 2, lattice)), 200, 1e-9);
    EXPECT_NEAR(azimuth_of(shot_at(path, 99, lattice)), 80, 1e-9) << "it stays where it ends";
    EXPECT_NEAR(azimuth_of(shot_at(path, -3, lattice)), 0, 1e-9);
}

TEST(Flight, IsSmoothAndNeverGoesBeyondItsKeys) {
    std::mt19937 random(3);
    const auto within = [&](double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    for (int trial = 0; trial < 50; ++trial) {
        Path path;
        double time = 0;
        for (int i = 0; i < 6; ++i) {
            path.keys.push_back(key(time, within(-170, 170)));
            time += within(0.2, 3);
        }
        if (trial % 3 == 0) {
            path.keys[3].viewpoint.orbit.azimuth = path.keys[2].viewpoint.orbit.azimuth;
        }
        constexpr double step = 1e-7;
        for (std::size_t k = 0; k + 1 < path.keys.size(); ++k) {
            const double a = path.keys[k].viewpoint.orbit.azimuth,
                         b = path.keys[k + 1].viewpoint.orbit.azimuth;
            for (int i = 0; i <= 40; ++i) {
                const double t = path.keys[k].time + (path.keys[k + 1].time - path.keys[k].time) * i / 40;
                const double at = azimuth_of(shot_at(path, t, lattice));
                EXPECT_GE(at, std::min(a, b) - 1e-7);
                EXPECT_LE(at, std::max(a, b) + 1e-7);
            }
            if (k > 0) {
                const double t = path.keys[k].time;
                const double here = azimuth_of(shot_at(path, t, lattice));
                const double before = (here - azimuth_of(shot_at(path, t - step, lattice))) / step;
                const double after = (azimuth_of(shot_at(path, t + step, lattice)) - here) / step;
                EXPECT_NEAR(before, after, 0.02 * (1 + std::abs(before))) << "no kink at key " << k;
            }
        }
    }
}

TEST(Flight, CutsFromCubeToCube) {
    Path path;
    path.fps = 10;
    path.cubes.resize(2);
    path.keys = {key(0, 0), key(1, 10), key(2, 20)};
    path.keys[1].cube = 1;
    path.keys[2].cube = 0;
    EXPECT_EQ(path.frames(), 21);
    EXPECT_EQ(cube_at(path, 0.999), 0U);
    EXPECT_EQ(cube_at(path, 1), 1U);
    EXPECT_EQ(cube_at(path, 1.9), 1U);
    EXPECT_EQ(cube_at(path, 2), 0U);
}

TEST(Flight, RefusesWhatCannotBeFlown) {
    const auto refuses = [](const std::function<void(Path&)>& spoil) {
        Path path;
        path.keys = {key(0, 0), key(1, 10)};
        EXPECT_TRUE(validate(path));
        spoil(path);
        return !validate(path);
    };
    EXPECT_TRUE(refuses([](Path& path) { path.keys.clear(); }));
    EXPECT_TRUE(refuses([](Path& path) { path.fps = 0; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[0].time = 0.1; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].time = 0; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].time = 1e6; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].time = NAN; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].viewpoint.orbit.azimuth = INFINITY; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].viewpoint.orbit.elevation = 91; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].viewpoint.orbit.distance = -1; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].viewpoint.fov = 180; }));
    EXPECT_TRUE(refuses([](Path& path) { path.keys[1].tf.colour_pins.clear(); }));
    EXPECT_TRUE(refuses([](Path& path) {
        path.cubes.resize(1);
        path.keys[1].cube = 1;
    }));
}

}  // namespace
}  // namespace shearwater::flight
