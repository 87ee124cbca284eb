// Rendered windows: heads in the body, pixels in the payload.

#include <bit>

#include "common/base/check.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

using image::Rgba16;

// The payload's 16-bit channels are little-endian; here they are read and written in place.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Rgba16) == 8 && alignof(Rgba16) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

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

Message windows_message(std::uint64_t frame, std::span<const image::Window> windows) {
    pb::Windows body;
    body.set_frame(frame);
    std::size_t pixels = 0;
    for (const image::Window& window : windows) {
        if (!window.rect.empty()) {
            pb::WindowHead& head = *body.add_windows();
            head.set_face(static_cast<std::uint32_t>(window.face));
            *head.mutable_rect() = to_wire(window.rect);
            pixels += static_cast<std::size_t>(window.rect.area());
        }
    }
    std::vector<std::byte> payload(pixels * sizeof(Rgba16));
    Rgba16* to = reinterpret_cast<Rgba16*>(payload.data());
    for (const image::Window& window : windows) {
        if (!window.rect.empty()) {
            const std::span<const image::RgbaF> from = window.pixels.pixels();
            base::check(from.size() == static_cast<std::size_t>(window.rect.area()),
                        "a window holds its rectangle");
            image::to_16_bits(from, {to, from.size()});
            to += from.size();
        }
    }
    return message(std::move(body), std::move(payload));
}

Parsed<std::vector<image::WindowView16>> windows_from(const Message& message,
                                                      const view::Factorisation& factorisation) {
    const auto* body = std::get_if<pb::Windows>(&message.body);
    base::check(body != nullptr, "windows are taken from a Windows message");
    base::check(factorisation.faces.size() <= view::Factorisation::max_faces, "the factorisation is valid");

    const auto* pixels = message.payload ? reinterpret_cast<const Rgba16*>(message.payload->data()) : nullptr;
    base::check(std::bit_cast<std::uintptr_t>(pixels) % alignof(Rgba16) == 0,
                "a payload is aligned for pixels");
    const std::uint64_t available = message.payload_size() / sizeof(Rgba16);

    std::vector<image::WindowView16> windows;
    std::array<bool, view::Factorisation::max_faces> seen{};
    std::uint64_t used = 0;
    for (const pb::WindowHead& head : body->windows()) {
        if (head.face() >= factorisation.faces.size() || seen[head.face()]) {
            return invalid("windows.face: no such face, or one that was there before");
        }
        seen[head.face()] = true;
        const auto rect = rect_from(head.rect(), factorisation.faces[head.face()]);
        if (!rect) {
            return rect.error();
        }
        const auto area = static_cast<std::uint64_t>(rect->area());
        if (area > available - used) {
            return invalid("windows: the payload is shorter than its windows");
        }
        windows.push_back({.face = static_cast<int>(head.face()),
                           .rect = *rect,
                           .pixels = {pixels + used, static_cast<std::size_t>(area)}});
        used += area;
    }
    if (used * sizeof(Rgba16) != message.payload_size()) {
        return invalid("windows: the payload is longer than its windows");
    }
    return windows;
}

}  // namespace shearwater::wire
