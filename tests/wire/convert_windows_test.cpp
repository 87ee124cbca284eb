#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "common/image/over_windows.h"

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

image::Window window(int face, const view::Rect& rect) {
    image::Window w{
        .face = face, .rect = rect, .pixels = image::Image<image::RgbaF>(rect.width(), rect.height())};
    float value = 0;
    for (image::RgbaF& pixel : w.pixels.pixels()) {
        value += 1.0F / 64;
        pixel = {value / 2, value / 4, value / 8, value};
    }
    return w;
}

// Of the example's faces the first in two bands, the second in one.
const std::vector<view::Band> bands{{0, {0, 0, 5, 2}}, {0, {0, 2, 5, 4}}, {1, {0, 0, 3, 2}}};

// The window of the last of them, of 3 x 2 pixels.
Message last_band() {
    const image::Window all = window(1, {0, 0, 3, 2});
    return windows_message(17, 3, image::encode({&all, 1}));
}

void expect_invalid(const Message& message, std::string_view what, std::size_t known = 1) {
    const auto parsed = windows_from(message, bands, known);
    ASSERT_FALSE(parsed) << what;
    EXPECT_EQ(parsed.error().reason, pb::REASON_INVALID);
    EXPECT_NE(parsed.error().text.find(what), std::string::npos) << parsed.error().text;
}

template <class Change>
Message changed(Change change) {
    Message message = last_band();
    change(std::get<pb::Windows>(message.body));
    return message;
}

Message with_payload(base::Buffer bytes) {
    Message message = last_band();
    message.payload = std::make_shared<const base::Buffer>(std::move(bytes));
    return message;
}

TEST(WindowsConversion, ThereAndBack) {
    const Message message = last_band();
    EXPECT_EQ(std::get<pb::Windows>(message.body).frame(), 17U);
    // Two rows of one span each.
    EXPECT_EQ(message.payload_size(), 6 * 8U + 2 * (2 + 4));
    for (std::size_t known = 0; known < 3; ++known) {
        const BandWindow got = windows_from(message, bands, known).value();
        EXPECT_EQ(got.bands, 3U);
        EXPECT_EQ(got.window.face, 1);
        EXPECT_EQ(got.window.rect, (view::Rect{0, 0, 3, 2}));
        const auto merged = image::merge_front_to_back({&got.window, 1});
        const image::Window had = window(1, {0, 0, 3, 2});
        for (std::size_t i = 0; i < had.pixels.pixels().size(); ++i) {
            EXPECT_NEAR(merged.at(0).pixels.pixels()[i].g, had.pixels.pixels()[i].g, 0.51 / 65535);
        }
    }
}

TEST(WindowsConversion, PassedOnAsItCame) {
    const Message message = last_band();
    const BandWindow got = windows_from(message, bands, 0).value();
    const Message again = windows_message(17, got, message.payload);
    EXPECT_EQ(again.payload, message.payload) << "not a copy";
    EXPECT_EQ(std::get<pb::Windows>(again.body).SerializeAsString(),
              std::get<pb::Windows>(message.body).SerializeAsString());
}

TEST(WindowsConversion, NothingToSee) {
    image::Window clear = window(0, {0, 0, 5, 2});
    std::ranges::fill(clear.pixels.pixels(), image::RgbaF{});
    const image::Window empty{.face = 0, .rect = {}, .pixels = {}};
    for (const Message& message :
         {windows_message(1, 1, {}), windows_message(1, 1, image::encode({&empty, 1})),
          windows_message(1, 1, image::encode({&clear, 1}))}) {
        EXPECT_EQ(std::get<pb::Windows>(message.body).windows_size(), 0);
        EXPECT_EQ(message.payload, nullptr);
        EXPECT_TRUE(windows_from(message, bands, 0).value().window.rect.empty());
    }
}

