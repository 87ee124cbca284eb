#include "renderer/shear/transpose.h"

#include <algorithm>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/shear/transpose.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/shear/fetching.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Codes of 16 bytes: the rows and columns of a block.
template <class Code>
constexpr int side_of = 16 / static_cast<int>(sizeof(Code));
constexpr int side = side_of<std::uint8_t>;

#if HWY_TARGET == HWY_SCALAR
template <class Code>
HWY_INLINE void turn_block(const Code* from, std::ptrdiff_t stride, int rows, Code* to,
                           std::ptrdiff_t to_stride) {
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < side_of<Code>; ++j) {
            to[j * to_stride + i] = from[i * stride + j];
        }
    }
}
#else
// In every 16 bytes of as many vectors as they have codes rows become columns: each time the first half of
// the vectors is interleaved with the other, the pairs one after the other.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void turn_vectors(D d, V* a) {
    constexpr int vectors = side_of<hn::TFromD<D>>;
    V b[vectors];
    const auto interleave = [&](const V* in, V* out) HWY_ATTR {
        for (int i = 0; i < vectors / 2; ++i) {
            out[2 * i] = hn::InterleaveLower(d, in[i], in[i + vectors / 2]);
            out[2 * i + 1] = hn::InterleaveUpper(d, in[i], in[i + vectors / 2]);
        }
    };
    interleave(a, b);
    interleave(b, a);
    interleave(a, b);
    if constexpr (vectors == 16) {
        interleave(b, a);
    } else {
        static_assert(vectors == 8);
        std::copy_n(b, vectors, a);
    }
}

// Rows of 16 bytes, up to as many as have whole blocks, become columns.
template <class Code>
HWY_INLINE void turn_block(const Code* from, std::ptrdiff_t stride, int rows, Code* to,
                           std::ptrdiff_t to_stride) {
    constexpr int vectors = side_of<Code>;
    const hn::FixedTag<Code, vectors> d;
    using V = hn::Vec<decltype(d)>;
    V a[vectors];
    for (int i = 0; i < vectors; ++i) {
        a[i] = i < rows ? hn::LoadU(d, from + i * stride) : hn::Zero(d);
    }
    turn_vectors(d, a);
    for (int i = 0; i < vectors; ++i) {
        hn::StoreU(a[i], d, to + i * to_stride);
    }
}
#endif

#if HWY_TARGET != HWY_SCALAR && HWY_CAP_GE512
constexpr int line = 64;

// Rows to be fetched, one for each that is turned.
struct NextRows {
    const char* first;
    std::ptrdiff_t stride;
};

// So many blocks of 16 rows of a line: what is adjacent in a column of all of them is written at once. Few
// lines can be on their way before more have to wait: the next are asked for as rows are read, not together.
template <int blocks, bool next_of_two_lines>
HWY_INLINE void turn_lines(const std::uint8_t* from, std::ptrdiff_t stride, std::uint8_t* to,
                           std::ptrdiff_t to_stride, NextRows next) {
    const hn::Full512<std::uint8_t> d;
    using V = hn::Vec<decltype(d)>;
    V a[blocks][side];
    for (int n = 0; n < blocks; ++n) {
        for (int i = 0; i < side; ++i) {
            const char* const row = next.first + (n * side + i) * next.stride;
            __builtin_prefetch(row, 0, 2);
            if constexpr (next_of_two_lines) {
                __builtin_prefetch(row + line, 0, 2);
            }
            a[n][i] = hn::LoadU(d, from + (n * side + i) * stride);
        }
        turn_vectors(d, a[n]);
    }
    // Of column `quarter` * 16 + i a quarter of a[n][i] has what is in block n.
    for (int i = 0; i < side; ++i) {
        const auto at = [&](int quarter) HWY_ATTR { return to + (quarter * side + i) * to_stride; };
        if constexpr (blocks == 1) {
            const auto put = [&](int quarter, __m128i column) HWY_ATTR {
                _mm_storeu_si128(reinterpret_cast<__m128i*>(at(quarter)), column);
            };
            put(0, _mm512_castsi512_si128(a[0][i].raw));
            put(1, _mm512_extracti32x4_epi32(a[0][i].raw, 1));
            put(2, _mm512_extracti32x4_epi32(a[0][i].raw, 2));
            put(3, _mm512_extracti32x4_epi32(a[0][i].raw, 3));
        } else if constexpr (blocks == 2) {
            const auto put = [&](int quarter, __m512i two) HWY_ATTR {
                const auto half = [&](int n, __m256i column) HWY_ATTR {
                    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at(quarter + n)), column);
                };
                half(0, _mm512_castsi512_si256(two));
                half(1, _mm512_extracti64x4_epi64(two, 1));
            };
            const __m512i first = _mm512_shuffle_i32x4(a[0][i].raw, a[1][i].raw, 0x44);
            const __m512i last = _mm512_shuffle_i32x4(a[0][i].raw, a[1][i].raw, 0xee);
            put(0, _mm512_shuffle_i32x4(first, first, 0xd8));
            put(2, _mm512_shuffle_i32x4(last, last, 0xd8));
        } else {
            static_assert(blocks == 4);
            const auto put = [&](int quarter, __m512i above, __m512i below) HWY_ATTR {
                _mm512_storeu_si512(at(quarter), _mm512_shuffle_i32x4(above, below, 0x88));
                _mm512_storeu_si512(at(quarter + 1), _mm512_shuffle_i32x4(above, below, 0xdd));
            };
            put(0, _mm512_shuffle_i32x4(a[0][i].raw, a[1][i].raw, 0x44),
                _mm512_shuffle_i32x4(a[2][i].raw, a[3][i].raw, 0x44));
            put(2, _mm512_shuffle_i32x4(a[0][i].raw, a[1][i].raw, 0xee),
                _mm512_shuffle_i32x4(a[2][i].raw, a[3][i].raw, 0xee));
        }
    }
}

