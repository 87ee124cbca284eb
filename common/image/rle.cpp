#include "common/image/rle.h"

#include <algorithm>
#include <cstring>

#include "common/image/rle_parts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/image/rle.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::image::HWY_NAMESPACE {
namespace {

// Five loops over pixels, the first and plain one of each pair being the definition; where vectors do one,
// they do as much as fills them, and leave the rest to it. Most parts of a picture of noise are a few pixels
// long: where there is room, the last three go to and fro a little beyond the part, in whole vectors, and
// what is written there is written again by the next.

// The first of [i, end) that is like the next three, which are below `end` too; or `end`.
std::size_t plain_run_of_four(const Rgba8* pixels, std::size_t i, std::size_t end) {
    static_assert(rle::least_in_stretch == 4);
    for (; i + 3 < end; ++i) {
        if (rle::same_colour(pixels[i], pixels[i + 1]) && rle::same_colour(pixels[i], pixels[i + 2]) &&
            rle::same_colour(pixels[i], pixels[i + 3])) {
            return i;
        }
    }
    return end;
}

// The first of [i, end) that is not like `pixel`, or `end`.
std::size_t plain_run_end(const Rgba8* pixels, std::size_t i, std::size_t end, const Rgba8& pixel) {
    while (i < end && rle::same_colour(pixels[i], pixel)) {
        ++i;
    }
    return i;
}

void plain_pack(const Rgba8* from, std::size_t count, std::byte* to) {
    for (std::size_t i = 0; i < count; ++i) {
        to = rle::put_colour(from[i], to);
    }
}

void plain_unpack(const std::byte* from, std::size_t count, Rgba8* to) {
    for (std::size_t i = 0; i < count; ++i) {
        to[i] = rle::colour_at(from + rle::colour_bytes * i);
    }
}

void plain_fill(Rgba8* to, std::size_t count, const Rgba8& pixel) {
    std::fill_n(to, count, pixel);
}

#if HWY_TARGET == HWY_SCALAR

std::size_t find_run_of_four(const Rgba8* pixels, std::size_t i, std::size_t end) {
    return plain_run_of_four(pixels, i, end);
}
std::size_t run_end(const Rgba8* pixels, std::size_t i, std::size_t end, const Rgba8& pixel) {
    return plain_run_end(pixels, i, end, pixel);
}
void pack(const Rgba8* from, std::size_t count, std::byte* to, std::size_t /*pixels*/,
          std::size_t /*bytes*/) {
    plain_pack(from, count, to);
}
void unpack(const std::byte* from, std::size_t count, Rgba8* to, std::size_t /*bytes*/,
            std::size_t /*pixels*/) {
    plain_unpack(from, count, to);
}
void fill(Rgba8* to, std::size_t count, const Rgba8& pixel, std::size_t /*pixels*/) {
    plain_fill(to, count, pixel);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Pixels = hn::ScalableTag<std::uint32_t>;
using Bytes = hn::Repartition<std::uint8_t, Pixels>;

// A pixel's four bytes in a lane.
HWY_INLINE hn::Vec<Pixels> all_like(const Rgba8& pixel) {
    std::uint32_t lane = 0;
    std::memcpy(&lane, &pixel, sizeof lane);
    return hn::Set(Pixels(), lane);
}

// Without their alpha.
HWY_INLINE hn::Vec<Pixels> colours(const Rgba8* from) {
    return hn::And(hn::BitCast(Pixels(), hn::LoadU(Bytes(), &from->r)), all_like({255, 255, 255, 0}));
}

std::size_t find_run_of_four(const Rgba8* pixels, std::size_t i, std::size_t end) {
    const Pixels d;
    const std::size_t step = hn::Lanes(d);
    for (; i + step + 3 <= end; i += step) {
        const auto here = colours(pixels + i), second = colours(pixels + i + 1);
        const auto third = colours(pixels + i + 2), fourth = colours(pixels + i + 3);
        const auto other = hn::Or(hn::Or(hn::Xor(here, second), hn::Xor(here, third)), hn::Xor(here, fourth));
        if (const auto first = hn::FindFirstTrue(d, hn::Eq(other, hn::Zero(d))); first >= 0) {
            return i + static_cast<std::size_t>(first);
        }
    }
    return plain_run_of_four(pixels, i, end);
}

std::size_t run_end(const Rgba8* pixels, std::size_t i, std::size_t end, const Rgba8& pixel) {
    const Pixels d;
    const std::size_t step = hn::Lanes(d);
    const auto like = all_like({pixel.r, pixel.g, pixel.b, 0});
    for (; i + step <= end; i += step) {
        const auto other = hn::Ne(colours(pixels + i), like);
        if (const auto first = hn::FindFirstTrue(d, other); first >= 0) {
            return i + static_cast<std::size_t>(first);
        }
    }
    return plain_run_end(pixels, i, end, pixel);
}

// Four pixels, 16 bytes with their alpha and 12 without.
using Four = hn::FixedTag<std::uint8_t, 16>;
constexpr std::size_t four = 4, beyond = 16;  // pixels; bytes
alignas(16) constexpr std::uint8_t packed_lanes[16] = {0,  1,  2,  4,  5,   6,   8,   9,
                                                       10, 12, 13, 14, 128, 128, 128, 128};
alignas(16) constexpr std::uint8_t pixel_lanes[16] = {0, 1, 2, 128, 3, 4,  5,  128,
                                                      6, 7, 8, 128, 9, 10, 11, 128};
alignas(16) constexpr std::uint8_t opaque[16] = {0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};

// `pixels` and `bytes`: how many there are at `from` and at `to` in all.
void pack(const Rgba8* from, std::size_t count, std::byte* to, std::size_t pixels, std::size_t bytes) {
    const Bytes wide;
    const std::size_t step = hn::Lanes(wide);
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        hn::Vec<Bytes> r, g, b, a;
        hn::LoadInterleaved4(wide, &from[i].r, r, g, b, a);
        hn::StoreInterleaved3(r, g, b, wide, reinterpret_cast<std::uint8_t*>(to + rle::colour_bytes * i));
    }
    if (pixels < count + four || bytes < rle::colour_bytes * count + beyond) {
        plain_pack(from + i, count - i, to + rle::colour_bytes * i);
        return;
    }
    const Four d;
    const auto lanes = hn::Load(d, packed_lanes);
    for (; i < count; i += four) {
        const auto packed = hn::TableLookupBytesOr0(hn::LoadU(d, &from[i].r), lanes);
        hn::StoreU(packed, d, reinterpret_cast<std::uint8_t*>(to + rle::colour_bytes * i));
    }
}

void unpack(const std::byte* from, std::size_t count, Rgba8* to, std::size_t bytes, std::size_t pixels) {
    const Bytes wide;
    const std::size_t step = hn::Lanes(wide);
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        hn::Vec<Bytes> r, g, b;
        hn::LoadInterleaved3(wide, reinterpret_cast<const std::uint8_t*>(from + rle::colour_bytes * i), r, g,
                             b);
        hn::StoreInterleaved4(r, g, b, hn::Set(wide, 255), wide, &to[i].r);
    }
    if (pixels < count + four || bytes < rle::colour_bytes * count + beyond) {
        plain_unpack(from + rle::colour_bytes * i, count - i, to + i);
        return;
    }
    const Four d;
    const auto lanes = hn::Load(d, pixel_lanes), alpha = hn::Load(d, opaque);
    for (; i < count; i += four) {
        const auto packed = hn::LoadU(d, reinterpret_cast<const std::uint8_t*>(from + rle::colour_bytes * i));
        hn::StoreU(hn::Or(hn::TableLookupBytesOr0(packed, lanes), alpha), d, &to[i].r);
    }
}

