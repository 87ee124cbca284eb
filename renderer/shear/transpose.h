#pragma once
// Bricks turned for faces whose principal axis is the one that voxels are adjacent along.

#include <cstddef>
#include <cstdint>

#include "renderer/shear/kernel.h"

namespace shearwater::shear {

// A part of a matrix.
template <class Code>
struct Matrix {
    const Code* first;
    std::ptrdiff_t row_stride;
    int columns, rows;
};

// Writes its transpose: element (column, row) goes to to[column * column_stride + row]. The stride is a
// multiple of 16, and up to 15 codes behind a column's last may be overwritten, before its own are, and up to
// 15 columns behind the last; of the matrix, up to 15 codes behind a row's last may be read. Fetches what is
// ahead meanwhile: as many rows of one plane, of a line or two.
template <class Code>
void turn(const Matrix<Code>& from, Code* to, std::ptrdiff_t column_stride, const Ahead& ahead);

}  // namespace shearwater::shear
