// Windows: a head in the body, spans in the payload.

#include <bit>
#include <utility>

#include "common/base/check.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

view::Rect rect_from(const pb::Rect& rect) {
    return {.x0 = rect.x0(), .y0 = rect.y0(), .x1 = rect.x1(), .y1 = rect.y1()};
}

// The only window of a message, in the band that it is for.
Parsed<image::SpanWindow> window_from(const pb::WindowHead& head, const view::Band& band,
                                      std::span<const std::byte> bytes) {
    const view::Rect rect = rect_from(head.rect());
    if (std::cmp_not_equal(head.face(), band.face) || rect.empty() ||
        view::intersection(rect, band.rect) != rect) {
        return invalid("windows.rect: it is empty or leaves its band");
    }
    const auto size = image::check_spans(bytes, rect);
    if (!size) {
        return invalid("windows: " + size.error().detail);
    }
    return image::SpanWindow{.face = band.face, .rect = rect, .bytes = bytes.first(*size)};
}

}  // namespace

pb::Rect to_wire(const view::Rect& rect) {
    pb::Rect to;
    to.set_x0(rect.x0);
    to.set_y0(rect.y0);
    to.set_x1(rect.x1);
    to.set_y1(rect.y1);
    return to;
}

Message windows_message(std::uint64_t frame, std::size_t bands, image::CodedWindows windows) {
    base::check(windows.windows.size() <= 1, "a band has one window");
    if (windows.windows.empty()) {
        return windows_message(frame, BandWindow{.bands = bands, .window = {}}, nullptr);
    }
    const BandWindow band{.bands = bands, .window = windows.windows.front()};
    return windows_message(frame, band, std::make_shared<const base::Buffer>(std::move(windows.bytes)));
}

Message windows_message(std::uint64_t frame, const BandWindow& band, Payload payload) {
    pb::Windows body;
    body.set_frame(frame);
    body.set_bands(static_cast<std::uint32_t>(band.bands));
    if (!band.window.rect.empty()) {
        pb::WindowHead& head = *body.add_windows();
        head.set_face(static_cast<std::uint32_t>(band.window.face));
        *head.mutable_rect() = to_wire(band.window.rect);
    }
    return {std::move(body), std::move(payload)};
}

Parsed<BandWindow> windows_from(const Message& message, std::span<const view::Band> all, std::size_t known) {
    const auto* body = std::get_if<pb::Windows>(&message.body);
    base::check(body != nullptr, "windows are taken from a Windows message");
    std::span<const std::byte> payload;
    if (message.payload) {
        payload = *message.payload;
    }
    base::check(std::bit_cast<std::uintptr_t>(payload.data()) % alignof(image::Rgba16) == 0,
                "a payload is aligned for pixels");
    BandWindow got{.bands = body->bands(), .window = {}};
    // A frame without faces has no bands, and is known with the first message.
    if (got.bands > all.size() || (got.bands <= known && !all.empty())) {
        return invalid("windows.bands: " + std::to_string(got.bands) + " of " + std::to_string(all.size()) +
                       " where " + std::to_string(known) + " were known");
    }
    if (got.bands < all.size() && (body->missing_size() > 0 || body->has_stats())) {
        return invalid("windows: what a frame lacks or cost is said before its last band");
    }
    if (body->windows_size() > 0) {
        if (body->windows_size() > 1 || got.bands == 0) {
            return invalid("windows: more than one, or one of no band");
        }
        const auto window = window_from(body->windows(0), all[got.bands - 1], payload);
        if (!window) {
            return window.error();
        }
        got.window = *window;
    }
    if (payload.size() != got.window.bytes.size()) {
        return invalid("windows: the payload is longer than its window");
    }
    return got;
}

}  // namespace shearwater::wire
