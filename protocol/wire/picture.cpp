#include "protocol/wire/picture.h"

#include <algorithm>
#include <utility>

#include "common/image/rle.h"

namespace shearwater::wire {
namespace {

using Picture = image::Image<image::Rgba8>;

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

Message frame_message(pb::Frame frame, const view::ImageSize& size, int eyes, base::Buffer coded,
                      bool deflate) {
    if (eyes > 1) {
        frame.set_eyes(static_cast<std::uint32_t>(eyes));
    }
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

Parsed<std::vector<Picture>> pictures_from(const Message& message, const view::ImageSize& asked, int eyes) {
    const auto& frame = std::get<pb::Frame>(message.body);
    if (std::cmp_not_equal(frame.width(), asked.width) || std::cmp_not_equal(frame.height(), asked.height)) {
        return Fault{pb::REASON_INVALID, "frame: not of the size asked for"};
    }
    if (std::cmp_not_equal(std::max(frame.eyes(), 1U), eyes)) {
        return Fault{pb::REASON_INVALID, "frame: not of as many eyes as asked for"};
    }
    Picture picture(asked.width, eyes * asked.height, image::Unfilled());
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
    std::vector<Picture> pictures;
    if (eyes == 1) {
        pictures.push_back(std::move(picture));
        return pictures;
    }
    for (int eye = 0; eye < eyes; ++eye) {
        const std::size_t pixels = picture.pixels().size() / static_cast<std::size_t>(eyes);
        Picture& one = pictures.emplace_back(asked.width, asked.height, image::Unfilled());
        std::ranges::copy(picture.pixels().subspan(static_cast<std::size_t>(eye) * pixels, pixels),
                          one.pixels().begin());
    }
    return pictures;
}

Parsed<Picture> picture_from(const Message& message, const view::ImageSize& asked) {
    auto pictures = pictures_from(message, asked, 1);
    if (!pictures) {
        return pictures.error();
    }
    return std::move(pictures->front());
}

}  // namespace shearwater::wire
