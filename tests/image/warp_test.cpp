// Windows filled by formula, as functions of a ray, and warped: the picture is the same function of its
// pixels' rays.

#include "common/image/warp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace shearwater::image {
namespace {

using view::Camera;
using view::Face;
using view::Factorisation;
using view::ImageSize;
using view::Lattice;
using view::Projection;
using view::Vec3;

const Lattice lattice{{50, 40, 60}, {1, 1.2, 0.8}};

// A smooth function of a ray's direction, or of where it crosses the plane z = 0 of voxel space.
RgbaF pattern(const Vec3& origin, const Vec3& direction, bool perspective) {
    Vec3 p = glm::normalize(direction);
    if (!perspective) {
        p = 0.1 * (origin - origin.z / direction.z * direction);
    }
    const auto wave = [&](double phase) {
        return 0.25 + 0.2 * std::sin(2 * p.x + 3 * p.y - 2.5 * p.z + phase);
    };
    return {static_cast<float>(wave(0)), static_cast<float>(wave(1)), static_cast<float>(wave(2)), 0.75F};
}

std::vector<Window> patterned(const Factorisation& f) {
    std::vector<Window> windows;
    for (std::size_t n = 0; n < f.faces.size(); ++n) {
        const Face& face = f.faces[n];
        const bool perspective = f.projection == Projection::perspective;
        windows.push_back({static_cast<int>(n), {0, 0, face.width, face.height}, {face.width, face.height}});
        for (int j = 0; j < face.height; ++j) {
            for (int i = 0; i < face.width; ++i) {
                Vec3 origin(0), direction = f.direction;
                const double u = face.origin.x + i * face.pitch.x, v = face.origin.y + j * face.pitch.y;
                (perspective ? direction : origin)[face.axis] = perspective ? face.sign : 0;
                (perspective ? direction : origin)[face.u_axis()] = perspective ? u * face.sign : u;
                (perspective ? direction : origin)[face.v_axis()] = perspective ? v * face.sign : v;
                windows.back().pixels.at(i, j) = pattern(origin, direction, perspective);
            }
        }
    }
    return windows;
}

bool meets_cube(const Vec3& origin, const Vec3& direction, bool perspective) {
    double t0 = perspective ? 0 : -1e300, t1 = 1e300;
    for (int a = 0; a < 3; ++a) {
        const auto last = static_cast<double>(lattice.n[static_cast<std::size_t>(a)] - 1);
        const double p = -origin[a] / direction[a], q = (last - origin[a]) / direction[a];
        t0 = std::max(t0, std::min(p, q));
        t1 = std::min(t1, std::max(p, q));
    }
    return t0 < t1;
}

TEST(Warp, GivesEveryPixelItsRaysValueAndEndsAtTheCube) {
    base::Workers workers;
    const ImageSize size{160, 120};
    for (const auto projection : {Projection::perspective, Projection::parallel}) {
        for (const double distance : {0.0, 10.0, 60.0}) {
            const Camera camera =
                view::camera_on({40, 25, distance}, lattice, projection, distance == 10 ? 120 : 40);
            const Factorisation f = view::factorise(camera, size, lattice, {1});
            const auto picture = warp_float(f, patterned(f), camera, size, workers);
            const view::Rays rays = in_voxel_space(view::rays_of(camera, size), lattice);
            const bool perspective = projection == Projection::perspective;
            int inside = 0;
            for (int y = 0; y < size.height; ++y) {
                for (int x = 0; x < size.width; ++x) {
                    const Vec3 origin = rays.origin_at(x + 0.5, y + 0.5);
                    const Vec3 direction = rays.direction_at(x + 0.5, y + 0.5);
                    const bool meets = meets_cube(origin, direction, perspective);
                    const RgbaF expected = meets ? pattern(origin, direction, perspective) : RgbaF{};
                    ASSERT_NEAR(picture.at(x, y).r, expected.r, 0.01) << x << ", " << y << " at " << distance;
                    ASSERT_NEAR(picture.at(x, y).b, expected.b, 0.01) << x << ", " << y;
                    ASSERT_NEAR(picture.at(x, y).a, expected.a, 1e-4) << x << ", " << y;
                    inside += meets ? 1 : 0;
                }
            }
            EXPECT_GT(inside, 1000);
        }
    }
}

// Beside a bright edge a cubic filter rings: no negative light, no colour beyond opacity.
TEST(Warp, StaysWithinWhatAPixelCanBe) {
    base::Workers workers;
    const Camera camera = view::camera_on({33, 12}, lattice);
    const ImageSize size{100, 100};
    const Factorisation f = view::factorise(camera, size, lattice, {0.5});
    std::vector<Window> windows = patterned(f);
    for (Window& window : windows) {
        for (std::size_t i = 0; i < window.pixels.pixels().size(); ++i) {
            const bool lit = i * 2654435761U % 7 < 3;
            window.pixels.pixels()[i] = lit ? RgbaF{1, 0, 1, 1} : RgbaF{};
        }
    }
    const auto picture = warp_float(f, windows, camera, size, workers);
    for (const RgbaF& p : picture.pixels()) {
        ASSERT_TRUE(p.a >= 0 && p.a <= 1 && p.r >= 0 && p.r <= p.a && p.g >= 0 && p.g <= p.a && p.b >= 0 &&
                    p.b <= p.a);
    }
}

TEST(Warp, PutsThePictureOnItsBackground) {
    base::Workers workers;
    const Camera camera = view::camera_on({}, lattice);
    const ImageSize size{60, 40};
    const Factorisation f = view::factorise(camera, size, lattice, {1});
    const auto picture = warp(f, patterned(f), camera, size, {0.2, 0.4, 1}, workers);
    const auto floats = warp_float(f, patterned(f), camera, size, workers);
    EXPECT_EQ(picture.at(0, 0), (Rgba8{51, 102, 255, 255}));
    EXPECT_NEAR(picture.at(30, 20).r, 255 * (static_cast<double>(floats.at(30, 20).r) + 0.25 * 0.2), 0.51);
    const auto bare = warp(f, {}, camera, size, {0.2, 0.4, 1}, workers);
    EXPECT_EQ(bare.at(30, 20), (Rgba8{51, 102, 255, 255}));
}

// A part that has not come is transparent, and the rest is as it would be.
TEST(Warp, TakesWindowsSmallerThanTheFace) {
    base::Workers workers;
    const Camera camera = view::camera_on({}, lattice);
    const ImageSize size{100, 100};
    const Factorisation f = view::factorise(camera, size, lattice, {1});
    auto whole = patterned(f);
    ASSERT_EQ(whole.size(), 1U);
    const Rect half{0, 0, f.faces[0].width / 2, f.faces[0].height};
    std::vector<Window> part;
    part.push_back({0, half, {half.width(), half.height()}});
    for (int j = 0; j < half.height(); ++j) {
        std::copy_n(whole[0].pixels.row(j).begin(), half.width(), part[0].pixels.row(j).begin());
    }
    const auto a = warp_float(f, whole, camera, size, workers);
    const auto b = warp_float(f, part, camera, size, workers);
    int same = 0, dark = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        same += a.pixels()[i].a > 0 && a.pixels()[i].r == b.pixels()[i].r ? 1 : 0;
        dark += a.pixels()[i].a > 0 && b.pixels()[i].a == 0 ? 1 : 0;
    }
    EXPECT_GT(same, 500);
    EXPECT_GT(dark, 500);
}

