#include "common/image/over_windows.h"

#include <gtest/gtest.h>

#include <random>

#include "common/image/canvas.h"
#include "common/image/over.h"
#include "tests/support/random_pixels.h"

namespace shearwater::image {
namespace {

using support::expect_near;
using support::random_pixel;

Window window_of(int face, const Rect& rect, const RgbaF& pixel) {
    Window window{.face = face, .rect = rect, .pixels = Image<RgbaF>(rect.width(), rect.height())};
    std::fill(window.pixels.pixels().begin(), window.pixels.pixels().end(), pixel);
    return window;
}

// Of stretches and gaps of all lengths up to `longest`, at places that have nothing to do with blocks.
Window patchy(std::mt19937& random, int face, const Rect& rect, unsigned longest) {
    Window window{.face = face, .rect = rect, .pixels = Image<RgbaF>(rect.width(), rect.height())};
    const auto pixels = window.pixels.pixels();
    bool seen = random() % 2 == 0;
    for (std::size_t i = 0; i < pixels.size(); seen = !seen) {
        for (std::size_t end = std::min(pixels.size(), i + 1 + random() % longest); i < end; ++i) {
            pixels[i] = seen ? random_pixel(random) : RgbaF{};
        }
    }
    return window;
}

// The pixels of a face, as they travel: 0 where no window has any.
std::vector<Rgba16> travelled(std::span<const Window> windows, int face, const Rect& rect) {
    std::vector<Rgba16> pixels(static_cast<std::size_t>(rect.area()));
    for (const Window& window : windows) {
        for (int y = window.rect.y0; window.face == face && y < window.rect.y1; ++y) {
            const auto row = std::span(pixels).subspan(
                static_cast<std::size_t>((y - rect.y0) * rect.width() + window.rect.x0 - rect.x0),
                static_cast<std::size_t>(window.rect.width()));
            to_16_bits(window.pixels.row(y - window.rect.y0), row);
        }
    }
    return pixels;
}

TEST(Merge, PutsEachWindowWhereItBelongs) {
    const RgbaF red{0.5F, 0, 0, 0.5F}, green{0, 0.5F, 0, 0.5F};
    std::vector<Window> windows;
    windows.push_back(window_of(1, {2, 3, 5, 6}, red));
    windows.push_back(window_of(0, {-4, 0, -1, 2}, green));
    windows.push_back(window_of(1, {4, 4, 9, 5}, green));
    windows.push_back(window_of(1, {0, 0, 0, 0}, red));
    const auto merged = merge_front_to_back(windows);
    ASSERT_EQ(merged.size(), 2U);
    EXPECT_EQ(merged[0].face, 1);
    EXPECT_EQ(merged[0].rect, (Rect{2, 3, 9, 6}));
    expect_near(merged[0].pixels.at(0, 0), red, 0);
    expect_near(merged[0].pixels.at(2, 1), {0.5F, 0.25F, 0, 0.75F}, 1e-7F);  // red over green
    expect_near(merged[0].pixels.at(6, 1), green, 0);
    expect_near(merged[0].pixels.at(6, 0), {}, 0);
    EXPECT_EQ(merged[1].face, 0);
    EXPECT_EQ(merged[1].rect, (Rect{-4, 0, -1, 2}));
}

TEST(Merge, OfTravelledWindowsIsTheSame) {
    std::mt19937 random(4);
    std::vector<Window> windows;
    std::vector<CodedWindows> coded;
    std::vector<SpanWindow> views;
    for (int n = 0; n < 9; ++n) {
        const int x = static_cast<int>(random() % 20), y = static_cast<int>(random() % 20);
        windows.push_back(window_of(n % 2, {x, y, x + 1 + n, y + 10 - n}, random_pixel(random)));
        coded.push_back(encode({&windows.back(), 1}));
        views.push_back(coded.back().windows.at(0));
    }
    const auto a = merge_front_to_back(windows);
    const auto b = merge_front_to_back(views);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t w = 0; w < a.size(); ++w) {
        ASSERT_EQ(a[w].rect, b[w].rect);
        for (std::size_t i = 0; i < a[w].pixels.pixels().size(); ++i) {
            expect_near(a[w].pixels.pixels()[i], b[w].pixels.pixels()[i], 9.0F / 65535);
        }
    }
    EXPECT_TRUE(merge_front_to_back(std::span<const Window>{}).empty());
}

TEST(Spans, HoldEveryPixelThatIsNotTransparent) {
    std::mt19937 random(5);
    for (int n = 0; n < 300; ++n) {
        const int x = static_cast<int>(random() % 20), y = static_cast<int>(random() % 20);
        const Rect rect{x, y, x + 1 + static_cast<int>(random() % 90),
                        y + 1 + static_cast<int>(random() % 9)};
        std::vector<Window> windows;
        windows.push_back(patchy(random, 2, rect, 1 + static_cast<unsigned>(n)));
        const CodedWindows coded = encode(windows);
        EXPECT_LE(coded.bytes.size(), spans_bound(rect));
        const auto decoded = merge_front_to_back(coded.windows);
        EXPECT_EQ(travelled(decoded, 2, rect), travelled(windows, 2, rect));
        for (const SpanWindow& window : coded.windows) {
            EXPECT_EQ(check_spans(window.bytes, window.rect).value(), window.bytes.size());
        }
    }
}

TEST(Spans, OfNothingAreNoBytes) {
    for (const Rect& rect : {Rect{}, Rect{3, 4, 5, 6}, Rect{0, 0, 100, 100}}) {
        // Below half a level a pixel is as good as none.
        const Window clear = window_of(0, rect, {0.4F / 65535, 0, 0, 0.49F / 65535});
        const CodedWindows coded = encode({&clear, 1});
        EXPECT_TRUE(coded.windows.empty());
        EXPECT_TRUE(coded.bytes.empty());
    }
}

TEST(Spans, TakeTheSmallestRectangle) {
    Window window = window_of(0, {10, 20, 110, 120}, {});
    window.pixels.at(33, 44) = {0, 0, 0, 1};
    window.pixels.at(71, 46) = {1.0F / 65535, 0, 0, 0};  // colour alone counts as well
    const CodedWindows coded = encode({&window, 1});
    ASSERT_EQ(coded.windows.size(), 1U);
    EXPECT_EQ(coded.windows[0].rect, (Rect{43, 64, 82, 67}));
    EXPECT_EQ(coded.bytes.size(), 3 * 2 + 2 * (4 + 8U));
}

// What a junction sends up is what it would send had it merged pixels of its own.
TEST(Spans, MergedAsTheyComeAreThoseOfTheMergedPixels) {
    std::mt19937 random(6);
    for (int n = 0; n < 300; ++n) {
        std::vector<CodedWindows> coded;
        std::vector<SpanWindow> arrived;
        for (unsigned layers = 1 + random() % 5; layers > 0; --layers) {
            const int x = static_cast<int>(random() % 40), y = static_cast<int>(random() % 6);
            const Window window = patchy(
                random, static_cast<int>(random() % 2),
                {x, y, x + 1 + static_cast<int>(random() % 60), y + 1 + static_cast<int>(random() % 6)},
                1 + static_cast<unsigned>(random() % 30));
            coded.push_back(encode({&window, 1}));
            arrived.insert(arrived.end(), coded.back().windows.begin(), coded.back().windows.end());
        }
        const CodedWindows merged = merge_coded(arrived);
        const auto pixels = merge_front_to_back(arrived);
        const auto again = merge_front_to_back(merged.windows);
        ASSERT_EQ(merged.windows.size(), pixels.size());
        for (std::size_t w = 0; w < pixels.size(); ++w) {
            const Rect& rect = pixels[w].rect;
            EXPECT_EQ(merged.windows[w].face, pixels[w].face);
            EXPECT_EQ(merged.windows[w].rect, rect);
            EXPECT_EQ(check_spans(merged.windows[w].bytes, rect).value(), merged.windows[w].bytes.size());
            EXPECT_EQ(travelled(again, pixels[w].face, rect), travelled(pixels, pixels[w].face, rect));
        }
    }
}

TEST(Spans, OfAWindowAloneArePassedOnUntouched) {
    std::mt19937 random(7);
    const Window window = patchy(random, 3, {5, 6, 90, 40}, 40);
    const CodedWindows coded = encode({&window, 1});
    EXPECT_EQ(merge_coded(coded.windows).bytes, coded.bytes);
}

TEST(Spans, CutAtEveryByteAreRefused) {
    std::mt19937 random(8);
    const Window window = patchy(random, 0, {5, 6, 40, 10}, 12);
    const CodedWindows coded = encode({&window, 1});
    const SpanWindow& whole = coded.windows.at(0);
    EXPECT_TRUE(check_spans(whole.bytes, whole.rect));
    for (std::size_t cut = 0; cut < whole.bytes.size(); ++cut) {
        // Of the exact size, so that a byte read beyond it is seen.
        const std::vector<std::byte> bytes(whole.bytes.begin(),
                                           whole.bytes.begin() + static_cast<std::ptrdiff_t>(cut));
        EXPECT_FALSE(check_spans(bytes, whole.rect)) << cut;
    }
}

view::Factorisation two_faces() {
    view::Factorisation f;
    f.faces = {{.axis = 2, .width = 700, .height = 300}, {.axis = 1, .width = 400, .height = 200}};
    return f;
}

// Band by band, in any order, over whatever was in the memory: the same as all at once.
TEST(Canvas, HasEachBandInItsPlace) {
    std::mt19937 random(9);
    const view::Factorisation f = two_faces();
    std::vector<view::Band> bands = view::bands_of(f);
    ASSERT_GE(bands.size(), 6U);
    std::ranges::shuffle(bands, random);
    Canvas canvas;
    for (int turn = 0; turn < 2; ++turn) {
        canvas.begin(f);
        std::vector<CodedWindows> coded;
        for (const view::Band& band : bands) {
            const Rect& rect = band.rect;
            std::vector<SpanWindow> of_band;
            for (unsigned layers = random() % 4; layers > 0; --layers) {
                const Rect part{
                    rect.x0 + static_cast<int>(random() % 30), rect.y0 + static_cast<int>(random() % 9),
                    rect.x1 - static_cast<int>(random() % 30), rect.y1 - static_cast<int>(random() % 9)};
                const Window window = patchy(random, band.face, part, 200);
                coded.push_back(encode({&window, 1}));
                of_band.push_back(coded.back().windows.at(0));
            }
            canvas.lay(band, of_band);
            const auto merged = merge_front_to_back(of_band);
            const Window& whole = canvas.windows()[static_cast<std::size_t>(band.face)];
            for (int y = rect.y0; y < rect.y1; ++y) {
                for (int x = rect.x0; x < rect.x1; ++x) {
                    const bool covered = !merged.empty() && merged[0].rect.x0 <= x && x < merged[0].rect.x1 &&
                                         merged[0].rect.y0 <= y && y < merged[0].rect.y1;
                    const RgbaF wanted =
                        covered ? merged[0].pixels.at(x - merged[0].rect.x0, y - merged[0].rect.y0) : RgbaF{};
                    expect_near(whole.pixels.at(x, y), wanted, 0);
                }
            }
        }
    }
}

}  // namespace
}  // namespace shearwater::image
