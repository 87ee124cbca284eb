// Per target: what both forms of the kernel share. No include guard of the usual kind: included once for
// every target.
#if defined(SHEARWATER_SHEAR_KERNEL_COMMON_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SHEARWATER_SHEAR_KERNEL_COMMON_INL_H
#undef SHEARWATER_SHEAR_KERNEL_COMMON_INL_H
#else
#define SHEARWATER_SHEAR_KERNEL_COMMON_INL_H
#endif

#include <hwy/highway.h>

#include "renderer/shear/fetching.h"
#include "renderer/shear/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// 1 - 2^-y for y >= 0, as accurate for a tiny y as for a large one: optical depths add up over a thousand
// slices. By Taylor's series in y ln 2; for y < few_halvings by the parabola times y that comes nearest,
// within seven parts in a million.
inline constexpr float nearest_parabola[] = {6.93142606e-1F, 2.3990118e-1F, 5.20196385e-2F};
inline constexpr float taylor[] = {6.93147181e-1F, 2.40226507e-1F, 5.55041087e-2F, 9.61812911e-3F,
                                   1.33335581e-3F};

template <class D, class V = hn::Vec<D>>
HWY_INLINE V opacity_of_few_halvings(D d, V y) {
    V p = hn::NegMulAdd(y, hn::Set(d, nearest_parabola[2]), hn::Set(d, nearest_parabola[1]));
    p = hn::NegMulAdd(y, p, hn::Set(d, nearest_parabola[0]));
    return hn::Mul(y, p);
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V opacity_of_halvings(D d, V y) {
    const hn::RebindToSigned<D> di;
    y = hn::Min(y, hn::Set(d, 100.0F));
    const auto whole = hn::NearestInt(y);
    const V f = hn::Sub(hn::ConvertTo(d, whole), y);
    V p = hn::MulAdd(f, hn::Set(d, taylor[4]), hn::Set(d, taylor[3]));
    p = hn::MulAdd(f, p, hn::Set(d, taylor[2]));
    p = hn::MulAdd(f, p, hn::Set(d, taylor[1]));
    p = hn::MulAdd(f, p, hn::Set(d, taylor[0]));
    const V scale = hn::BitCast(d, hn::ShiftLeft<23>(hn::Sub(hn::Set(di, 127), whole)));
    return hn::NegMulAdd(scale, hn::Mul(p, f), hn::Sub(hn::Set(d, 1.0F), scale));
}

// What a vector of rays has gathered: in one hue, of r alone.
template <class D, bool one_hue = false>
struct Gathered {
    hn::Vec<D> r, g, b, a;

    HWY_INLINE Gathered(D d, const Rays& rays, std::ptrdiff_t ray)
        : r(hn::LoadU(d, rays.r + ray)),
          g(one_hue ? hn::Zero(d) : hn::LoadU(d, rays.g + ray)),
          b(one_hue ? hn::Zero(d) : hn::LoadU(d, rays.b + ray)),
          a(hn::LoadU(d, rays.a + ray)) {}
    HWY_INLINE void put_behind(hn::Vec<D> alpha, hn::Vec<D> red, hn::Vec<D> green, hn::Vec<D> blue) {
        const auto weight = hn::NegMulAdd(a, alpha, alpha);
        r = hn::MulAdd(weight, red, r);
        g = hn::MulAdd(weight, green, g);
        b = hn::MulAdd(weight, blue, b);
        a = hn::Add(a, weight);
    }
    HWY_INLINE void store(D d, const Rays& rays, std::ptrdiff_t ray) const {
        hn::StoreU(r, d, rays.r + ray);
        if constexpr (!one_hue) {
            hn::StoreU(g, d, rays.g + ray);
            hn::StoreU(b, d, rays.b + ray);
        }
        hn::StoreU(a, d, rays.a + ray);
    }
};

// Where the samples of a row of pixels, or of a column, lie: from voxel `cell` of the slab on by `step`
// cell_steps.
struct CellPlace {
    std::int64_t cell;
    int step;
};
HWY_INLINE CellPlace place_of(double at, std::int64_t first_voxel) {
    const auto steps = static_cast<std::int64_t>(at * cell_steps + 0.5);
    return {steps / cell_steps - first_voxel, static_cast<int>(steps % cell_steps)};
}

// Pixels are counted as the cube's slices count them.
template <class Code>
HWY_INLINE double along_row(const Slice<Code>& slice, int i) {
    return slice.fast_offset + slice.fast_scale * i;
}
template <class Code>
HWY_INLINE CellPlace row_place(const Slab<Code>& slab, const Slice<Code>& slice, int j) {
    const CellPlace place =
        place_of(slice.slow_offset + slice.slow_scale * (j + slab.slow_pixel), slab.slow_first);
    // A row on the last row of voxels belongs to the last cell.
    return place.cell < slab.slow_cells ? place : CellPlace{place.cell - 1, place.step + cell_steps};
}

// The pixels that some slice of a slab wants.
template <class Code>
HWY_INLINE view::Rect pixels_of(const Slab<Code>& slab) {
    view::Rect pixels = slab.slices[0].pixels;
    for (int k = 1; k < slab.count; ++k) {
        const view::Rect& more = slab.slices[static_cast<std::size_t>(k)].pixels;
        pixels = {std::min(pixels.x0, more.x0), std::min(pixels.y0, more.y0), std::max(pixels.x1, more.x1),
                  std::max(pixels.y1, more.y1)};
    }
    return pixels;
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