// A line of each of some rows, of 16 at least.
template <bool next_of_two_lines>
HWY_INLINE void turn_column_of_lines(const std::uint8_t* from, std::ptrdiff_t stride, int rows,
                                     std::uint8_t* to, std::ptrdiff_t to_stride, NextRows next) {
    // What is written across two lines of the cache takes twice as long.
    const auto until_line = [&](int row) HWY_ATTR {
        const auto at = static_cast<int>(reinterpret_cast<std::uintptr_t>(to + row) % line);
        return at % side == 0 ? line - at : line;
    };
    for (int row = 0; row < rows;) {
        const int left = std::min(rows - row, until_line(row));
        const int blocks = left >= 4 * side ? 4 : left >= 2 * side ? 2 : 1;
        // The last may lie partly over the one before.
        const int at = std::min(row, rows - blocks * side);
        const auto turn_some = [&](auto count) HWY_ATTR {
            turn_lines<count, next_of_two_lines>(from + at * stride, stride, to + at, to_stride,
                                                 {next.first + at * next.stride, next.stride});
        };
        if (blocks == 4) {
            turn_some(std::integral_constant<int, 4>());
        } else if (blocks == 2) {
            turn_some(std::integral_constant<int, 2>());
        } else {
            turn_some(std::integral_constant<int, 1>());
        }
        row = at + blocks * side;
    }
}
#endif

void turn_8(const Matrix<std::uint8_t>& from, std::uint8_t* to, std::ptrdiff_t column_stride,
            const Ahead& ahead) {
    // A few columns over are moved one by one, as are rows.
    constexpr int few = 4;
    const auto whole_blocks = [](int count) { return (count + side - 1 - few) / side * side; };
    const int block_columns = whole_blocks(from.columns);
    const int block_rows = whole_blocks(from.rows);
    const auto first = [&](int column, int row)
                           HWY_ATTR { return from.first + row * from.row_stride + column; };
    const auto turned = [&](int column, int row) HWY_ATTR { return to + column * column_stride + row; };
    int column = 0;
    bool fetches = true;
#if HWY_TARGET != HWY_SCALAR && HWY_CAP_GE512
    for (; from.rows >= side && column + line <= block_columns; column += line) {
        const int rows = std::min(block_rows, from.rows);
        const auto turn_with = [&](auto two_lines, NextRows next) HWY_ATTR {
            turn_column_of_lines<two_lines>(first(column, 0), from.row_stride, rows, turned(column, 0),
                                            column_stride, next);
        };
        if (!fetches || ahead.lines == 0) {  // what is read next itself
            turn_with(std::false_type(), {reinterpret_cast<const char*>(first(column, 0)), from.row_stride});
        } else if (ahead.lines == 1) {
            turn_with(std::false_type(), {ahead.first, ahead.row_stride});
        } else {
            turn_with(std::true_type(), {ahead.first, ahead.row_stride});
        }
        fetches = false;
    }
#endif
    Fetching fetching(fetches ? ahead : Ahead(), block_rows / side * (block_columns / side));
    for (; column < block_columns; column += side) {
        for (int row = 0; row < block_rows; row += side) {
            fetching.step<Into::second>();
            turn_block(first(column, row), from.row_stride, std::min(side, from.rows - row),
                       turned(column, row), column_stride);
        }
    }
    for (int row = block_rows; row < from.rows; ++row) {
        for (int n = 0; n < block_columns; ++n) {
            *turned(n, row) = *first(n, row);
        }
    }
    for (; column < from.columns; ++column) {
        for (int row = 0; row < from.rows; ++row) {
            *turned(column, row) = *first(column, row);
        }
    }
}

void turn_16(const Matrix<std::uint16_t>& from, std::uint16_t* to, std::ptrdiff_t column_stride,
             const Ahead& ahead) {
    constexpr int edge = side_of<std::uint16_t>;
    const auto blocks = [](int count) { return (count + edge - 1) / edge; };
    Fetching fetching(ahead, blocks(from.rows) * blocks(from.columns));
    for (int column = 0; column < from.columns; column += edge) {
        for (int row = 0; row < from.rows; row += edge) {
            fetching.step<Into::second>();
            turn_block(from.first + row * from.row_stride + column, from.row_stride, from.rows - row,
                       to + column * column_stride + row, column_stride);
        }
    }
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::shear {

HWY_EXPORT(turn_8);
HWY_EXPORT(turn_16);

template <>
void turn(const Matrix<std::uint8_t>& from, std::uint8_t* to, std::ptrdiff_t column_stride,
          const Ahead& ahead) {
    HWY_DYNAMIC_DISPATCH(turn_8)(from, to, column_stride, ahead);
}

template <>
void turn(const Matrix<std::uint16_t>& from, std::uint16_t* to, std::ptrdiff_t column_stride,
          const Ahead& ahead) {
    HWY_DYNAMIC_DISPATCH(turn_16)(from, to, column_stride, ahead);
}

}  // namespace shearwater::shear
#endif
