// Single rays: by formula, beside the pictures, and the same for every division of the cube.

#include "renderer/shear/ray_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

constexpr view::ImageSize size{80, 60};

double depth_of(const std::vector<view::RaySample>& samples) {
    double sum = 0;
    for (const view::RaySample& sample : samples) {
        sum += static_cast<double>(sample.depth);
    }
    return sum;
}

// In a homogeneous body the depth is that of the chord, and half of the opacity is gathered where the formula
// says.
TEST(RaySamples, OfAHomogeneousBody) {
    constexpr double tau = 0.05;
    const view::TransferFunction tf{.opacity_pins = {view::Flat{-std::expm1(-tau)}},
                                    .colour_pins = {{0, {1, 1, 1}}}};
    base::Workers workers;
    FloatCube cube({24, 18, 31}, [](double, double, double) { return 0.5F; });
    const view::Lattice lattice{cube.n(), {1, 2, 0.5}};
    const auto bricks = bricks_of(cube, workers);
    const shear::OpacityTable table(tf, bricks.mapping().levels());
    int hits = 0;
    for (const auto& [name, camera] : all_views(lattice, 3)) {
        const view::Rays rays = view::rays_of(camera, size);
        for (const view::Vec2 at : {view::Vec2{40.5, 30.5}, {31, 22}, {50.2, 37}}) {
            const view::Factorisation ray = view::factorise_ray(camera, size, at, lattice);
            ASSERT_TRUE(view::validate(ray)) << name;
            const bool begins = camera.projection == view::Projection::perspective;
            const view::Rays voxel_rays = view::in_voxel_space(rays, lattice);
            const Chord chord = chord_of(cube.n(), lattice.spacing, voxel_rays.origin_at(at.x, at.y),
                                         voxel_rays.direction_at(at.x, at.y), begins);
            const auto samples = shear::sample_ray(bricks, table, ray);
            if (chord.slices < 3) {
                continue;
            }
            EXPECT_NEAR(depth_of(samples), tau * chord.length, 0.01 * tau * chord.length) << name;
            const auto hit = view::half_way(ray, samples);
            ASSERT_TRUE(hit) << name;
            ++hits;
            EXPECT_NEAR(hit->opacity, -std::expm1(-tau * chord.length), 0.01) << name;
            // The hit lies on the ray, and half of the opacity before it.
            const view::Vec3 world = lattice.world_from_voxel(hit->voxel);
            const view::Vec3 origin = rays.origin_at(at.x, at.y);
            const view::Vec3 direction = glm::normalize(rays.direction_at(at.x, at.y));
            const double along = glm::dot(world - origin, direction);
            EXPECT_LT(glm::length(world - origin - along * direction), 1e-6) << name;
            const Chord rest =
                chord_of(cube.n(), lattice.spacing, hit->voxel, voxel_rays.direction_at(at.x, at.y), true);
            const double before = -std::expm1(-tau * (chord.length - rest.length));
            EXPECT_NEAR(before, hit->opacity / 2, 0.03) << name;
        }
    }
    EXPECT_GT(hits, 20);
}

// A wall in thin fog: what is seen is the wall's front, wherever it is looked at from.
TEST(RaySamples, FindTheSkinOfAWall) {
    base::Workers workers;
    FloatCube cube({32, 32, 32}, [](double, double, double z) { return z >= 20 ? 1.0F : 0.0F; });
    const view::Lattice lattice{cube.n(), {1, 1, 1}};
    const auto bricks = bricks_of(cube, workers);
    const view::TransferFunction tf{.opacity_pins = {view::Ramp{0.4, 0, 0.6, 0.999}},
                                    .colour_pins = {{0, {1, 1, 1}}}};
    const shear::OpacityTable table(tf, bricks.mapping().levels());
    for (const view::Projection projection : {view::Projection::perspective, view::Projection::parallel}) {
        const view::Camera camera = view::camera_on({180, 0, 0}, lattice, projection);
        const auto ray = view::factorise_ray(camera, size, {41, 31}, lattice);
        const auto hit = view::half_way(ray, shear::sample_ray(bricks, table, ray));
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->voxel.z, 19.6, 0.6);
        const auto beside = view::factorise_ray(camera, size, {1, 31}, lattice);
        EXPECT_FALSE(view::half_way(beside, shear::sample_ray(bricks, table, beside)));
    }
}

// Every sample has one owner: parts hold exactly the whole's samples, whatever the division, for 8 and for 16
// bits, blanks included.
TEST(RaySamples, AreTheSameForEveryDivision) {
    base::Workers workers;
    std::mt19937 random(4);
    FloatCube cube = noise_cube({29, 33, 26});
    for (int i = 0; i < 500; ++i) {
        cube.values()[random() % cube.values().size()] = std::nanf("");
    }
    const view::Lattice lattice{cube.n(), {1, 1, 1.5}};
    for (const int bits : {8, 16}) {
        const volume::Mapping mapping{.bits = bits};
        const auto whole = bricks_of(cube, workers, mapping);
        const shear::OpacityTable table(ramp_to(0.2), mapping.levels());
        std::vector<shear::BrickVolume> parts;
        for (int octant = 0; octant < 8; ++octant) {
            volume::Box box = volume::whole(cube.n());
            for (std::size_t a = 0; a < 3; ++a) {
                const std::int64_t cut = 9 + static_cast<std::int64_t>(a) * 3;
                ((octant >> a & 1) != 0 ? box.lo : box.hi)[a] = cut;
            }
            parts.push_back(bricks_of(cube, box, workers, mapping));
        }
        std::size_t taken = 0;
        for (const auto& [name, camera] : all_views(lattice)) {
            const view::Vec2 at{static_cast<double>(random() % 80), static_cast<double>(random() % 60)};
            const auto ray = view::factorise_ray(camera, size, at, lattice);
            const auto all = shear::sample_ray(whole, table, ray);
            std::vector<view::RaySample> put_together;
            for (const shear::BrickVolume& part : parts) {
                const auto samples = shear::sample_ray(part, table, ray);
                put_together.insert(put_together.end(), samples.begin(), samples.end());
            }
            std::ranges::sort(put_together, [&](const auto& a, const auto& b) {
                return ray.faces[0].sign > 0 ? a.slice < b.slice : a.slice > b.slice;
            });
            EXPECT_EQ(put_together, all) << name << ", " << bits << " bits";
            taken += all.size();
        }
        EXPECT_GT(taken, 500U);
    }
}

}  // namespace
}  // namespace shearwater::test
