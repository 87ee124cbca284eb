#include "renderer/shear/code_volume.h"

#include <algorithm>
#include <cstring>

#include "common/base/check.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/survey.h"

namespace shearwater::shear {

using volume::Box;
using volume::Index3;

namespace {

// A little more than so many codes, if need be: rows or planes that lie a large power of two apart would
// compete for the same few lines of the caches.
std::int64_t padded(std::int64_t codes, std::int64_t code_bytes) {
    constexpr std::int64_t word = 4, line = 64, far = 512;
    const std::int64_t bytes = (codes * code_bytes + word - 1) / word * word;
    return (bytes % far == 0 ? bytes + line : bytes) / code_bytes;
}

Index3 strides_of(const Box& box, int bits) {
    const std::int64_t row = padded(box.planes(0), bits / 8);
    return {1, row, padded(row * box.planes(1), bits / 8)};
}

// With what may be read beyond the last: whole blocks are turned, so also rows.
std::size_t bytes_of(const Box& box, const Index3& strides, int bits) {
    constexpr std::int64_t rows_beyond = 16;
    const std::int64_t codes = strides[2] * box.planes(2) + rows_beyond * strides[1];
    return static_cast<std::size_t>(codes * (bits / 8)) + voxel_padding;
}

}  // namespace

void CodeRange::add(const CodeRange& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
    blanks = blanks || other.blanks;
}

CodeGrid::CodeGrid(const Box& box, std::int64_t edge) : edge_(edge) {
    std::int64_t count = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        first_[a] = box.lo[a] / edge;
        counts_[a] = (box.hi[a] - 1) / edge - first_[a] + 1;
        count *= counts_[a];
    }
    ranges_.resize(static_cast<std::size_t>(count));
}

CodeVolume::CodeVolume(const Box& box, int bits)
    : box_(box),
      own_(box),
      bits_(bits),
      strides_(strides_of(box, bits)),
      codes_(bytes_of(box, strides_, bits)) {}

std::size_t CodeVolume::bytes() const {
    return codes_.size() + micro_bricks_.ranges().size_bytes() + std::span(octants_).size_bytes() +
           reaches().size_bytes();
}

std::size_t CodeVolume::offset(const Index3& p) const {
    std::size_t offset = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        offset += static_cast<std::size_t>((p[a] - box_.lo[a]) * strides_[a]);
    }
    return offset;
}

bool CodeVolume::copy(const CodeVolume& from, const Box& box, base::Workers& workers,
                      const std::stop_token& stop) {
    base::check(box_.contains(box) && from.box_.contains(box) && from.bits_ == bits_,
                "codes are copied that both volumes hold");
    const auto code_bytes = static_cast<std::size_t>(bits_ / 8);
    const auto row_of = [&](const CodeVolume& volume, const Index3& p) {
        return static_cast<std::byte*>(volume.codes_.data()) + volume.offset(p) * code_bytes;
    };
    constexpr std::int64_t rows_at_once = 64;
    const std::int64_t pieces = (box.planes(1) + rows_at_once - 1) / rows_at_once;
    return workers.for_each(
        box.planes(2) * pieces,
        [&](std::int64_t piece) {
            const std::int64_t z = box.lo[2] + piece / pieces;
            const std::int64_t first = box.lo[1] + piece % pieces * rows_at_once;
            for (std::int64_t y = first; y < std::min(first + rows_at_once, box.hi[1] + 1); ++y) {
                std::memcpy(row_of(*this, {box.lo[0], y, z}), row_of(from, {box.lo[0], y, z}),
                            static_cast<std::size_t>(box.planes(0)) * code_bytes);
            }
        },
        stop);
}

void CodeVolume::move_planes(std::int64_t first) {
    base::check(first >= box_.lo[2], "planes move towards the first");
    const std::int64_t passed = std::min(first - box_.lo[2], box_.planes(2));
    const auto plane_bytes = static_cast<std::size_t>(strides_[2] * (bits_ / 8));
    auto* const all = static_cast<std::byte*>(codes_.data());
    std::memmove(all, all + static_cast<std::size_t>(passed) * plane_bytes,
                 static_cast<std::size_t>(box_.planes(2) - passed) * plane_bytes);
    box_.hi[2] += first - box_.lo[2];
    box_.lo[2] = first;
}

bool CodeVolume::survey(const Box& own, base::Workers& workers, const std::stop_token& stop) {
    base::check(box_.contains(own), "a volume holds its own nodes");
    own_ = own;
    micro_bricks_ = CodeGrid(own, micro_edge);
    octants_.assign(micro_bricks_.ranges().size(), {});
    reaches_.resize(micro_bricks_.ranges().size());
    const auto over = [&]<class Code>(std::span<const Code> codes) {
        return shear::survey(CodesOfBox<Code>{codes.data(), box_, stride(1), stride(2)}, own,
                             {micro_bricks_, octants_, reaches_}, workers, stop);
    };
    return bits_ == 8 ? over(std::as_const(*this).codes<std::uint8_t>())
                      : over(std::as_const(*this).codes<std::uint16_t>());
}

}  // namespace shearwater::shear
