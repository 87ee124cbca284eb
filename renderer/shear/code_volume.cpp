#include "renderer/shear/code_volume.h"

#include <algorithm>

#include "common/base/check.h"
#include "renderer/shear/survey.h"
#include "renderer/shear/transpose.h"

namespace shearwater::shear {

using volume::Box;
using volume::Index3;

namespace {

// Of a plane across axis 2: rows of one along axis 0 become those of the other along axis 1.
template <class Code>
void turn_plane(const CodeArray& from, CodeArray& to, std::int64_t plane) {
    // Whole blocks first: of these nothing is written or read beyond the last.
    constexpr int block = 16;
    const Box& box = from.box();
    const Index3 first{box.lo[0], box.lo[1], plane};
    const auto across = static_cast<int>(box.planes(0)), down = static_cast<int>(box.planes(1));
    const int columns = across / block * block, rows = down / block * block;
    const Code* const source = &from.codes<Code>()[from.offset(first)];
    Code* const turned = &to.codes<Code>()[to.offset(first)];
    turn(Matrix<Code>{.first = source, .row_stride = from.stride(1), .columns = columns, .rows = rows},
         turned, to.stride(0), {});
    const auto turn_rest = [&](int first_column, int first_row, int end_column, int end_row) {
        for (int column = first_column; column < end_column; ++column) {
            for (int row = first_row; row < end_row; ++row) {
                turned[column * to.stride(0) + row] = source[row * from.stride(1) + column];
            }
        }
    };
    turn_rest(0, rows, columns, down);
    turn_rest(columns, 0, across, down);
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

CodeVolume::CodeVolume(const Box& box, int bits) : own_(box), bits_(bits), codes_(box, bits, {0, 1, 2}) {}

std::size_t CodeVolume::bytes() const {
    return codes_.bytes() + (turned_ ? turned_->bytes() : 0) + micro_bricks_.ranges().size_bytes() +
           std::span(octants_).size_bytes() + reaches().size_bytes();
}

bool CodeVolume::keep_turned(base::Workers& workers, const std::stop_token& stop) {
    turned_.emplace(box(), bits_, std::array{1, 2, 0});
    return workers.for_each(
        box().planes(2),
        [&](std::int64_t n) {
            const std::int64_t plane = box().lo[2] + n;
            bits_ == 8 ? turn_plane<std::uint8_t>(codes_, *turned_, plane)
                       : turn_plane<std::uint16_t>(codes_, *turned_, plane);
        },
        stop);
}

bool CodeVolume::copy(const CodeVolume& from, const Box& box, base::Workers& workers,
                      const std::stop_token& stop) {
    base::check(this->box().contains(box) && from.box().contains(box) && from.bits_ == bits_,
                "codes are copied that both volumes hold");
    const auto code_bytes = static_cast<std::size_t>(bits_ / 8);
    const auto offset_in = [&](const CodeVolume& volume, const Index3& p) {
        return volume.offset(p) * code_bytes;
    };
    const auto to_bytes = codes_.codes<std::byte>();
    const auto from_bytes = from.codes<std::byte>();
    const std::size_t row_bytes = static_cast<std::size_t>(box.planes(0)) * code_bytes;
    constexpr std::int64_t rows_at_once = 64;
    const std::int64_t pieces = (box.planes(1) + rows_at_once - 1) / rows_at_once;
    return workers.for_each(
        box.planes(2) * pieces,
        [&](std::int64_t piece) {
            const std::int64_t z = box.lo[2] + piece / pieces;
            const std::int64_t first = box.lo[1] + piece % pieces * rows_at_once;
            for (std::int64_t y = first; y < std::min(first + rows_at_once, box.hi[1] + 1); ++y) {
                const Index3 row{box.lo[0], y, z};
                std::ranges::copy(from_bytes.subspan(offset_in(from, row), row_bytes),
                                  to_bytes.subspan(offset_in(*this, row)).begin());
            }
        },
        stop);
}

bool CodeVolume::survey(const Box& own, base::Workers& workers, const std::stop_token& stop) {
    base::check(box().contains(own), "a volume holds its own nodes");
    own_ = own;
    micro_bricks_ = CodeGrid(own, micro_edge);
    octants_.assign(micro_bricks_.ranges().size(), {});
    reaches_.resize(micro_bricks_.ranges().size());
    const auto over = [&]<class Code>(std::span<const Code> codes) {
        return shear::survey(CodesOfBox<Code>{codes.data(), box(), stride(1), stride(2)}, own,
                             {micro_bricks_, octants_, reaches_}, workers, stop);
    };
    return bits_ == 8 ? over(std::as_const(*this).codes<std::uint8_t>())
                      : over(std::as_const(*this).codes<std::uint16_t>());
}

}  // namespace shearwater::shear
