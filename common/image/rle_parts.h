#pragma once
// What a coded picture consists of: a sequence of
//   0nnnnnnn                     n + 1 pixels follow, 3 bytes each
//   10nnnnnn           r g b     n + 2 times one pixel
//   11nnnnnn nnnnnnnn  r g b     n + 66 times one pixel (the high bits first)
// A run saves at least two bytes and begins at most one more stretch, so runs never make a picture larger
// than plain stretches do: that is the bound.
//
// Noise is full of short runs, and it is parts that take time: the coder ends a stretch only for runs of four
// and more. That is a quarter of the parts, for a seventh more bytes, which deflate makes up for.

#include <cstddef>
#include <span>

#include "common/image/image.h"

namespace shearwater::image::rle {

constexpr std::size_t longest_stretch = 128;
constexpr std::size_t shortest_run = 2;
constexpr std::size_t least_in_stretch = 4;  // that a coder ends a stretch for
constexpr std::size_t shortest_long_run = 66;
constexpr std::size_t longest_run = shortest_long_run + 0x3fff;
constexpr std::size_t colour_bytes = 3;

inline bool same_colour(const Rgba8& a, const Rgba8& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

// What one control byte (and the one after, for a long run) announces.
struct Part {
    bool is_run = false;
    std::size_t pixels = 0;
    std::size_t control_bytes = 1;

    std::size_t bytes() const { return control_bytes + colour_bytes * (is_run ? 1 : pixels); }
};

inline Part part_at(std::span<const std::byte> bytes) {
    const auto control = std::to_integer<std::size_t>(bytes[0]);
    if (control < 0x80) {
        return {false, control + 1, 1};
    }
    if (control < 0xc0) {
        return {true, (control & 0x3f) + shortest_run, 1};
    }
    const std::size_t low = bytes.size() > 1 ? std::to_integer<std::size_t>(bytes[1]) : 0;
    return {true, (((control & 0x3f) << 8) | low) + shortest_long_run, 2};
}

// Writes the control bytes of a run, and gives their end.
inline std::byte* put_run_control(std::size_t count, std::byte* to) {
    if (count < shortest_long_run) {
        *to++ = static_cast<std::byte>(0x80 | (count - shortest_run));
    } else {
        *to++ = static_cast<std::byte>(0xc0 | ((count - shortest_long_run) >> 8));
        *to++ = static_cast<std::byte>((count - shortest_long_run) & 0xff);
    }
    return to;
}

inline std::byte* put_colour(const Rgba8& pixel, std::byte* to) {
    *to++ = std::byte{pixel.r};
    *to++ = std::byte{pixel.g};
    *to++ = std::byte{pixel.b};
    return to;
}

inline Rgba8 colour_at(const std::byte* from) {
    return {std::to_integer<std::uint8_t>(from[0]), std::to_integer<std::uint8_t>(from[1]),
            std::to_integer<std::uint8_t>(from[2]), 255};
}

}  // namespace shearwater::image::rle
