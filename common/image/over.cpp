#include "common/image/over.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/image/over.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

// Each function is defined by one pixel of it in plain code, and done with as many pixels at a time as four
// of a vector's lanes go into it.

HWY_BEFORE_NAMESPACE();
namespace shearwater::image::HWY_NAMESPACE {
namespace {

constexpr float levels = 65535.0F;
constexpr float level = 1 / levels;

#if HWY_TARGET == HWY_SCALAR

const RgbaF& to_float(const RgbaF& pixel) {
    return pixel;
}
RgbaF to_float(const Rgba16& pixel) {
    return {static_cast<float>(pixel.r) * level, static_cast<float>(pixel.g) * level,
            static_cast<float>(pixel.b) * level, static_cast<float>(pixel.a) * level};
}

std::uint16_t to_level(float x) {
    return static_cast<std::uint16_t>(static_cast<int>(std::min(std::max(x, 0.0F), 1.0F) * levels + 0.5F));
}

template <class Pixel>
void over_any(RgbaF* front, const Pixel* back, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const RgbaF behind = to_float(back[i]);
        const float through = 1 - front[i].a;
        front[i].r += through * behind.r;
        front[i].g += through * behind.g;
        front[i].b += through * behind.b;
        front[i].a += through * behind.a;
    }
}

void to_levels(const RgbaF* from, Rgba16* to, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        to[i] = {to_level(from[i].r), to_level(from[i].g), to_level(from[i].b), to_level(from[i].a)};
    }
}

void from_levels(const Rgba16* from, RgbaF* to, std::size_t count) {
    std::transform(from, from + count, to, [](const Rgba16& pixel) { return to_float(pixel); });
}

#else

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE hn::Vec<D> load(D d, const RgbaF* from) {
    return hn::LoadU(d, &from->r);
}
template <class D>
HWY_INLINE hn::Vec<D> load(D d, const Rgba16* from) {
    const auto whole =
        hn::PromoteTo(hn::RebindToSigned<D>(), hn::LoadU(hn::Rebind<std::uint16_t, D>(), &from->r));
    return hn::Mul(hn::ConvertTo(d, whole), hn::Set(d, level));
}

// Calls step(d, n) for the pixels from n on, as many as a vector of d has, until all have had their turn.
template <class Step>
HWY_INLINE void for_pixels(std::size_t count, const Step& step) {
    const hn::CappedTag<float, 16> wide;
    const std::size_t pixels = hn::Lanes(wide) / 4;
    std::size_t n = 0;
    for (; n + pixels <= count; n += pixels) {
        step(wide, n);
    }
    for (; n < count; ++n) {
        step(hn::FixedTag<float, 4>(), n);
    }
}

template <class Pixel>
void over_any(RgbaF* front, const Pixel* back, std::size_t count) {
    for_pixels(count, [=](auto d, std::size_t n) HWY_ATTR {
        const auto before = load(d, front + n);
        const auto through = hn::Sub(hn::Set(d, 1), hn::Broadcast<3>(before));
        hn::StoreU(hn::MulAdd(through, load(d, back + n), before), d, &front[n].r);
    });
}

void to_levels(const RgbaF* from, Rgba16* to, std::size_t count) {
    for_pixels(count, [=](auto d, std::size_t n) HWY_ATTR {
        using D = decltype(d);
        const auto unit = hn::Min(hn::Max(load(d, from + n), hn::Zero(d)), hn::Set(d, 1));
        const auto nearest = hn::MulAdd(unit, hn::Set(d, levels), hn::Set(d, 0.5F));
        const hn::Rebind<std::uint16_t, D> to_d;
        hn::StoreU(hn::DemoteTo(to_d, hn::ConvertTo(hn::RebindToSigned<D>(), nearest)), to_d, &to[n].r);
    });
}

void from_levels(const Rgba16* from, RgbaF* to, std::size_t count) {
    for_pixels(count, [=](auto d, std::size_t n) HWY_ATTR { hn::StoreU(load(d, from + n), d, &to[n].r); });
}

#endif

void over_floats(RgbaF* front, const RgbaF* back, std::size_t count) {
    over_any(front, back, count);
}
void over_levels(RgbaF* front, const Rgba16* back, std::size_t count) {
    over_any(front, back, count);
}

}  // namespace
}  // namespace shearwater::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::image {

HWY_EXPORT(over_floats);
HWY_EXPORT(over_levels);
HWY_EXPORT(to_levels);
HWY_EXPORT(from_levels);

void over(std::span<RgbaF> front, std::span<const RgbaF> back) {
    base::check(front.size() == back.size(), "over takes spans of one length");
    HWY_DYNAMIC_DISPATCH(over_floats)(front.data(), back.data(), front.size());
}

void over(std::span<RgbaF> front, std::span<const Rgba16> back) {
    base::check(front.size() == back.size(), "over takes spans of one length");
    HWY_DYNAMIC_DISPATCH(over_levels)(front.data(), back.data(), front.size());
}

void to_16_bits(std::span<const RgbaF> from, std::span<Rgba16> to) {
    base::check(from.size() == to.size(), "pixels are converted one to one");
    HWY_DYNAMIC_DISPATCH(to_levels)(from.data(), to.data(), from.size());
}

void from_16_bits(std::span<const Rgba16> from, std::span<RgbaF> to) {
    base::check(from.size() == to.size(), "pixels are converted one to one");
    HWY_DYNAMIC_DISPATCH(from_levels)(from.data(), to.data(), from.size());
}

}  // namespace shearwater::image
#endif
