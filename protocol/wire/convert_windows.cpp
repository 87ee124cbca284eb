// Windows: heads in the body, spans in the payload.

#include <array>
#include <bit>

#include "common/base/check.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

Parsed<view::Rect> rect_from(const pb::Rect& rect, const view::Face& face) {
    const view::Rect from{.x0 = rect.x0(), .y0 = rect.y0(), .x1 = rect.x1(), .y1 = rect.y1()};
    if (from.x0 < 0 || from.y0 < 0 || from.x1 > face.width || from.y1 > face.height || from.empty()) {
        return invalid("windows.rect: it is empty or leaves its face");
    }
    return from;
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

Message windows_message(std::uint64_t frame, image::CodedWindows windows) {
    pb::Windows body;
    body.set_frame(frame);
    for (const image::SpanWindow& window : windows.windows) {
        pb::WindowHead& head = *body.add_windows();
        head.set_face(static_cast<std::uint32_t>(window.face));
        *head.mutable_rect() = to_wire(window.rect);
    }
    return message(std::move(body), std::move(windows.bytes));
}

Parsed<std::vector<image::SpanWindow>> windows_from(const Message& message,
                                                    const view::Factorisation& factorisation) {
    const auto* body = std::get_if<pb::Windows>(&message.body);
    base::check(body != nullptr, "windows are taken from a Windows message");
    base::check(factorisation.faces.size() <= view::Factorisation::max_faces, "the factorisation is valid");
    std::span<const std::byte> left;
    if (message.payload) {
        left = *message.payload;
    }
    base::check(std::bit_cast<std::uintptr_t>(left.data()) % alignof(image::Rgba16) == 0,
                "a payload is aligned for pixels");
    std::vector<image::SpanWindow> windows;
    std::array<bool, view::Factorisation::max_faces> seen{};
    for (const pb::WindowHead& head : body->windows()) {
        if (head.face() >= factorisation.faces.size() || seen[head.face()]) {
            return invalid("windows.face: no such face, or one that was there before");
        }
        seen[head.face()] = true;
        const auto rect = rect_from(head.rect(), factorisation.faces[head.face()]);
        if (!rect) {
            return rect.error();
        }
        const auto size = image::check_spans(left, *rect);
        if (!size) {
            return invalid("windows: " + size.error().detail);
        }
        windows.push_back({.face = static_cast<int>(head.face()), .rect = *rect, .bytes = left.first(*size)});
        left = left.subspan(*size);
    }
    if (!left.empty()) {
        return invalid("windows: the payload is longer than its windows");
    }
    return windows;
}

}  // namespace shearwater::wire
