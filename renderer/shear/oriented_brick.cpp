#include "renderer/shear/oriented_brick.h"

#include <algorithm>

#include "renderer/shear/kernel.h"
#include "renderer/shear/transpose.h"

namespace shearwater::shear {

namespace {

std::array<int, 3> axes_of(const FacePlan& plan) {
    return {plan.fast_axis(), plan.slow_axis(), plan.face().axis};
}

// Rows of a turned brick: 33 codes and what a block may write behind them; and as many more columns.
constexpr std::ptrdiff_t turned_row = 48;
constexpr std::ptrdiff_t turned_plane = (BrickVolume::edge + 1) * turned_row;
constexpr std::size_t turned_codes = 48 * turned_plane + voxel_padding;

}  // namespace

MicroMask::MicroMask(std::uint64_t opaque, const FacePlan& plan) : opaque_(opaque) {
    const auto axes = axes_of(plan);
    std::transform(axes.begin(), axes.end(), shifts_.begin(), [](int axis) { return 2 * axis; });
    for (int& shift : shifts_) {
        shift = 1 << shift;
    }
}

MicroPlane MicroMask::layer(std::int64_t deep) const {
    const std::uint64_t at = opaque_ >> (deep * shifts_[2]);
    unsigned plane = 0;
    for (int slow = 0; slow < 4; ++slow) {
        const std::uint64_t row = at >> (slow * shifts_[1]);
        unsigned bits = 0;
        if (shifts_[0] == 1) {
            bits = row & 15;
        } else {  // every fourth bit
            bits = (row & 1) | (row >> 3 & 2) | (row >> 6 & 4) | (row >> 9 & 8);
        }
        plane |= bits << (4 * slow);
    }
    return static_cast<MicroPlane>(plane);
}

std::array<std::array<std::int64_t, 2>, 3> MicroMask::extent() const {
    std::array<std::array<std::int64_t, 2>, 3> extent;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int shift = shifts_[axis];
        // The bits of number 0 along the axis.
        const std::uint64_t first = shift == 1   ? 0x1111111111111111U
                                    : shift == 4 ? 0x000f000f000f000fU
                                                 : 0x000000000000ffffU;
        extent[axis] = {4, -1};
        for (std::int64_t n = 0; n < 4; ++n) {
            if ((opaque_ & first << (n * shift)) != 0) {
                extent[axis] = {std::min(extent[axis][0], n), n};
            }
        }
    }
    return extent;
}

template <class Code>
OrientedBrick<Code> orient(const Brick& brick, std::span<const Code> codes, std::uint64_t opaque,
                           const FacePlan& plan, const VoxelRanges& needed, std::vector<Code>& scratch) {
    const auto axes = axes_of(plan);
    const volume::Box& box = brick.box;
    const std::array<std::ptrdiff_t, 3> strides = {1, box.planes(0), box.planes(0) * box.planes(1)};
    OrientedBrick<Code> oriented{.voxels = &codes[brick.first],
                                 .row_stride = strides[static_cast<std::size_t>(axes[1])],
                                 .plane_stride = strides[static_cast<std::size_t>(axes[2])],
                                 .lo = {},
                                 .cells = {},
                                 .opaque = MicroMask(opaque, plan),
                                 .blanks = brick.has_blanks};
    for (std::size_t n = 0; n < 3; ++n) {
        oriented.lo[n] = box.lo[static_cast<std::size_t>(axes[n])];
        oriented.cells[n] = box.cells(axes[n]);
    }
    if (axes[2] != 0) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(box.voxels()) * sizeof(Code); i += 64) {
            __builtin_prefetch(reinterpret_cast<const char*>(oriented.voxels) + i, 0, 2);
        }
        return oriented;
    }
    const auto& [y, z, x] = needed;
    const auto count = [](const std::array<std::int64_t, 2>& range) {
        return static_cast<int>(range[1] - range[0] + 1);
    };
    scratch.resize(turned_codes);
    turn(Stack<Code>{.first = oriented.voxels + z[0] * strides[2] + y[0] * strides[1] + x[0],
                     .row_stride = strides[1],
                     .plane_stride = strides[2],
                     .columns = count(x),
                     .rows = count(y),
                     .planes = count(z)},
         &scratch[static_cast<std::size_t>(x[0] * turned_plane + z[0] * turned_row + y[0])], turned_plane,
         turned_row);
    oriented.voxels = scratch.data();
    oriented.row_stride = turned_row;
    oriented.plane_stride = turned_plane;
    return oriented;
}

template OrientedBrick<std::uint8_t> orient(const Brick&, std::span<const std::uint8_t>, std::uint64_t,
                                            const FacePlan&, const VoxelRanges&, std::vector<std::uint8_t>&);
template OrientedBrick<std::uint16_t> orient(const Brick&, std::span<const std::uint16_t>, std::uint64_t,
                                             const FacePlan&, const VoxelRanges&,
                                             std::vector<std::uint16_t>&);

}  // namespace shearwater::shear
