// Pre-integrated pictures: hats that samples step over beside the independent ray caster, and one picture for
// whatever is skipped.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using view::Camera;
using view::Classify;
using view::Lattice;
using view::Projection;
using view::Quality;

// A sharp top-hat over so much of the values: rays cross it in a fraction of a voxel.
view::TransferFunction hat(double width, double height = 0.9) {
    return {.opacity_pins = {view::Hat{0.5, width, width, height}},
            .colour_pins = {{0, {1, 0.2, 0.1}}, {1, {0.1, 0.6, 1}}}};
}

// Against rays in steps fine enough that the hat is hit many times.
struct Gain {
    double post, pre_integrated;
};
Gain gain(Scene& scene, const Camera& camera, Quality quality = Quality::normal) {
    base::Workers workers;
    const view::ImageSize size{150, 150};
    const auto volume = bricks_of(scene.cube, workers, scene.mapping);
    const auto truth = in_8_bits(
        cast_rays(scene.cube, scene.spacing, scene.mapping, scene.tf, camera, size, workers, 1.0 / 64));
    const auto at = [&](Classify classify) {
        return psnr(in_8_bits(picture_of(volume, scene.lattice(), scene.tf, camera, size, workers,
                                         view::sampling(quality, false, classify))),
                    truth);
    };
    return {at(Classify::post), at(Classify::pre_integrated)};
}

// The distance from a point outside the cube: level sets are spheres.
FloatCube shells(const volume::Index3& n) {
    return FloatCube(n, [&](double x, double y, double z) {
        return static_cast<float>(std::hypot(x + 3, y - 11, z + 7) / 80);
    });
}

TEST(SharpHat, HasNoRings) {
    for (const double width : {0.004, 0.01}) {
        Scene scene{.cube = shells({48, 44, 40}), .mapping = {.bits = 16}, .tf = hat(width)};
        for (const auto projection : {Projection::perspective, Projection::parallel}) {
            const Camera camera = view::camera_on({30, 20}, scene.lattice(), projection);
            const Gain found = gain(scene, camera);
            std::printf("width %.3f: post %.1f dB, pre-integrated %.1f dB\n", width, found.post,
                        found.pre_integrated);
            EXPECT_GE(found.pre_integrated, found.post + 10);
        }
    }
}

}  // namespace
}  // namespace shearwater::test
