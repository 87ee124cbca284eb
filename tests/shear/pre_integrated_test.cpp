// Pre-integrated pictures: hats that samples step over, beside the independent ray caster and beside what
// post-classification makes of them; and nothing skipped that can be seen.

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

// A sharp top-hat over so much of the values.
view::TransferFunction hat(double width) {
    return {.opacity_pins = {view::Hat{0.5, width, width, 0.9}},
            .colour_pins = {{0, {1, 0.2, 0.1}}, {1, {0.1, 0.6, 1}}}};
}

// One slice a voxel, however near, or two.
view::Sampling sampling(Quality quality, Classify classify) {
    view::Sampling sampling = view::sampling(quality, false, classify);
    sampling.finer_magnified = false;
    return sampling;
}

// How near both come to rays in steps fine enough to hit the hat many times, in dB.
struct Match {
    double post, pre_integrated;
};
struct Matches {
    Match at_normal, at_high;
};
Matches match(Scene& scene, const Camera& camera) {
    base::Workers workers;
    const view::ImageSize size{90, 90};
    const auto volume = bricks_of(scene.cube, workers, scene.mapping);
    const auto truth = in_8_bits(
        cast_rays(scene.cube, scene.spacing, scene.mapping, scene.tf, camera, size, workers, 1.0 / 32));
    const auto at = [&](Quality quality, Classify classify) {
        return psnr(in_8_bits(picture_of(volume, scene.lattice(), scene.tf, camera, size, workers,
                                         sampling(quality, classify))),
                    truth);
    };
    const auto both = [&](Quality quality) {
        return Match{at(quality, Classify::post), at(quality, Classify::pre_integrated)};
    };
    return {both(Quality::normal), both(Quality::high)};
}

// Values that rise with the distance from a point outside: what a hat shows of them are spherical shells.
FloatCube shells(const volume::Index3& n) {
    return FloatCube(n, [&](double x, double y, double z) {
        return static_cast<float>(std::hypot(x + 3, y - 11, z + 7) / 80);
    });
}

TEST(SharpHat, HasNoRings) {
    for (const double width : {0.002, 0.008}) {  // of which a voxel's step takes 0.0125
        Scene scene{.cube = shells({48, 44, 40}), .mapping = {.bits = 16}, .tf = hat(width)};
        for (const auto projection : {Projection::perspective, Projection::parallel}) {
            const Camera camera = view::camera_on({30, 20}, scene.lattice(), projection);
            const Match found = match(scene, camera).at_normal;
            std::printf("hat %.3f wide: post %.1f dB, pre-integrated %.1f dB\n", width, found.post,
                        found.pre_integrated);
            EXPECT_GE(found.pre_integrated, found.post + 10);
            EXPECT_GE(found.pre_integrated, 30);
        }
    }
}

TEST(SharpHat, IsBetterSeenInEveryQualityAndFromWithin) {
    Scene scene{.cube = smooth_cube({41, 37, 45}, 3), .spacing = {1, 1.3, 0.8}, .tf = hat(0.02)};
    for (const NamedView& view : views_from(scene.lattice(), 120, -35)) {
        const auto [normal, high] = match(scene, view.camera);
        std::printf("%s: post %.1f dB, %.1f dB at high; pre-integrated %.1f dB, %.1f dB\n", view.name.c_str(),
                    normal.post, high.post, normal.pre_integrated, high.pre_integrated);
        EXPECT_GE(normal.pre_integrated, normal.post + 3) << view.name;
        EXPECT_GE(high.pre_integrated, high.post) << view.name;
    }
}

// Under a smooth function there is little to gain, and nothing is lost.
TEST(SmoothRamp, IsAsGood) {
    Scene scene{.cube = smooth_cube({41, 37, 45}, 4)};
    for (const NamedView& view : views_from(scene.lattice(), 30, 20)) {
        const Match found = match(scene, view.camera).at_normal;
        EXPECT_GE(found.pre_integrated, found.post - 0.5) << view.name;
        EXPECT_GE(found.pre_integrated, 40) << view.name;
    }
}

// A blank ball in the middle, and blank voxels strewn about.
TEST(BlankVoxels, AreTransparentAndDarkenNothingBeside) {
    Scene scene{.cube = smooth_cube({41, 37, 33}, 6)};
    for (std::int64_t z = 0; z < 33; ++z) {
        for (std::int64_t y = 0; y < 37; ++y) {
            for (std::int64_t x = 0; x < 41; ++x) {
                if (std::hypot(x - 20, y - 15, z - 16) < 9 || (x * 7 + y * 13 + z * 29) % 97 == 0) {
                    scene.cube.at(x, y, z) = std::numeric_limits<float>::quiet_NaN();
                }
            }
        }
    }
    for (const NamedView& view : views_from(scene.lattice(), 30, 20)) {
        const Match found = match(scene, view.camera).at_normal;
        EXPECT_GE(found.pre_integrated, 38) << view.name;
        EXPECT_GE(found.pre_integrated, found.post - 1) << view.name;
    }
}

// Voxels of two values, and a hat between them: no sample on a voxel has opacity, nor any value that a
// micro-brick holds. With a haze that is too thin to see nothing may be skipped, and the picture is the same.
TEST(Skipping, LeavesOutNoSegmentThatIsSeen) {
    base::Workers workers;
    for (const std::int64_t where : {0, 7, 8, 9}) {
        FloatCube cube({35, 34, 36}, [&](double x, double y, double z) {
            const auto on = [&](double at) { return static_cast<std::int64_t>(at) % 16 == where; };
            return on(x) || on(y) || on(z) ? 1.0F : 0.0F;
        });
        const Lattice lattice{cube.n(), {1, 1, 1}};
        const auto volume = bricks_of(cube, workers);
        const view::TransferFunction tf = hat(0.05);
        view::TransferFunction hazy = tf;
        hazy.opacity_pins.emplace_back(view::Flat{1e-8});
        for (const NamedView& view : all_views(lattice, 5)) {
            for (const Quality quality : {Quality::normal, Quality::high}) {
                const auto picture = [&](const view::TransferFunction& function) {
                    return picture_of(volume, lattice, function, view.camera, {60, 50}, workers,
                                      sampling(quality, Classify::pre_integrated));
                };
                const auto skipped = picture(tf), whole = picture(hazy);
                EXPECT_GE(psnr(skipped, whole), 90) << view.name << ", " << where;
            }
        }
    }
}

TEST(Classifier, ClassifiesAnewForTheOtherWay) {
    base::Workers workers(1);
    FloatCube cube = shells({20, 20, 20});
    const auto volume = bricks_of(cube, workers);
    shear::Classifier classifier;
    const auto is_pre_integrated = [&](Classify how) {
        return classifier.classify(volume, hat(0.1), how, workers).segments.has_value();
    };
    EXPECT_FALSE(is_pre_integrated(Classify::post));
    EXPECT_TRUE(is_pre_integrated(Classify::pre_integrated));
    EXPECT_FALSE(is_pre_integrated(Classify::post));
}

}  // namespace
}  // namespace shearwater::test
