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
// they do as much as fills them, and leave the rest to it.

// The first of [i, end) that is like the one after it, which is below `end` too; or `end`.
std::size_t plain_pair(const Rgba8* pixels, std::size_t i, std::size_t end) {
    for (; i + 1 < end; ++i) {
        if (rle::same_colour(pixels[i], pixels[i + 1])) {
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

std::size_t find_pair(const Rgba8* pixels, std::size_t i, std::size_t end) {
    return plain_pair(pixels, i, end);
}
std::size_t run_end(const Rgba8* pixels, std::size_t i, std::size_t end, const Rgba8& pixel) {
    return plain_run_end(pixels, i, end, pixel);
}
void pack(const Rgba8* from, std::size_t count, std::byte* to) {
    plain_pack(from, count, to);
}
void unpack(const std::byte* from, std::size_t count, Rgba8* to) {
    plain_unpack(from, count, to);
}
void fill(Rgba8* to, std::size_t count, const Rgba8& pixel) {
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

std::size_t find_pair(const Rgba8* pixels, std::size_t i, std::size_t end) {
    const Pixels d;
    const std::size_t step = hn::Lanes(d);
    for (; i + step + 1 <= end; i += step) {
        const auto like = hn::Eq(colours(pixels + i), colours(pixels + i + 1));
        if (const auto first = hn::FindFirstTrue(d, like); first >= 0) {
            return i + static_cast<std::size_t>(first);
        }
    }
    return plain_pair(pixels, i, end);
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

void pack(const Rgba8* from, std::size_t count, std::byte* to) {
    const Bytes d;
    const std::size_t step = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        hn::Vec<Bytes> r, g, b, a;
        hn::LoadInterleaved4(d, &from[i].r, r, g, b, a);
        hn::StoreInterleaved3(r, g, b, d, reinterpret_cast<std::uint8_t*>(to + rle::colour_bytes * i));
    }
    plain_pack(from + i, count - i, to + rle::colour_bytes * i);
}

void unpack(const std::byte* from, std::size_t count, Rgba8* to) {
    const Bytes d;
    const std::size_t step = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        hn::Vec<Bytes> r, g, b;
        hn::LoadInterleaved3(d, reinterpret_cast<const std::uint8_t*>(from + rle::colour_bytes * i), r, g, b);
        hn::StoreInterleaved4(r, g, b, hn::Set(d, 255), d, &to[i].r);
    }
    plain_unpack(from + rle::colour_bytes * i, count - i, to + i);
}

void fill(Rgba8* to, std::size_t count, const Rgba8& pixel) {
    const auto all = hn::BitCast(Bytes(), all_like(pixel));
    const std::size_t step = hn::Lanes(Pixels());
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        hn::StoreU(all, Bytes(), &to[i].r);
    }
    plain_fill(to + i, count - i, pixel);
}

#endif

std::byte* put_stretch(const Rgba8* pixels, std::size_t count, std::byte* to) {
    while (count > 0) {
        const std::size_t part = std::min(rle::longest_stretch, count);
        *to++ = static_cast<std::byte>(part - 1);
        pack(pixels, part, to);
        pixels += part;
        count -= part;
        to += rle::colour_bytes * part;
    }
    return to;
}

std::size_t encode(const Rgba8* pixels, std::size_t count, std::byte* out) {
    std::byte* to = out;
    std::size_t stretch_begin = 0;
    while (true) {
        const std::size_t run = find_pair(pixels, stretch_begin, count);
        to = put_stretch(pixels + stretch_begin, run - stretch_begin, to);
        if (run == count) {
            return static_cast<std::size_t>(to - out);
        }
        const std::size_t longest = run + std::min(rle::longest_run, count - run);
        const std::size_t end = run_end(pixels, run + rle::shortest_run, longest, pixels[run]);
        to = rle::put_colour(pixels[run], rle::put_run_control(end - run, to));
        stretch_begin = end;
    }
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
            fill(pixels.data(), part.pixels, rle::colour_at(colours_begin));
        } else {
            unpack(colours_begin, part.pixels, pixels.data());
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
    return HWY_DYNAMIC_DISPATCH(encode)(pixels.data(), pixels.size(), out.data());
}

std::size_t encode_rle(std::span<const Rgba8> pixels, std::span<std::byte> out, base::Workers& workers) {
    base::check(out.size() >= rle_bound(pixels.size()), "the output holds the bound");
    // In whole stretches, so that the parts' bounds are together that of all.
    constexpr std::size_t least = rle::longest_stretch << 7;
    const std::size_t threads = static_cast<std::size_t>(workers.threads());
    const std::size_t wanted = std::max(least, (pixels.size() + threads - 1) / threads);
    const std::size_t each =
        (wanted + rle::longest_stretch - 1) / rle::longest_stretch * rle::longest_stretch;
    std::vector<std::size_t> sizes((pixels.size() + each - 1) / each);
    workers.for_each(static_cast<std::int64_t>(sizes.size()), [&](std::int64_t n) {
        const std::size_t part = static_cast<std::size_t>(n), begin = part * each;
        sizes[part] = encode_rle(pixels.subspan(begin, std::min(each, pixels.size() - begin)),
                                 out.subspan(rle_bound(begin)));
    });
    std::size_t end = 0;
    for (std::size_t part = 0; part < sizes.size(); ++part) {
        std::memmove(out.data() + end, out.data() + rle_bound(part * each), sizes[part]);
        end += sizes[part];
    }
    return end;
}

base::Status decode_rle(std::span<const std::byte> bytes, std::span<Rgba8> pixels) {
    return HWY_DYNAMIC_DISPATCH(decode)(bytes, pixels);
}

}  // namespace shearwater::image
#endif
