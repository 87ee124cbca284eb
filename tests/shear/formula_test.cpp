// Pictures that a formula gives: a homogeneous body of chord L has alpha = 1 - exp(-tau L).

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/image/warp.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using image::Image;
using image::RgbaF;
using view::Camera;
using view::Face;
using view::Factorisation;
using view::ImageSize;
using view::Lattice;
using view::Vec3;

view::TransferFunction flat(double tau) {
    return {.opacity_pins = {view::Flat{-std::expm1(-tau)}}, .colour_pins = {{0, {1, 0.5, 0.25}}}};
}

struct Worst {
    double error = 0;
    int pixels = 0;
    void add(double got, double expected) {
        error = std::max(error, std::abs(got - expected) / expected);
        ++pixels;
    }
};

constexpr std::array both_ways{view::Classify::post, view::Classify::pre_integrated};
const char* name_of(view::Classify classify) {
    return classify == view::Classify::post ? ", post" : ", pre-integrated";
}

// The ray of an intermediate pixel, by the definition in the header.
Chord chord_of_pixel(const Factorisation& f, const Face& face, double i, double j) {
    const double at_u = face.origin.x + i * face.pitch.x;
    const double at_v = face.origin.y + j * face.pitch.y;
    const bool perspective = f.projection == view::Projection::perspective;
    Vec3 origin = f.eye;
    Vec3 direction = f.direction;
    if (perspective) {
        direction[face.axis] = face.sign;
        direction[face.u_axis()] = face.sign * at_u;
        direction[face.v_axis()] = face.sign * at_v;
    } else {
        origin[face.axis] = 0;
        origin[face.u_axis()] = at_u;
        origin[face.v_axis()] = at_v;
    }
    return chord_of(f.lattice.n, f.lattice.spacing, origin, direction, perspective);
}

// The sampling alone: every intermediate pixel of every window whose ray advances a whole slice or more.
Worst window_error(const Factorisation& f, const std::vector<image::Window>& windows, double tau) {
    Worst worst;
    for (const image::Window& window : windows) {
        const Face& face = f.faces[static_cast<std::size_t>(window.face)];
        for (int j = window.rect.y0; j < window.rect.y1; ++j) {
            for (int i = window.rect.x0; i < window.rect.x1; ++i) {
                const Chord chord = chord_of_pixel(f, face, i, j);
                const double alpha =
                    static_cast<double>(window.pixels.at(i - window.rect.x0, j - window.rect.y0).a);
                if (chord.length > 1.001 * f.step(face, i, j)) {
                    worst.add(alpha, -std::expm1(-tau * chord.length));
                }
            }
        }
    }
    return worst;
}

// The picture: every pixel farther than 3 from where rays begin to come in or go out by another face of
// the cube, the silhouette being one such place. There the chord has a crease, which an intermediate
// image of finite pitch rounds off.
Worst picture_error(const Image<RgbaF>& picture, const Lattice& lattice, const Camera& camera, double tau,
                    double slice_pitch = 1) {
    const ImageSize size{picture.width(), picture.height()};
    Worst worst;
    for (int y = 0; y < size.height; y += 2) {
        for (int x = 0; x < size.width; x += 2) {
            const auto chord = [&](double dx, double dy) {
                return chord_of(lattice.n, lattice.spacing, camera, size, x + 0.5 + dx, y + 0.5 + dy);
            };
            const Chord here = chord(0, 0);
            bool even = here.out >= 0 && here.slices > 1.001 * slice_pitch;
            for (const double dx : {-3, 0, 3}) {
                for (const double dy : {-3, 0, 3}) {
                    const Chord there = chord(dx, dy);
                    even = even && there.in == here.in && there.out == here.out;
                }
            }
            if (even) {
                worst.add(static_cast<double>(picture.at(x, y).a), -std::expm1(-tau * here.length));
            }
        }
    }
    return worst;
}

// A ball about the cube's middle with a soft edge.
FloatCube ball(const Lattice& lattice, double radius) {
    return FloatCube(lattice.n, [&](double x, double y, double z) {
        const double r = glm::length(lattice.world_from_voxel({x, y, z}));
        return static_cast<float>(std::clamp((radius - r) / 2 + 0.5, 0.0, 1.0));
    });
}

