#pragma once
// Codes of the nodes in a box, in memory: rows along one axis, planes of rows, and so on.

#include <array>
#include <cstddef>
#include <span>

#include "common/base/huge_array.h"
#include "common/volume/box.h"

namespace shearwater::shear {

class CodeArray {
  public:
    CodeArray() = default;
    // Blank throughout, with codes of 8 or 16 bits: rows along axes[0], one behind the other along axes[1],
    // their planes along axes[2]. std::bad_alloc where there is no room.
    CodeArray(const volume::Box& box, int bits, const std::array<int, 3>& axes);

    const volume::Box& box() const { return box_; }
    std::size_t bytes() const { return codes_.size(); }

    // The codes, `Code` having as many bits. That of the node at p lies at offset(p); from one to the next
    // along an axis it is stride(axis). Behind the last lie a few rows and voxel_padding bytes more.
    template <class Code>
    std::span<const Code> codes() const {
        return {static_cast<const Code*>(codes_.data()), codes_.size() / sizeof(Code)};
    }
    template <class Code>
    std::span<Code> codes() {
        return {static_cast<Code*>(codes_.data()), codes_.size() / sizeof(Code)};
    }
    std::ptrdiff_t stride(int axis) const { return strides_[static_cast<std::size_t>(axis)]; }
    std::size_t offset(const volume::Index3& p) const;
    // That rows run along.
    int adjacent_axis() const { return axes_[0]; }

    // Moves the box along the axis of its planes to begin with another one, no earlier one. What codes its
    // planes had that it still holds they keep; the others have any.
    void move_planes(std::int64_t first);

  private:
    volume::Box box_;
    int code_bytes_ = 1;
    std::array<int, 3> axes_{0, 1, 2};
    volume::Index3 strides_{};
    base::HugeBytes codes_;
};

}  // namespace shearwater::shear