// In order, each once, and no more than there are.
TEST(WindowsConversion, HostileBands) {
    for (std::size_t known = 0; known <= 3; ++known) {
        for (std::size_t said = 0; said <= 5; ++said) {
            const auto got = windows_from(windows_message(1, said, {}), bands, known);
            EXPECT_EQ(got.has_value(), known < said && said <= 3) << said << " after " << known;
        }
    }
    expect_invalid(changed([](pb::Windows& w) { w.set_bands(0xFFFFFFFFU); }),
                   "windows.bands: 4294967295 of 3");
    // A frame without bands is answered all the same.
    EXPECT_TRUE(windows_from(windows_message(1, 0, {}), {}, 0));
    EXPECT_FALSE(windows_from(windows_message(1, 1, {}), {}, 0));
    EXPECT_FALSE(windows_from(last_band(), {}, 0));
    Message of_none = last_band();
    std::get<pb::Windows>(of_none.body).set_bands(0);
    EXPECT_FALSE(windows_from(of_none, {}, 0));
}

TEST(WindowsConversion, TheAccountComesWithTheLastBand) {
    const auto with_cost = [](std::size_t known) {
        Message message = windows_message(1, known, {});
        std::get<pb::Windows>(message.body).mutable_stats()->set_samples(1);
        return message;
    };
    const auto lacking = [](std::size_t known) {
        Message message = windows_message(1, known, {});
        std::get<pb::Windows>(message.body).add_missing();
        return message;
    };
    expect_invalid(with_cost(2), "before its last band");
    expect_invalid(lacking(2), "before its last band");
    EXPECT_TRUE(windows_from(with_cost(3), bands, 1));
    EXPECT_TRUE(windows_from(lacking(3), bands, 1));
}

TEST(WindowsConversion, PayloadCutAtEveryByteOrTooLong) {
    const base::Buffer whole = *last_band().payload;
    for (std::size_t cut = 0; cut < whole.size(); ++cut) {
        expect_invalid(with_payload({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)}),
                       "cut off");
    }
    EXPECT_TRUE(windows_from(with_payload(whole), bands, 0));
    for (std::size_t more = 1; more <= 9; ++more) {
        base::Buffer longer = whole;
        longer.resize(whole.size() + more, std::byte{});
        expect_invalid(with_payload(longer), "payload is longer");
    }
    Message none = windows_message(1, 3, {});
    none.payload = std::make_shared<const base::Buffer>(8, std::byte{});
    expect_invalid(none, "payload is longer");
}

// The first row is | 1 | x 0, length 3 | 3 pixels.
TEST(WindowsConversion, HostileSpans) {
    const base::Buffer whole = *last_band().payload;
    const auto with = [&](std::size_t at, unsigned value) {
        base::Buffer bytes = whole;
        bytes[at] = static_cast<std::byte>(value & 0xFFU);
        bytes[at + 1] = static_cast<std::byte>(value >> 8);
        return with_payload(std::move(bytes));
    };
    for (const unsigned x : {1U, 3U, 0x8000U, 0xFFFFU}) {
        expect_invalid(with(2, x), "leaves its row");
    }
    for (const unsigned length : {0U, 4U, 0x8000U, 0xFFFFU}) {
        expect_invalid(with(4, length), "leaves its row");
    }
    for (const unsigned spans : {2U, 0xFFFFU}) {
        expect_invalid(with(0, spans), "leaves its row");
    }
    EXPECT_FALSE(windows_from(with(0, 0), bands, 0)) << "the pixels are not the next row";
}

// Two spans of a row of five: apart, touching, overlapping, and out of order.
TEST(WindowsConversion, SpansOfARowRiseWithGaps) {
    const auto row = [](std::initializer_list<std::pair<int, int>> spans) {
        base::Buffer bytes;
        const auto put = [&](std::size_t value) {
            bytes.push_back(static_cast<std::byte>(value & 0xFFU));
            bytes.push_back(static_cast<std::byte>(value >> 8));
        };
        put(spans.size());
        for (const auto& [x, length] : spans) {
            put(static_cast<std::size_t>(x));
            put(static_cast<std::size_t>(length));
            bytes.resize(bytes.size() + static_cast<std::size_t>(length) * sizeof(image::Rgba16));
        }
        const BandWindow band{.bands = 1, .window = {.face = 0, .rect = {0, 1, 5, 2}, .bytes = {}}};
        return windows_message(1, band, std::make_shared<const base::Buffer>(std::move(bytes)));
    };
    EXPECT_TRUE(windows_from(row({}), bands, 0));
    EXPECT_TRUE(windows_from(row({{0, 5}}), bands, 0));
    EXPECT_TRUE(windows_from(row({{0, 2}, {3, 2}}), bands, 0));
    EXPECT_TRUE(windows_from(row({{0, 1}, {2, 1}, {4, 1}}), bands, 0));
    expect_invalid(row({{0, 2}, {2, 2}}), "its place in it", 0);
    expect_invalid(row({{0, 3}, {2, 2}}), "its place in it", 0);
    expect_invalid(row({{3, 2}, {0, 2}}), "its place in it", 0);
    expect_invalid(row({{0, 2}, {3, 3}}), "its place in it", 0);
}

