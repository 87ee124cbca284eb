// The warp's inner loop gives what its definition gives, on every set of instructions at hand.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/image/layer.h"
#include "common/image/resample.h"
#include "common/image/resample_span.h"
#include "tests/support/random_pixels.h"
#include "tests/support/simd_targets.h"

namespace shearwater::image {
namespace {

using support::for_each_target;
using support::random_pixel;

void expect_near(const RgbaF& p, const RgbaF& q, float tolerance, const std::string& what) {
    ASSERT_NEAR(p.r, q.r, tolerance) << what;
    ASSERT_NEAR(p.g, q.g, tolerance) << what;
    ASSERT_NEAR(p.b, q.b, tolerance) << what;
    ASSERT_NEAR(p.a, q.a, tolerance) << what;
}

// A face seen from in front of it, and a window of it with noise in an oval, transparent in its corners.
class ResampleSpan : public testing::Test {
  protected:
    ResampleSpan() : f_(view::factorise(view::camera_on({}, lattice_), {90, 70}, lattice_, {1})) {}

    Window window(const Rect& rect) const {
        std::mt19937 random(3);
        Window window{.face = 0, .rect = rect, .pixels = {rect.width(), rect.height()}};
        for (int y = 0; y < rect.height(); ++y) {
            for (int x = 0; x < rect.width(); ++x) {
                const double right = 2.0 * x / rect.width() - 1, down = 2.0 * y / rect.height() - 1;
                window.pixels.at(x, y) = std::hypot(right, down) < 1 ? random_pixel(random) : RgbaF{};
            }
        }
        return window;
    }

    // A row's numbers that resample_span leaves to resample.
    std::size_t compare(const Layer& layer, const Track& track, int x0, std::size_t width,
                        std::size_t offset) {
        std::vector<RgbaF> row(offset + width);
        std::vector<int> left(width);
        const auto out = std::span(row).subspan(offset);
        const std::size_t count = resample_span(layer, track, x0, out, left);
        std::vector<bool> is_left(width);
        for (const int n : std::span(left).first(count)) {
            is_left[static_cast<std::size_t>(n)] = true;
        }
        for (std::size_t n = 0; n < width; ++n) {
            const Place place = track.at(x0 + static_cast<double>(n) + 0.5);
            expect_near(out[n], is_left[n] ? RgbaF{} : resample(layer, place), 2e-6F,
                        std::to_string(place.i) + ", " + std::to_string(place.j));
        }
        return count;
    }

    base::Workers workers_{1};
    view::Lattice lattice_{{50, 40, 60}, {1, 1.2, 0.8}};
    view::Factorisation f_;
};

TEST_F(ResampleSpan, GivesWhatResampleGives) {
    const view::Face& face = f_.faces.at(0);
    const int w = face.width, h = face.height;
    for_each_target([&] {
        std::mt19937 random(4);
        std::uniform_real_distribution<double> unit(0, 1);
        std::size_t points = 0, left = 0;
        for (const Rect& rect : {Rect{0, 0, w, h}, Rect{w / 4, h / 3, w - 5, h - 9}, Rect{20, 20, 23, 22}}) {
            const Window noise = window(rect);
            const Layer layer(f_, noise, workers_);
            for (int round = 0; round < 200; ++round) {
                // From one point about the face to another, or far outside, with or without perspective.
                const std::size_t width = 1 + random() % 150;
                const double reach = round % 10 == 0 ? 1e7 : 1, steps = static_cast<double>(width);
                const Place from{(1.4 * unit(random) - 0.2) * w, (1.4 * unit(random) - 0.2) * h};
                const Place to{(1.4 * unit(random) - 0.2) * w * reach, (1.4 * unit(random) - 0.2) * h};
                const double far = round % 2 == 0 ? 1 : 0.5 + unit(random);
                const int x0 = static_cast<int>(random() % 50);
                Track track{.i_x = (to.i * far - from.i) / steps,
                            .j_x = (to.j * far - from.j) / steps,
                            .w_x = (far - 1) / steps};
                track.i = from.i - x0 * track.i_x;
                track.j = from.j - x0 * track.j_x;
                track.w = 1 - x0 * track.w_x;
                left += compare(layer, track, x0, width, random() % 4);
                points += width;
                if (HasFatalFailure()) {
                    return;
                }
            }
        }
        EXPECT_LT(left, points / 4) << "most is for the kernel";
    });
}

// What resample_span may do by itself, and what it may leave out.
TEST_F(ResampleSpan, CellsAreSortedByWhatTheyNeed) {
    const view::Face& face = f_.faces.at(0);
    const Rect rect{3, 5, face.width - 11, face.height - 4};
    const Window noise = window(rect);
    const Layer layer(f_, noise, workers_);
    const auto pixel = [&](int i, int j) {
        const bool has = rect.x0 <= i && i < rect.x1 && rect.y0 <= j && j < rect.y1;
        return has ? noise.pixels.at(i - rect.x0, j - rect.y0) : RgbaF{};
    };
    int whole = 0;
    for (int j = -1; j < face.height; ++j) {
        for (int i = -1; i < face.width; ++i) {
            bool lit = false, inside = true;
            for (int n = 0; n < 16; ++n) {
                const int x = i - 1 + n % 4, y = j - 1 + n / 4;
                lit = lit || pixel(x, y).a > 0;
                inside = inside && rect.x0 <= x && x < rect.x1 && rect.y0 <= y && y < rect.y1 &&
                         layer.silhouette().pixel_row(y).contains(x);
            }
            const CellRow& row = layer.cell_row(j);
            ASSERT_TRUE(row.lit.contains(i) || !lit) << i << ", " << j;
            ASSERT_TRUE(inside || !row.whole.contains(i)) << i << ", " << j;
            ASSERT_TRUE(row.whole.contains(i) || !inside || !lit) << i << ", " << j;
            whole += row.whole.contains(i) ? 1 : 0;
        }
    }
    EXPECT_GT(whole, 1000);
}

TEST_F(ResampleSpan, TheOutlineIsTheSameByTheShortWay) {
    const view::Face& face = f_.faces.at(0);
    const Silhouette silhouette(f_, face);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    int inside = 0;
    for (int round = 0; round < 200000; ++round) {
        double i = -1 + unit(random) * (face.width + 1);
        const double j = -1 + unit(random) * (face.height + 1);
        const Stretch row = silhouette.row(j);
        if (round % 2 == 0 && row.lo < row.hi) {
            i = (round % 4 == 0 ? row.lo : row.hi) + 0.02 * (unit(random) - 0.5);
        }
        ASSERT_EQ(silhouette.contains(i, j), row.contains(i)) << i << ", " << j;
        inside += row.contains(i) ? 1 : 0;
    }
    EXPECT_GT(inside, 50000);
    EXPECT_LT(inside, 150000);
}

}  // namespace
}  // namespace shearwater::image
