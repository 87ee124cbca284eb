#include "renderer/shear/code_array.h"

#include <algorithm>
#include <cstring>

#include "common/base/check.h"
#include "renderer/shear/kernel.h"

namespace shearwater::shear {

using volume::Box;
using volume::Index3;

namespace {

// A little more than so many codes, if need be, and a multiple of `whole`: rows or planes that lie a large
// power of two apart would compete for the same few lines of the caches.
std::int64_t padded(std::int64_t codes, std::int64_t whole, std::int64_t code_bytes) {
    constexpr std::int64_t line = 64, far = 512;
    const std::int64_t count = (codes + whole - 1) / whole * whole;
    return count * code_bytes % far == 0 ? count + line / code_bytes : count;
}

}  // namespace

CodeArray::CodeArray(const Box& box, int bits, const std::array<int, 3>& axes)
    : box_(box), code_bytes_(bits / 8), axes_(axes) {
    // Rows begin where words do, and planes where blocks do that are turned.
    constexpr std::int64_t word = 4, block = 16;
    const std::int64_t row = padded(box.planes(axes[0]), word / code_bytes_, code_bytes_);
    const std::int64_t plane = padded(row * box.planes(axes[1]), block, code_bytes_);
    strides_[static_cast<std::size_t>(axes[0])] = 1;
    strides_[static_cast<std::size_t>(axes[1])] = row;
    strides_[static_cast<std::size_t>(axes[2])] = plane;
    // With what may be read beyond the last: whole blocks are turned, so also rows.
    codes_ = base::HugeBytes(
        static_cast<std::size_t>((plane * box.planes(axes[2]) + block * row) * code_bytes_) + voxel_padding);
}

std::size_t CodeArray::offset(const Index3& p) const {
    std::size_t offset = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        offset += static_cast<std::size_t>((p[a] - box_.lo[a]) * strides_[a]);
    }
    return offset;
}

void CodeArray::move_planes(std::int64_t first) {
    const auto axis = static_cast<std::size_t>(axes_[2]);
    base::check(first >= box_.lo[axis], "planes move towards the first");
    const std::int64_t planes = box_.planes(axes_[2]);
    const std::int64_t passed = std::min(first - box_.lo[axis], planes);
    const auto plane_bytes = static_cast<std::size_t>(strides_[axis] * code_bytes_);
    auto* const all = static_cast<std::byte*>(codes_.data());
    std::memmove(all, all + static_cast<std::size_t>(passed) * plane_bytes,
                 static_cast<std::size_t>(planes - passed) * plane_bytes);
    box_.hi[axis] += first - box_.lo[axis];
    box_.lo[axis] = first;
}

}  // namespace shearwater::shear