// Windows whose bands are filled one by one, from what they hold in the end.
class BandByBand {
  public:
    BandByBand(const Camera& camera, const ImageSize& size, const Factorisation& f)
        : whole_(patterned(f)), bands_(view::bands_of(f)), seen_(size.width, size.height) {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        for (const Window& window : whole_) {
            windows_.push_back({window.face, window.rect, {window.rect.width(), window.rect.height()}});
            std::ranges::fill(windows_.back().pixels.pixels(), RgbaF{nan, nan, nan, nan});
        }
        warp_.emplace(f, windows_, bands_, camera, size, background);
    }
    void fill(std::size_t band) {
        put(band, whole_);
        for (const std::size_t stripe : warp_->advance(band + 1, workers_)) {
            const int begin = static_cast<int>(stripe) * Warp::stripe_rows;
            for (int y = begin; y < std::min(begin + Warp::stripe_rows, seen_.height()); ++y) {
                std::ranges::copy(warp_->picture().row(y), seen_.row(y).begin());
            }
            ++stripes_;
        }
    }
    // What is still resampled from it is seen.
    void spoil(std::size_t band) {
        const Rect& rect = bands_[band].rect;
        for (int j = rect.y0; j < rect.y1; ++j) {
            std::ranges::fill(part(windows_, band, j), RgbaF{0, 1, 0, 1});
        }
    }
    const std::vector<Window>& whole() const { return whole_; }
    std::size_t bands() const { return bands_.size(); }
    Image<Rgba8> take() { return warp_->take(); }
    // The picture, each stripe as it was when it was said to be whole, and how many were.
    const Image<Rgba8>& seen() const { return seen_; }
    int stripes() const { return stripes_; }