// Of the pixels whose rays pass well inside the ball: tau times the chord 2 sqrt(R^2 - b^2) for a ray that
// passes its centre at the distance b, where that is longer than `shortest`.
Worst ball_error(const Image<RgbaF>& picture, const Camera& camera, double radius, double tau,
                 double shortest) {
    const view::Rays rays = view::rays_of(camera, {picture.width(), picture.height()});
    const bool perspective = camera.projection == view::Projection::perspective;
    Worst worst;
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const Vec3 origin = rays.origin_at(x + 0.5, y + 0.5);
            const Vec3 direction = glm::normalize(rays.direction_at(x + 0.5, y + 0.5));
            const double middle = -glm::dot(origin, direction);
            const double off = glm::length(origin + middle * direction);
            if (off > 0.6 * radius) {
                continue;
            }
            const double half = std::sqrt(radius * radius - off * off);
            const double from = perspective ? std::max(middle - half, 0.0) : middle - half;
            const double chord = middle + half - from;
            if (chord > shortest) {
                worst.add(static_cast<double>(picture.at(x, y).a), -std::expm1(-tau * chord));
            }
        }
    }
    return worst;
}

class SlabTest : public testing::TestWithParam<Vec3> {};

TEST_P(SlabTest, HasTheOpacityOfItsThicknessInEveryView) {
    base::Workers workers;
    const Lattice lattice{{37, 70, 23}, GetParam()};
    FloatCube cube(lattice.n, [](double, double, double) { return 0.5F; });
    const auto volume = bricks_of(cube, workers);
    const ImageSize size{120, 91};
    int pixels = 0;
    for (const double depth : {0.001, 2.0}) {  // through the diagonal
        const double tau = depth / lattice.diagonal();
        for (const auto& [name, camera] : all_views(lattice, depth < 1 ? 5 : 1)) {
            for (const view::Classify classify : both_ways) {
                const auto f = view::factorise(camera, size, lattice, {.classify = classify});
                const auto windows = shear::render(volume, f, flat(tau), workers).windows;
                EXPECT_LT(window_error(f, windows, tau).error, 2e-4)
                    << name << ", depth " << depth << name_of(classify);
                const auto picture = image::warp_float(f, windows, camera, size, workers);
                const Worst worst = picture_error(picture, lattice, camera, tau);
                EXPECT_LT(worst.error, 0.01) << name << ", depth " << depth << name_of(classify);
                pixels += worst.pixels;
            }
        }
    }
    EXPECT_GT(pixels, 1000);
}

constexpr std::array spacing_names{"even", "uneven", "flat", "small"};

INSTANTIATE_TEST_SUITE_P(Spacings, SlabTest,
                         testing::Values(Vec3(1, 1, 1), Vec3(0.3, 1, 4), Vec3(7, 0.2, 1),
                                         Vec3(0.01, 0.02, 0.01)),
                         [](const auto& tested) { return spacing_names[tested.index]; });

// Of any thickness, whatever the level of detail.
TEST(SlabTest, HasTheSameOpacityOnEveryLevel) {
    base::Workers workers;
    const Lattice lattice{{141, 90, 67}, {1, 0.7, 2}};
    FloatCube cube(lattice.n, [](double, double, double) { return 0.5F; });
    const auto volume = bricks_of(cube, workers);
    ASSERT_EQ(volume.levels(), 3);
    const ImageSize size{120, 91};
    int pixels = 0;
    for (const double depth : {0.001, 2.0}) {
        const double tau = depth / lattice.diagonal();
        for (const auto& [name, camera] : all_views(lattice, depth < 1 ? 5 : 1)) {
            auto f = view::factorise(camera, size, lattice, {1});
            for (f.slice_exponent = 1; f.slice_exponent < volume.levels(); ++f.slice_exponent) {
                for (const view::Classify classify : both_ways) {
                    f.classify = classify;
                    const auto windows = shear::render(volume, f, flat(tau), workers).windows;
                    EXPECT_LT(window_error(f, windows, tau).error, 2e-4)
                        << name << ", level " << f.slice_exponent << name_of(classify);
                    const auto picture = image::warp_float(f, windows, camera, size, workers);
                    const Worst worst = picture_error(picture, lattice, camera, tau, f.slice_pitch());
                    EXPECT_LT(worst.error, 0.02)
                        << name << ", level " << f.slice_exponent << name_of(classify);
                    pixels += worst.pixels;
                }
            }
        }
    }
    EXPECT_GT(pixels, 1000);
}

