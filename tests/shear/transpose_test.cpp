#include "renderer/shear/transpose.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace shearwater::shear {
namespace {

// Every element is where it belongs, and nothing before the first and beyond what may be overwritten is
// touched. The first is so many codes behind where a line of the cache begins.
template <class Code>
void expect_turned(int columns, int rows, int behind_line) {
    constexpr int beyond = 15;
    const std::ptrdiff_t row_stride = columns + beyond + 3;
    const std::ptrdiff_t column_stride = (rows + beyond + 16) / 16 * 16;
    std::mt19937 random(static_cast<unsigned>(columns * 1000 + rows));
    std::vector<Code> matrix(static_cast<std::size_t>(row_stride * rows));
    std::generate(matrix.begin(), matrix.end(), [&] { return static_cast<Code>(random()); });
    constexpr Code untouched = 77;
    constexpr std::ptrdiff_t line = cache_line / static_cast<std::ptrdiff_t>(sizeof(Code));
    const auto count = static_cast<std::size_t>(column_stride * (columns + beyond));
    std::vector<Code> room(count + 3 * line, untouched);
    const auto misaligned = static_cast<std::ptrdiff_t>(reinterpret_cast<std::uintptr_t>(room.data()) %
                                                        cache_line / sizeof(Code));
    const std::span<Code> turned =
        std::span(room).subspan(static_cast<std::size_t>(line - misaligned + behind_line), count);
    turn(Matrix<Code>{matrix.data(), row_stride, columns, rows}, turned.data(), column_stride, Ahead{});
    EXPECT_TRUE(std::all_of(room.data(), turned.data(), [](Code code) { return code == untouched; }));
    EXPECT_EQ(*(turned.data() + turned.size()), untouched);
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            ASSERT_EQ(turned[static_cast<std::size_t>(column * column_stride + row)],
                      matrix[static_cast<std::size_t>(row * row_stride + column)])
                << columns << " x " << rows << ": " << column << ", " << row;
        }
    }
}

TEST(Transpose, TurnsMatricesOfEverySize) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        for (const int columns : {1, 4, 15, 16, 17, 20, 21, 33, 64, 65, 80, 128}) {
            for (const int rows : {1, 12, 13, 16, 31, 33, 48, 63, 64, 65, 80, 112, 127, 130, 192, 200}) {
                for (const int behind_line : {0, 1, 16, 48}) {
                    expect_turned<std::uint8_t>(columns, rows, behind_line);
                }
                expect_turned<std::uint16_t>(columns, rows, 0);
            }
        }
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace shearwater::shear
