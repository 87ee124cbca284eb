#pragma once
// Bricks turned for faces whose principal axis is the one that voxels are adjacent along.

#include <cstddef>
#include <cstdint>

namespace shearwater::shear {

// A part of a stack of `planes` matrices of rows x columns.
template <class Code>
struct Stack {
    const Code* first;
    std::ptrdiff_t row_stride, plane_stride;
    int columns, rows, planes;
};

// Writes the stack with columns outermost and rows innermost: element (column, row, plane) goes to
// to[column * column_stride + plane * plane_stride + row]. Both strides are multiples of 16, and up to 15
// codes behind a row's last may be overwritten, before its own are; of the stack, up to 15 codes behind
// a row's last may be read.
template <class Code>
void turn(const Stack<Code>& from, Code* to, std::ptrdiff_t column_stride, std::ptrdiff_t plane_stride);

}  // namespace shearwater::shear