// A ray shorter than a slice may meet none: it is transparent then, and else has what it is due.
TEST(SlabTest, ShortRaysGetNoMoreThanTheirDue) {
    base::Workers workers;
    const Lattice lattice{{20, 20, 20}, {1, 1, 1}};
    FloatCube cube(lattice.n, [](double, double, double) { return 1.0F; });
    const auto volume = bricks_of(cube, workers);
    const double tau = 0.1;
    for (const auto& [name, camera] : all_views(lattice)) {
        auto f = view::factorise(camera, {120, 120}, lattice, {1});
        for (const view::Classify classify : both_ways) {
            f.classify = classify;
            for (const image::Window& window : shear::render(volume, f, flat(tau), workers).windows) {
                const Face& face = f.faces[static_cast<std::size_t>(window.face)];
                for (int j = window.rect.y0; j < window.rect.y1; ++j) {
                    for (int i = window.rect.x0; i < window.rect.x1; ++i) {
                        const double due = -std::expm1(-tau * chord_of_pixel(f, face, i, j).length);
                        const auto alpha =
                            static_cast<double>(window.pixels.at(i - window.rect.x0, j - window.rect.y0).a);
                        ASSERT_LT(alpha, due * 1.0002 + 1e-7) << name << name_of(classify);
                    }
                }
            }
        }
    }
}

// Extinction in proportion to s.
view::TransferFunction proportional(double tau) {
    return {.opacity_pins = {view::Ramp{0, 0, 1, -std::expm1(-tau)}}, .colour_pins = {{0, {1, 1, 1}}}};
}

TEST(BallTest, HasTheOpacityOfItsChordInEveryView) {
    base::Workers workers;
    const double radius = 22;
    const double tau = 0.01;
    for (const Vec3& spacing : {Vec3(1, 1, 1), Vec3(0.8, 1, 1.25)}) {
        const Lattice lattice{{65, 57, 49}, spacing};
        FloatCube cube = ball(lattice, radius);
        const auto volume = bricks_of(cube, workers);
        for (const auto& [name, camera] : all_views(lattice)) {
            for (const view::Classify classify : both_ways) {
                const auto picture = picture_of(volume, lattice, proportional(tau), camera, {140, 120},
                                                workers, {.classify = classify});
                const Worst worst = ball_error(picture, camera, radius, tau, 4);
                EXPECT_LT(worst.error, 0.01) << name << name_of(classify);
                EXPECT_GT(worst.pixels, 100) << name << name_of(classify);
            }
        }
    }
}

TEST(BallTest, HasTheSameOpacityOnEveryLevel) {
    base::Workers workers;
    const double radius = 60;
    const double tau = 0.005;
    const Lattice lattice{{161, 147, 133}, {0.9, 1, 1.1}};
    FloatCube cube = ball(lattice, radius);
    const auto volume = bricks_of(cube, workers);
    ASSERT_EQ(volume.levels(), 3);
    for (const auto& [name, camera] : all_views(lattice)) {
        auto f = view::factorise(camera, {140, 120}, lattice, {1});
        for (f.slice_exponent = 1; f.slice_exponent < volume.levels(); ++f.slice_exponent) {
            for (const view::Classify classify : both_ways) {
                f.classify = classify;
                const auto windows = shear::render(volume, f, proportional(tau), workers).windows;
                const auto picture = image::warp_float(f, windows, camera, {140, 120}, workers);
                const Worst worst = ball_error(picture, camera, radius, tau, 20);
                EXPECT_LT(worst.error, 0.02) << name << ", level " << f.slice_exponent << name_of(classify);
                EXPECT_GT(worst.pixels, 100) << name;
            }
        }
    }
}

}  // namespace
}  // namespace shearwater::test