TEST(WindowsConversion, HostileFaces) {
    for (const std::uint32_t face : {0U, 2U, 6U, 0xFFFFFFFFU}) {
        expect_invalid(changed([&](pb::Windows& w) { w.mutable_windows(0)->set_face(face); }),
                       "leaves its band");
    }
    expect_invalid(changed([](pb::Windows& w) { *w.add_windows() = w.windows(0); }), "more than one");
    // Another face's window, sound in itself, with the band before.
    expect_invalid(changed([](pb::Windows& w) { w.set_bands(2); }), "leaves its band");
}

TEST(WindowsConversion, HostileRectangles) {
    constexpr auto lowest = std::numeric_limits<std::int32_t>::min();
    constexpr auto highest = std::numeric_limits<std::int32_t>::max();
    const std::vector<view::Rect> rects{{-1, 0, 2, 2},
                                        {0, -1, 3, 1},
                                        {0, 0, 4, 2},
                                        {0, 0, 3, 3},
                                        {0, 0, 0, 0},
                                        {2, 0, 1, 2},
                                        {0, 2, 3, 1},
                                        {lowest, lowest, highest, highest},
                                        {highest, 0, lowest, 2},
                                        {lowest, 0, lowest, 2}};
    for (const view::Rect& rect : rects) {
        const auto change = [&](pb::Windows& w) { *w.mutable_windows(0)->mutable_rect() = to_wire(rect); };
        expect_invalid(changed(change), "leaves its band");
    }
    // Inside its band, and not that of its spans.
    const auto narrower = [](pb::Windows& w) { w.mutable_windows(0)->mutable_rect()->set_x1(2); };
    expect_invalid(changed(narrower), "leaves its row");
    const auto lower = [](pb::Windows& w) { w.mutable_windows(0)->mutable_rect()->set_y1(1); };
    expect_invalid(changed(lower), "payload is longer");
}

// Inside its face, but a line over the edge of the band.
TEST(WindowsConversion, AWindowKeepsToItsBand) {
    const auto in_band = [](std::size_t band, const view::Rect& rect) {
        const image::Window pixels = window(0, rect);
        return windows_message(1, band + 1, image::encode({&pixels, 1}));
    };
    EXPECT_TRUE(windows_from(in_band(0, {0, 0, 5, 2}), bands, 0));
    EXPECT_TRUE(windows_from(in_band(1, {0, 2, 5, 4}), bands, 0));
    expect_invalid(in_band(0, {0, 1, 5, 3}), "leaves its band", 0);
    expect_invalid(in_band(0, {0, 2, 5, 4}), "leaves its band", 0);
    expect_invalid(in_band(1, {0, 1, 5, 3}), "leaves its band", 0);
}

TEST(WindowsConversion, TheLargestFactorisationFitsTheLimit) {
    // As one band.
    constexpr std::uint64_t rows = view::Factorisation::max_side;
    const std::uint64_t each = image::spans_bound({0, 0, 1, 1}) - sizeof(image::Rgba16);
    EXPECT_LE(static_cast<std::uint64_t>(view::Factorisation::max_area) * sizeof(image::Rgba16) + rows * each,
              limit_of(type_of(Body(pb::Windows())))->payload);
}

}  // namespace
}  // namespace shearwater::wire::test