void fill(Rgba8* to, std::size_t count, const Rgba8& pixel, std::size_t pixels) {
    const auto all = hn::BitCast(Bytes(), all_like(pixel));
    const std::size_t step = hn::Lanes(Pixels());
    if (pixels < count + step) {
        plain_fill(to, count, pixel);
        return;
    }
    for (std::size_t i = 0; i < count; i += step) {
        hn::StoreU(all, Bytes(), &to[i].r);
    }
}

#endif

// Writes the first `count` of the pixels in stretches, and gives their end.
std::byte* put_stretch(const Rgba8* from, std::size_t count, std::size_t pixels, std::byte* to,
                       const std::byte* end) {
    while (count > 0) {
        const std::size_t part = std::min(rle::longest_stretch, count);
        *to++ = static_cast<std::byte>(part - 1);
        pack(from, part, to, pixels, static_cast<std::size_t>(end - to));
        from += part;
        count -= part;
        pixels -= part;
        to += rle::colour_bytes * part;
    }
    return to;
}

std::size_t encode(const Rgba8* pixels, std::size_t count, std::span<std::byte> out) {
    std::byte* to = out.data();
    const std::byte* const end_of_out = out.data() + out.size();
    for (std::size_t begin = 0; begin < count;) {
        const std::size_t longest = begin + std::min(rle::longest_run, count - begin);
        std::size_t end = run_end(pixels, begin + 1, longest, pixels[begin]);
        if (end - begin >= rle::shortest_run) {
            to = rle::put_colour(pixels[begin], rle::put_run_control(end - begin, to));
        } else {
            end = find_run_of_four(pixels, end, count);
            to = put_stretch(pixels + begin, end - begin, count - begin, to, end_of_out);
        }
        begin = end;
    }
    return static_cast<std::size_t>(to - out.data());
}

