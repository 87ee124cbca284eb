// Real cubes beside the independent ray caster, where the shared sample data is.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "common/fits/cube.h"
#include "common/volume/statistics.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using view::Camera;
using view::Lattice;
using view::Projection;

class RealCube : public testing::TestWithParam<const char*> {};

// The cube of a file, its limits as a user gets them who says nothing.
void open(const std::string& path, std::optional<Scene>& scene) {
    auto file = fits::Cube::open(path);
    ASSERT_TRUE(file.has_value()) << file.error().message();
    scene.emplace(Scene{.cube = FloatCube(file->info().n)});
    ASSERT_TRUE(file->read(volume::whole(scene->cube.n()), scene->cube.values()).has_value());
    volume::Histogram histogram;
    histogram.add(scene->cube.values());
    const volume::Limits limits = volume::percentile_limits(histogram, 99.5);
    scene->mapping.lo = limits.lo;
    scene->mapping.hi = limits.hi;
}

void expect_match(Scene& scene, const std::string& view, const Camera& camera, const view::ImageSize& size) {
    const Match found = match(scene, camera, size);
    EXPECT_GE(found.at_normal, 38) << view;
    EXPECT_GE(found.at_high, 40) << view;
    std::printf("%s: %.1f dB, high %.1f dB\n", view.c_str(), found.at_normal, found.at_high);
}

TEST_P(RealCube, IsTheRayCastersPicture) {
    const auto path = std::string(SHEARWATER_SHARED_DATA) + "/" + GetParam() + ".fits";
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no sample data: " << path;
    }
    std::optional<Scene> scene;
    ASSERT_NO_FATAL_FAILURE(open(path, scene));
    const Lattice lattice = scene->lattice();
    for (const auto& [azimuth, elevation] : {std::pair{30.0, 20.0}, {255.0, 60.0}}) {
        for (const auto projection : {Projection::perspective, Projection::parallel}) {
            expect_match(*scene,
                         std::string(GetParam()) + " from " + std::to_string(azimuth) +
                             (projection == Projection::parallel ? ", parallel" : ", perspective"),
                         view::camera_on({azimuth, elevation}, lattice, projection), {400, 400});
        }
    }
}

// Close by and from within, a voxel is many pixels wide, and what lies between two slices shows.
TEST_P(RealCube, IsSoCloseBy) {
    const auto path = std::string(SHEARWATER_SHARED_DATA) + "/" + GetParam() + ".fits";
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no sample data: " << path;
    }
    std::optional<Scene> scene;
    ASSERT_NO_FATAL_FAILURE(open(path, scene));
    for (const double azimuth : {30.0, 255.0}) {
        for (const NamedView& view : views_from(scene->lattice(), azimuth, 20)) {
            expect_match(*scene, std::string(GetParam()) + ", " + view.name, view.camera, {300, 300});
        }
        Camera half = view::camera_on({azimuth, 20}, scene->lattice(), Projection::parallel);
        half.height /= 2;
        expect_match(*scene, std::string(GetParam()) + ", half of it, parallel", half, {300, 300});
    }
}

INSTANTIATE_TEST_SUITE_P(SharedData, RealCube,
                         testing::Values("ngc6946", "l1448_13co", "WEIN069", "lidc2_ct"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace shearwater::test
