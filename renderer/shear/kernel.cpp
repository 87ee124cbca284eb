#include "renderer/shear/kernel.h"

#include <algorithm>

namespace shearwater::shear {

template <class Code, bool blanks>
int composite_span(const VoxelRows<Code>& voxels, std::span<const float> lengths, const OpacityTable& table,
                   const RaySpan& rays) {
    const float scale = table.scale();
    const float bias = table.bias();
    const float fv = voxels.v_fraction;
    int taken = 0;
    for (std::size_t n = 0; n < lengths.size(); ++n) {
        if (rays.a[n] >= opaque_enough) {
            continue;
        }
        ++taken;
        // Rounding may put a sample just outside the brick that owns it.
        const float u = voxels.u + static_cast<float>(n) * voxels.u_scale;
        const int cell = std::clamp(static_cast<int>(u), 0, voxels.cells - 1);
        const float fu = u - static_cast<float>(cell);
        const Code* const c0 = voxels.row0 + cell * voxels.stride;
        const Code* const c1 = voxels.row1 + cell * voxels.stride;
        const auto mix = [&](float v00, float v10, float v01, float v11) {
            const float v0 = v00 + fu * (v10 - v00);
            const float v1 = v01 + fu * (v11 - v01);
            return v0 + fv * (v1 - v0);
        };
        const Code v00 = c0[0], v10 = c0[voxels.stride], v01 = c1[0], v11 = c1[voxels.stride];
        float code = mix(v00, v10, v01, v11);
        if constexpr (blanks) {
            const float valid = mix(v00 != 0, v10 != 0, v01 != 0, v11 != 0);
            if (valid < 0.5F) {
                continue;
            }
            code /= valid;
        }
        const OpacityTable::Entry& entry = table.data()[static_cast<int>(code * scale + bias)];
        if (entry.extinction == 0) {
            continue;
        }
        const float weight = (1 - rays.a[n]) * opacity_of(entry.extinction * lengths[n]);
        rays.r[n] += weight * entry.r;
        rays.g[n] += weight * entry.g;
        rays.b[n] += weight * entry.b;
        rays.a[n] += weight;
    }
    return taken;
}

template int composite_span<std::uint8_t, false>(const VoxelRows<std::uint8_t>&, std::span<const float>,
                                                 const OpacityTable&, const RaySpan&);
template int composite_span<std::uint8_t, true>(const VoxelRows<std::uint8_t>&, std::span<const float>,
                                                const OpacityTable&, const RaySpan&);
template int composite_span<std::uint16_t, false>(const VoxelRows<std::uint16_t>&, std::span<const float>,
                                                  const OpacityTable&, const RaySpan&);
template int composite_span<std::uint16_t, true>(const VoxelRows<std::uint16_t>&, std::span<const float>,
                                                 const OpacityTable&, const RaySpan&);

}  // namespace shearwater::shear