    static constexpr view::Rgb background{0.1, 0.2, 0.3};

  private:
    std::span<RgbaF> part(std::vector<Window>& windows, std::size_t band, int j) const {
        const Rect& rect = bands_[band].rect;
        return windows[static_cast<std::size_t>(bands_[band].face)].pixels.row(j).subspan(
            static_cast<std::size_t>(rect.x0), static_cast<std::size_t>(rect.width()));
    }
    void put(std::size_t band, std::vector<Window>& from) {
        for (int j = bands_[band].rect.y0; j < bands_[band].rect.y1; ++j) {
            std::ranges::copy(part(from, band, j), part(windows_, band, j).begin());
        }
    }

    base::Workers workers_;
    std::vector<Window> whole_, windows_;
    std::vector<view::Band> bands_;
    std::optional<Warp> warp_;
    Image<Rgba8> seen_;
    int stripes_ = 0;
};

// From all around, so that bands are rows, from top or bottom, or columns, of one face or of several.
TEST(Warp, IsTheSameBandByBand) {
    base::Workers workers;
    const ImageSize size{330, 290};
    for (const auto projection : {Projection::perspective, Projection::parallel}) {
        for (const double elevation : {-80.0, -20.0, 10.0, 85.0}) {
            for (const double distance : {10.0, 0.0}) {
                const Camera camera =
                    view::camera_on({40, elevation, distance}, lattice, projection, distance > 0 ? 100 : 40);
                const Factorisation f = view::factorise(camera, size, lattice, {1});
                BandByBand bands(camera, size, f);
                for (std::size_t band = 0; band < bands.bands(); ++band) {
                    bands.fill(band);
                }
                const auto at_once = warp(f, bands.whole(), camera, size, BandByBand::background, workers);
                const auto picture = bands.take();
                EXPECT_TRUE(std::ranges::equal(picture.pixels(), at_once.pixels()))
                    << "elevation " << elevation << ", distance " << distance;
                EXPECT_TRUE(std::ranges::equal(bands.seen().pixels(), at_once.pixels()));
                EXPECT_EQ(bands.stripes(), 3) << "of 290 rows";
            }
        }
    }
}

TEST(Warp, DoesNotWaitForBandsThatATileHasNothingOf) {
    base::Workers workers;
    const ImageSize size{600, 600};
    for (const double elevation : {10.0, 89.0}) {  // rows; columns
        const Camera camera = view::camera_on({0, elevation}, lattice);
        const Factorisation f = view::factorise(camera, size, lattice, {1});
        BandByBand bands(camera, size, f);
        ASSERT_GE(bands.bands(), 5U);
        const std::size_t half = bands.bands() / 2;
        for (std::size_t band = 0; band < bands.bands(); ++band) {
            bands.fill(band);
            if (band >= half) {
                bands.spoil(band - half);
            }
        }
        const auto picture = bands.take();
        const auto at_once = warp(f, bands.whole(), camera, size, BandByBand::background, workers);
        EXPECT_TRUE(std::ranges::equal(picture.pixels(), at_once.pixels())) << "elevation " << elevation;
    }
}

}  // namespace
}  // namespace shearwater::image
