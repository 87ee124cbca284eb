#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

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

// Two windows, 3 x 2 and 2 x 2 pixels, on the example's faces.
Message two_windows() {
    std::vector<image::Window> windows;
    windows.push_back(window(1, {0, 0, 3, 2}));
    windows.push_back(window(0, {3, 1, 5, 3}));
    return windows_message(17, image::encode(windows));
}

void expect_invalid(const Message& message, std::string_view what) {
    const auto parsed = windows_from(message, factorisation());
    ASSERT_FALSE(parsed) << what;
    EXPECT_EQ(parsed.error().reason, pb::REASON_INVALID);
    EXPECT_NE(parsed.error().text.find(what), std::string::npos) << parsed.error().text;
}

template <class Change>
Message changed(Change change) {
    Message message = two_windows();
    change(std::get<pb::Windows>(message.body));
    return message;
}

Message with_payload(base::Buffer bytes) {
    Message message = two_windows();
    message.payload = std::make_shared<const base::Buffer>(std::move(bytes));
    return message;
}

TEST(WindowsConversion, ThereAndBack) {
    const Message message = two_windows();
    EXPECT_EQ(std::get<pb::Windows>(message.body).frame(), 17U);
    // Four rows of one span each.
    EXPECT_EQ(message.payload_size(), (6 + 4) * 8U + 4 * (2 + 4));
    const auto windows = windows_from(message, factorisation()).value();
    ASSERT_EQ(windows.size(), 2U);
    EXPECT_EQ(windows[0].face, 1);
    EXPECT_EQ(windows[0].rect, (view::Rect{0, 0, 3, 2}));
    EXPECT_EQ(windows[1].face, 0);
    EXPECT_EQ(windows[1].rect, (view::Rect{3, 1, 5, 3}));
    for (const image::Window& had : image::merge_front_to_back(windows)) {
        const image::Window sent = window(had.face, had.rect);
        for (std::size_t i = 0; i < sent.pixels.pixels().size(); ++i) {
            EXPECT_NEAR(had.pixels.pixels()[i].a, sent.pixels.pixels()[i].a, 0.51 / 65535);
            EXPECT_NEAR(had.pixels.pixels()[i].r, sent.pixels.pixels()[i].r, 0.51 / 65535);
        }
    }
}

TEST(WindowsConversion, NothingToSee) {
    image::Window clear = window(0, {0, 0, 5, 4});
    std::ranges::fill(clear.pixels.pixels(), image::RgbaF{});
    const image::Window empty{.face = 0, .rect = {}, .pixels = {}};
    for (const Message& message : {windows_message(1, {}), windows_message(1, image::encode({&empty, 1})),
                                   windows_message(1, image::encode({&clear, 1}))}) {
        EXPECT_EQ(std::get<pb::Windows>(message.body).windows_size(), 0);
        EXPECT_EQ(message.payload, nullptr);
        EXPECT_TRUE(windows_from(message, factorisation()).value().empty());
    }
}

TEST(WindowsConversion, PayloadCutAtEveryByteOrTooLong) {
    const base::Buffer whole = *two_windows().payload;
    for (std::size_t cut = 0; cut < whole.size(); ++cut) {
        expect_invalid(with_payload({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)}),
                       "cut off");
    }
    EXPECT_TRUE(windows_from(with_payload(whole), factorisation()));
    for (std::size_t more = 1; more <= 9; ++more) {
        base::Buffer longer = whole;
        longer.resize(whole.size() + more, std::byte{});
        expect_invalid(with_payload(longer), "payload is longer");
    }
    Message none = windows_message(1, {});
    none.payload = std::make_shared<const base::Buffer>(8, std::byte{});
    expect_invalid(none, "payload is longer");
}

// The first window's first row is | 1 | x 0, length 3 | 3 pixels.
TEST(WindowsConversion, HostileSpans) {
    const base::Buffer whole = *two_windows().payload;
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
    EXPECT_FALSE(windows_from(with(0, 0), factorisation())) << "the pixels are not the next row";
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
        pb::Windows body;
        body.add_windows()->set_face(0);
        *body.mutable_windows(0)->mutable_rect() = to_wire(view::Rect{0, 1, 5, 2});
        return message(std::move(body), std::move(bytes));
    };
    EXPECT_TRUE(windows_from(row({}), factorisation()));
    EXPECT_TRUE(windows_from(row({{0, 5}}), factorisation()));
    EXPECT_TRUE(windows_from(row({{0, 2}, {3, 2}}), factorisation()));
    EXPECT_TRUE(windows_from(row({{0, 1}, {2, 1}, {4, 1}}), factorisation()));
    expect_invalid(row({{0, 2}, {2, 2}}), "its place in it");
    expect_invalid(row({{0, 3}, {2, 2}}), "its place in it");
    expect_invalid(row({{3, 2}, {0, 2}}), "its place in it");
    expect_invalid(row({{0, 2}, {3, 3}}), "its place in it");
}

TEST(WindowsConversion, HostileFaces) {
    for (const std::uint32_t face : {2U, 6U, 0xFFFFFFFFU}) {
        expect_invalid(changed([&](pb::Windows& w) { w.mutable_windows(0)->set_face(face); }),
                       "windows.face");
    }
    expect_invalid(changed([](pb::Windows& w) { w.mutable_windows(1)->set_face(1); }), "windows.face");
    expect_invalid(changed([](pb::Windows& w) { *w.add_windows() = w.windows(0); }), "windows.face");
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
        expect_invalid(changed(change), "windows.rect");
    }
    // Inside its face, and not that of its spans.
    const auto narrower = [](pb::Windows& w) { w.mutable_windows(0)->mutable_rect()->set_x1(2); };
    expect_invalid(changed(narrower), "leaves its row");
    const auto lower = [](pb::Windows& w) { w.mutable_windows(1)->mutable_rect()->set_y1(2); };
    expect_invalid(changed(lower), "payload is longer");
    const auto higher = [](pb::Windows& w) { w.mutable_windows(1)->mutable_rect()->set_y0(0); };
    expect_invalid(changed(higher), "cut off");
}

TEST(WindowsConversion, TheLargestFactorisationFitsTheLimit) {
    constexpr std::uint64_t rows =
        std::uint64_t{view::Factorisation::max_faces} * view::Factorisation::max_side;
    const std::uint64_t each = image::spans_bound({0, 0, 1, 1}) - sizeof(image::Rgba16);
    EXPECT_LE(static_cast<std::uint64_t>(view::Factorisation::max_area) * sizeof(image::Rgba16) + rows * each,
              limit_of(type_of(Body(pb::Windows())))->payload);
}

}  // namespace
}  // namespace shearwater::wire::test
