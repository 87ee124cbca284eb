#include "renderer/shear/ray_pixels.h"

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/shear/ray_pixels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// So many rays as the vector has lanes.
template <bool one_hue, class D>
HWY_INLINE void put_some(D d, const Rays& rays, std::ptrdiff_t ray, const float* hue, image::RgbaF* out) {
    const auto a = hn::LoadU(d, rays.a + ray);
    const auto one = hn::Set(d, 1.0F);
    const auto done = hn::Ge(a, hn::Set(d, rays.done));
    const auto whole = hn::IfThenElse(done, hn::Div(one, a), one);
    const auto r = hn::Mul(hn::LoadU(d, rays.r + ray), whole);
    const auto alpha = hn::IfThenElse(done, one, a);
    if constexpr (one_hue) {
        hn::StoreInterleaved4(hn::Mul(r, hn::Set(d, hue[0])), hn::Mul(r, hn::Set(d, hue[1])),
                              hn::Mul(r, hn::Set(d, hue[2])), alpha, d, &out->r);
    } else {
        hn::StoreInterleaved4(r, hn::Mul(hn::LoadU(d, rays.g + ray), whole),
                              hn::Mul(hn::LoadU(d, rays.b + ray), whole), alpha, d, &out->r);
    }
}

template <bool one_hue>
HWY_INLINE void put(const Rays& rays, std::ptrdiff_t first, const float* hue, std::span<image::RgbaF> out) {
    const hn::ScalableTag<float> d;
    const hn::CappedTag<float, 1> single;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t n = 0;
    for (; n + lanes <= out.size(); n += lanes) {
        put_some<one_hue>(d, rays, first + static_cast<std::ptrdiff_t>(n), hue, &out[n]);
    }
    for (; n < out.size(); ++n) {
        put_some<one_hue>(single, rays, first + static_cast<std::ptrdiff_t>(n), hue, &out[n]);
    }
}

void put_rays(const Rays& rays, std::ptrdiff_t first, const float* hue, std::span<image::RgbaF> out) {
    if (hue != nullptr) {
        put<true>(rays, first, hue, out);
    } else {
        put<false>(rays, first, hue, out);
    }
}

// Pixels begin where four floats do, and not always where a longer vector does.
void clear(std::span<image::RgbaF> out) {
    const hn::CappedTag<float, 4> d;
    const auto zero = hn::Zero(d);
    for (image::RgbaF& pixel : out) {
        for (std::size_t n = 0; n < 4; n += hn::Lanes(d)) {
            hn::Stream(zero, d, &pixel.r + n);
        }
    }
}

}  // namespace
}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::shear {

HWY_EXPORT(put_rays);
HWY_EXPORT(clear);

void clear_pixels(std::span<image::RgbaF> out) {
    HWY_DYNAMIC_DISPATCH(clear)(out);
}

void flush_cleared() {
    hwy::FlushStream();
}

void pixels_of(const Rays& rays, std::ptrdiff_t first, const view::Rgb* hue, std::span<image::RgbaF> out) {
    if (hue == nullptr) {
        HWY_DYNAMIC_DISPATCH(put_rays)(rays, first, nullptr, out);
        return;
    }
    const float channels[3] = {static_cast<float>(hue->r), static_cast<float>(hue->g),
                               static_cast<float>(hue->b)};
    HWY_DYNAMIC_DISPATCH(put_rays)(rays, first, channels, out);
}

}  // namespace shearwater::shear
#endif