base::Status decode(std::span<const std::byte> bytes, std::span<Rgba8> pixels) {
    const auto broken = [](const char* detail) {
        return base::error(base::Code::corrupt, "decode picture", detail);
    };
    while (!bytes.empty()) {
        const rle::Part part = rle::part_at(bytes);
        if (part.bytes() > bytes.size()) {
            return broken("the code ends within a part");
        }
        if (part.pixels > pixels.size()) {
            return broken("the code gives more pixels than the picture has");
        }
        const std::byte* const colours_begin = bytes.data() + part.control_bytes;
        if (part.is_run) {
            fill(pixels.data(), part.pixels, rle::colour_at(colours_begin), pixels.size());
        } else {
            unpack(colours_begin, part.pixels, pixels.data(), bytes.size() - part.control_bytes,
                   pixels.size());
        }
        bytes = bytes.subspan(part.bytes());
        pixels = pixels.subspan(part.pixels);
    }
    if (!pixels.empty()) {
        return broken("the code gives fewer pixels than the picture has");
    }
    return {};
}

}  // namespace
}  // namespace shearwater::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::image {

HWY_EXPORT(encode);
HWY_EXPORT(decode);

std::size_t rle_bound(std::size_t pixels) {
    return rle::colour_bytes * pixels + (pixels + rle::longest_stretch - 1) / rle::longest_stretch;
}

std::size_t encode_rle(std::span<const Rgba8> pixels, std::span<std::byte> out) {
    base::check(out.size() >= rle_bound(pixels.size()), "the output holds the bound");
    return HWY_DYNAMIC_DISPATCH(encode)(pixels.data(), pixels.size(), out);
}

base::Buffer encode_rle(std::span<const Rgba8> pixels, base::Workers& workers) {
    constexpr std::size_t least = rle::longest_stretch << 7;
    const std::size_t threads = static_cast<std::size_t>(workers.threads());
    RlePieces pieces(pixels.size(), std::max(least, (pixels.size() + threads - 1) / threads));
    workers.for_each(static_cast<std::int64_t>(pieces.pieces()),
                     [&](std::int64_t n) { pieces.code(static_cast<std::size_t>(n), pixels); });
    return pieces.join();
}

// In whole stretches, so that the pieces' bounds are together that of all.
RlePieces::RlePieces(std::size_t pixels, std::size_t piece)
    : pixels_(pixels),
      piece_((piece + rle::longest_stretch - 1) / rle::longest_stretch * rle::longest_stretch),
      sizes_((pixels + piece_ - 1) / piece_),
      bytes_(rle_bound(pixels)) {}

std::pair<std::size_t, std::size_t> RlePieces::range(std::size_t piece) const {
    return {piece * piece_, std::min((piece + 1) * piece_, pixels_)};
}

void RlePieces::code(std::size_t piece, std::span<const Rgba8> pixels) {
    base::check(pixels.size() == pixels_, "a piece is coded of the picture that it is of");
    const auto [begin, end] = range(piece);
    const auto room = std::span(bytes_).subspan(rle_bound(begin), rle_bound(end) - rle_bound(begin));
    sizes_[piece] = encode_rle(pixels.subspan(begin, end - begin), room);
}

base::Buffer RlePieces::join() {
    std::size_t end = 0;
    for (std::size_t piece = 0; piece < sizes_.size(); ++piece) {
        std::memmove(bytes_.data() + end, bytes_.data() + rle_bound(piece * piece_), sizes_[piece]);
        end += sizes_[piece];
    }
    bytes_.resize(end);
    return std::move(bytes_);
}

base::Status decode_rle(std::span<const std::byte> bytes, std::span<Rgba8> pixels) {
    return HWY_DYNAMIC_DISPATCH(decode)(bytes, pixels);
}

}  // namespace shearwater::image
#endif
