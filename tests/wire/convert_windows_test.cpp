#include <gtest/gtest.h>

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
    return windows_message(17, windows);
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

Message with_payload(std::size_t size) {
    Message message = two_windows();
    message.payload = std::make_shared<const std::vector<std::byte>>(size);
    return message;
}

TEST(WindowsConversion, ThereAndBack) {
    const Message message = two_windows();
    EXPECT_EQ(std::get<pb::Windows>(message.body).frame(), 17U);
    EXPECT_EQ(message.payload_size(), (6 + 4) * 8U);
    const auto windows = windows_from(message, factorisation()).value();
    ASSERT_EQ(windows.size(), 2U);
    EXPECT_EQ(windows[0].face, 1);
    EXPECT_EQ(windows[0].rect, (view::Rect{0, 0, 3, 2}));
    EXPECT_EQ(windows[1].face, 0);
    EXPECT_EQ(windows[1].rect, (view::Rect{3, 1, 5, 3}));
    ASSERT_EQ(windows[0].pixels.size(), 6U);
    ASSERT_EQ(windows[1].pixels.size(), 4U);
    for (const auto& view : windows) {
        const image::Window sent = window(view.face, view.rect);
        for (std::size_t i = 0; i < view.pixels.size(); ++i) {
            EXPECT_NEAR(view.pixels[i].a / 65535.0, sent.pixels.pixels()[i].a, 0.51 / 65535);
            EXPECT_NEAR(view.pixels[i].r / 65535.0, sent.pixels.pixels()[i].r, 0.51 / 65535);
        }
    }
}

TEST(WindowsConversion, NothingToSee) {
    for (const Message& message : {windows_message(1, {}), [] {
                                       const image::Window empty{.face = 0, .rect = {}, .pixels = {}};
                                       return windows_message(1, {&empty, 1});
                                   }()}) {
        EXPECT_EQ(message.payload, nullptr);
        EXPECT_TRUE(windows_from(message, factorisation()).value().empty());
    }
}

TEST(WindowsConversion, PayloadCutAtEveryByteOrTooLong) {
    const std::size_t size = two_windows().payload_size();
    for (std::size_t cut = 0; cut < size; ++cut) {
        expect_invalid(with_payload(cut), "payload is shorter");
    }
    EXPECT_TRUE(windows_from(with_payload(size), factorisation()));
    for (std::size_t more = 1; more <= 9; ++more) {
        expect_invalid(with_payload(size + more), "payload is longer");
    }
    Message none = windows_message(1, {});
    none.payload = std::make_shared<const std::vector<std::byte>>(8);
    expect_invalid(none, "payload is longer");
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
    // Inside its face, and of another area than its pixels.
    const auto smaller = [](pb::Windows& w) { w.mutable_windows(0)->mutable_rect()->set_x1(2); };
    expect_invalid(changed(smaller), "payload is longer");
    const auto larger = [](pb::Windows& w) { w.mutable_windows(1)->mutable_rect()->set_x0(1); };
    expect_invalid(changed(larger), "payload is shorter");
}

TEST(WindowsConversion, TheLargestFactorisationFitsTheLimit) {
    EXPECT_EQ(static_cast<std::uint64_t>(view::Factorisation::max_area) * sizeof(image::Rgba16),
              limit_of(type_of(Body(pb::Windows())))->payload);
}

}  // namespace
}  // namespace shearwater::wire::test
