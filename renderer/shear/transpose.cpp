#include "renderer/shear/transpose.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/shear/transpose.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/shear/fetching.h"

HWY_BEFORE_NAMESPACE();
namespace shearwater::shear::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int side = 16;

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void turn_block(const std::uint8_t* from, std::ptrdiff_t stride, int rows, std::uint8_t* to,
                           std::ptrdiff_t to_stride) {
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < side; ++j) {
            to[j * to_stride + i] = from[i * stride + j];
        }
    }
}
#else
// In every 16 bytes of 16 vectors rows become columns. Four times vectors n and n + 8 are interleaved into 2
// n and 2 n + 1.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void turn_vectors(D d, V* a) {
    V b[side];
    const auto interleave = [&](const V* in, V* out) HWY_ATTR {
        for (int i = 0; i < side / 2; ++i) {
            out[2 * i] = hn::InterleaveLower(d, in[i], in[i + side / 2]);
            out[2 * i + 1] = hn::InterleaveUpper(d, in[i], in[i + side / 2]);
        }
    };
    interleave(a, b);
    interleave(b, a);
    interleave(a, b);
    interleave(b, a);
}

// Up to 16 rows of 16 bytes become 16 columns.
HWY_INLINE void turn_block(const std::uint8_t* from, std::ptrdiff_t stride, int rows, std::uint8_t* to,
                           std::ptrdiff_t to_stride) {
    const hn::FixedTag<std::uint8_t, side> d;
    using V = hn::Vec<decltype(d)>;
    V a[side];
    for (int i = 0; i < side; ++i) {
        a[i] = i < rows ? hn::LoadU(d, from + i * stride) : hn::Zero(d);
    }
    turn_vectors(d, a);
    for (int i = 0; i < side; ++i) {
        hn::StoreU(a[i], d, to + i * to_stride);
    }
}
#endif

// 64 rows at once, a block of 16 in each quarter of a vector.
#if HWY_TARGET != HWY_SCALAR && HWY_CAP_GE512
constexpr int tall = 64;
HWY_INLINE void turn_tall_block(const std::uint8_t* from, std::ptrdiff_t stride, std::uint8_t* to,
                                std::ptrdiff_t to_stride) {
    const hn::Full512<std::uint8_t> d;
    using V = hn::Vec<decltype(d)>;
    V a[side];
    for (int i = 0; i < side; ++i) {
        const auto quarter = [&](int n) HWY_ATTR {
            const std::uint8_t* const row = from + (i + n * side) * stride;
            return _mm_loadu_si128(reinterpret_cast<const __m128i*>(row));
        };
        __m512i rows = _mm512_castsi128_si512(quarter(0));
        rows = _mm512_inserti32x4(rows, quarter(1), 1);
        rows = _mm512_inserti32x4(rows, quarter(2), 2);
        a[i] = V{_mm512_inserti32x4(rows, quarter(3), 3)};
    }
    turn_vectors(d, a);
    for (int i = 0; i < side; ++i) {
        hn::StoreU(a[i], d, to + i * to_stride);
    }
}
#endif

void turn_8(const Matrix<std::uint8_t>& from, std::uint8_t* to, std::ptrdiff_t column_stride,
            const Ahead& ahead) {
    // A few columns over are moved one by one, as are rows.
    constexpr int few = 4;
    const int block_columns = (from.columns + side - 1 - few) / side * side;
    const int block_rows = (from.rows + side - 1 - few) / side * side;
    const auto move = [&](int column, int row) HWY_ATTR {
        to[column * column_stride + row] = from.first[row * from.row_stride + column];
    };
    int row = 0;
#if HWY_TARGET != HWY_SCALAR && HWY_CAP_GE512
    // The last of several blocks lies partly over the one before.
    Fetching fetching(ahead, (from.rows + tall - 1) / tall * (block_columns / side));
    for (; from.rows >= tall && row < from.rows; row += tall) {
        const int first = std::min(row, from.rows - tall);
        for (int column = 0; column < block_columns; column += side) {
            fetching.step<Into::second>();
            turn_tall_block(from.first + first * from.row_stride + column, from.row_stride,
                            to + column * column_stride + first, column_stride);
        }
    }
#else
    Fetching fetching(ahead, block_rows / side * (block_columns / side));
#endif
    for (; row < block_rows; row += side) {
        for (int column = 0; column < block_columns; column += side) {
            fetching.step<Into::second>();
            turn_block(from.first + row * from.row_stride + column, from.row_stride,
                       std::min(side, from.rows - row), to + column * column_stride + row, column_stride);
        }
    }
    for (; row < from.rows; ++row) {
        for (int column = 0; column < from.columns; ++column) {
            move(column, row);
        }
    }
    for (int column = block_columns; column < from.columns; ++column) {
        for (int n = 0; n < from.rows; ++n) {
            move(column, n);
        }
    }
}

}  // namespace shearwater::shear::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::shear {

HWY_EXPORT(turn_8);

template <>
void turn(const Matrix<std::uint8_t>& from, std::uint8_t* to, std::ptrdiff_t column_stride,
          const Ahead& ahead) {
    HWY_DYNAMIC_DISPATCH(turn_8)(from, to, column_stride, ahead);
}

template <>
void turn(const Matrix<std::uint16_t>& from, std::uint16_t* to, std::ptrdiff_t column_stride,
          const Ahead& ahead) {
    Fetching fetching(ahead, from.rows);
    for (int row = 0; row < from.rows; ++row) {
        fetching.step<Into::second>();
        const std::uint16_t* const codes = from.first + row * from.row_stride;
        for (int column = 0; column < from.columns; ++column) {
            to[column * column_stride + row] = codes[column];
        }
    }
}

}  // namespace shearwater::shear
#endif
