#include "protocol/wire/picture.h"

#include <utility>

#include "common/image/rle.h"

namespace shearwater::wire {
namespace {

Parsed<std::vector<std::byte>> inflated(std::span<const std::byte> bytes, std::size_t limit) {
    auto unpacked = image::inflate(bytes, limit);
    if (!unpacked) {
        const bool bomb = unpacked.error().code == base::Code::too_large;
        return Fault{bomb ? pb::REASON_TOO_LARGE : pb::REASON_MALFORMED,
                     "frame: " + unpacked.error().message()};
    }
    return *std::move(unpacked);
}

}  // namespace

Message frame_message(pb::Frame frame, const view::ImageSize& size, base::Buffer coded, bool deflate) {
    frame.set_width(static_cast<std::uint32_t>(size.width));
    frame.set_height(static_cast<std::uint32_t>(size.height));
    frame.set_encoding(pb::ENCODING_RLE);
    if (deflate) {
        const std::vector<std::byte> smaller = image::deflate(coded);
        if (smaller.size() < coded.size()) {
            frame.set_encoding(pb::ENCODING_RLE_DEFLATE);
            return message(std::move(frame), std::span(smaller));
        }
    }
    return message(std::move(frame), std::move(coded));
}

Parsed<image::Image<image::Rgba8>> picture_from(const Message& message, const view::ImageSize& asked) {
    const auto& frame = std::get<pb::Frame>(message.body);
    if (std::cmp_not_equal(frame.width(), asked.width) || std::cmp_not_equal(frame.height(), asked.height)) {
        return Fault{pb::REASON_INVALID, "frame: not of the size asked for"};
    }
    image::Image<image::Rgba8> picture(asked.width, asked.height, image::Unfilled());
    std::span<const std::byte> code;
    if (message.payload) {
        code = *message.payload;
    }
    std::vector<std::byte> unpacked;
    if (frame.encoding() == pb::ENCODING_RLE_DEFLATE) {
        auto bytes = inflated(code, image::rle_bound(picture.pixels().size()));
        if (!bytes) {
            return bytes.error();
        }
        unpacked = *std::move(bytes);
        code = unpacked;
    } else if (frame.encoding() != pb::ENCODING_RLE) {
        return Fault{pb::REASON_INVALID, "frame: its encoding is unknown"};
    }
    if (const auto decoded = image::decode_rle(code, picture.pixels()); !decoded) {
        return Fault{pb::REASON_MALFORMED, "frame: " + decoded.error().message()};
    }
    return picture;
}

}  // namespace shearwater::wire
