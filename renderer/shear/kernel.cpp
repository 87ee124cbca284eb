// The kernel for whatever vectors the processor has; kernel_permute-inl.h holds the form for those that can
// look up whole tables by permuting bytes.

#include "renderer/shear/kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/shear/kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/shear/kernel_common-inl.h"
#include "renderer/shear/kernel_general-inl.h"
#include "renderer/shear/kernel_permute-inl.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {

std::uint64_t composite_8(const Slab<std::uint8_t>& slab, const OpacityTable& table, const Rays& rays) {
#if HWY_TARGET == HWY_AVX3_DL
    return slab.blanks ? composite_permuting<true>(slab, table, rays)
                       : composite_permuting<false>(slab, table, rays);
#else
    return slab.blanks ? composite_in_general<true>(slab, table, rays)
                       : composite_in_general<false>(slab, table, rays);
#endif
}

std::uint64_t composite_16(const Slab<std::uint16_t>& slab, const OpacityTable& table, const Rays& rays) {
    return slab.blanks ? composite_in_general<true>(slab, table, rays)
                       : composite_in_general<false>(slab, table, rays);
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::shear {

HWY_EXPORT(composite_8);
HWY_EXPORT(composite_16);

template <>
std::uint64_t composite_slab(const Slab<std::uint8_t>& slab, const OpacityTable& table, const Rays& rays) {
    return HWY_DYNAMIC_DISPATCH(composite_8)(slab, table, rays);
}

template <>
std::uint64_t composite_slab(const Slab<std::uint16_t>& slab, const OpacityTable& table, const Rays& rays) {
    return HWY_DYNAMIC_DISPATCH(composite_16)(slab, table, rays);
}

}  // namespace shearwater::shear
#endif
