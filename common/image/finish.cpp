#include "common/image/finish.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/image/finish.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace shearwater::image::HWY_NAMESPACE {
namespace {

// In levels, a channel an entry.
using Background = float[4];

#if HWY_TARGET == HWY_SCALAR

void finish(std::span<const RgbaF> from, const Background& background, std::span<Rgba8> to) {
    for (std::size_t n = 0; n < from.size(); ++n) {
        const auto level = [&](float x, float behind) {
            const float levels = x * 255 + (1 - from[n].a) * behind;
            return static_cast<std::uint8_t>(std::clamp(levels, 0.0F, 255.0F) + 0.5F);
        };
        to[n] = {level(from[n].r, background[0]), level(from[n].g, background[1]),
                 level(from[n].b, background[2]), 255};
    }
}

#else

namespace hn = hwy::HWY_NAMESPACE;

// As many pixels as four of the vector's lanes go into it.
template <class D>
HWY_INLINE void finish_some(D d, const float* HWY_RESTRICT from, const Background& background,
                            std::uint8_t* HWY_RESTRICT to) {
    const auto pixels = hn::LoadU(d, from);
    const auto through = hn::Sub(hn::Set(d, 1), hn::Broadcast<3>(pixels));
    const auto behind = hn::Mul(through, hn::LoadDup128(d, background));
    const auto levels = hn::MulAdd(pixels, hn::Set(d, 255), behind);
    const auto bounded = hn::Min(hn::Max(levels, hn::Zero(d)), hn::Set(d, 255));
    const hn::RebindToSigned<D> integer;
    const hn::Rebind<std::uint8_t, D> byte;
    hn::StoreU(hn::DemoteTo(byte, hn::ConvertTo(integer, hn::Add(bounded, hn::Set(d, 0.5F)))), byte, to);
}

void finish(std::span<const RgbaF> from, const Background& background, std::span<Rgba8> to) {
    const hn::CappedTag<float, 16> wide;
    const hn::FixedTag<float, 4> one;
    const std::size_t step = hn::Lanes(wide) / 4;
    // Most of a picture may be empty, and is told by whole blocks.
    constexpr std::size_t block = 16;
    Rgba8 empty{0, 0, 0, 255};
    alignas(16) static constexpr float nothing[4] = {0, 0, 0, 0};
    finish_some(one, nothing, background, &empty.r);
    std::size_t n = 0;
    for (; n + block <= from.size(); n += block) {
        auto any = hn::Zero(wide);
        for (std::size_t m = 0; m < block; m += step) {
            any = hn::Or(any, hn::LoadU(wide, &from[n + m].r));
        }
        if (hn::AllTrue(wide, hn::Eq(any, hn::Zero(wide)))) {
            std::fill_n(to.begin() + static_cast<std::ptrdiff_t>(n), block, empty);
            continue;
        }
        for (std::size_t m = n; m < n + block; m += step) {
            finish_some(wide, &from[m].r, background, &to[m].r);
        }
    }
    for (; n + step <= from.size(); n += step) {
        finish_some(wide, &from[n].r, background, &to[n].r);
    }
    for (; n < from.size(); ++n) {
        finish_some(one, &from[n].r, background, &to[n].r);
    }
}

#endif

}  // namespace
}  // namespace shearwater::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::image {

HWY_EXPORT(finish);

void finish(std::span<const RgbaF> from, const view::Rgb& background, std::span<Rgba8> to) {
    base::check(from.size() == to.size(), "pixels are finished one to one");
    const auto levels = [](double x) { return static_cast<float>(x * 255); };
    alignas(16)
        const float behind[4] = {levels(background.r), levels(background.g), levels(background.b), 255};
    HWY_DYNAMIC_DISPATCH(finish)(from, behind, to);
}

}  // namespace shearwater::image
#endif
