// Real cubes beside the independent ray caster, where the shared sample data is.

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
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

TEST_P(RealCube, IsTheRayCastersPicture) {
    const auto path = std::string(SHEARWATER_SHARED_DATA) + "/" + GetParam() + ".fits";
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << "no sample data: " << path;
    }
    auto file = fits::Cube::open(path);
    ASSERT_TRUE(file.has_value()) << file.error().message();
    Scene scene{.cube = FloatCube(file->info().n)};
    ASSERT_TRUE(file->read(volume::whole(scene.cube.n()), scene.cube.values()).has_value());
    volume::Histogram histogram;
    histogram.add(scene.cube.values());
    const volume::Limits limits = volume::percentile_limits(histogram, 99.5);
    scene.mapping.lo = limits.lo;
    scene.mapping.hi = limits.hi;

    const Lattice lattice = scene.lattice();
    for (const auto& [azimuth, elevation] : {std::pair{30.0, 20.0}, {255.0, 60.0}}) {
        for (const auto projection : {Projection::perspective, Projection::parallel}) {
            const Camera camera = view::camera_on({azimuth, elevation}, lattice, projection);
            const Match found = match(scene, camera, {400, 400});
            EXPECT_GE(found.at_normal, 38) << azimuth << ", " << elevation;
            EXPECT_GE(found.at_high, 40) << azimuth << ", " << elevation;
            std::printf("%s from %.0f, %.0f %s: %.1f dB, high %.1f dB\n", GetParam(), azimuth, elevation,
                        projection == Projection::parallel ? "parallel" : "perspective", found.at_normal,
                        found.at_high);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(SharedData, RealCube,
                         testing::Values("ngc6946", "l1448_13co", "WEIN069", "lidc2_ct"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace shearwater::test
