#include "common/fits/encoding.h"

#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "common/base/check.h"
#include "common/fits/big_endian.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/fits/encoding.cpp"
#include <hwy/foreach_target.h>
// Behind it, once for each target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::fits::HWY_NAMESPACE {

// Decodes whole vectors, and says how many pixels that were; the definition does the rest.
#if HWY_TARGET == HWY_SCALAR

std::size_t decode_vectors(const Encoding&, const char*, float*, std::size_t) {
    return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Doubles = hn::ScalableTag<double>;
using HalfFloats = hn::Half<Floats>;

// As many values of T as there are floats in a vector, their bytes put into the machine's order.
template <class D, class T = hn::TFromD<D>>
hn::VFromD<D> load(D d, const char* from) {
    const hn::Repartition<std::uint8_t, D> bytes;
    const auto stored = hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(from));
    if constexpr (sizeof(T) == 1) {
        return hn::BitCast(d, stored);
    } else {
        const auto order = hn::Xor(hn::Iota(bytes, 0), hn::Set(bytes, sizeof(T) - 1));
        const auto within = hn::And(order, hn::Set(bytes, 15));  // of a block of 16 bytes
        return hn::BitCast(d, hn::TableLookupBytes(stored, within));
    }
}

struct Scaling {
    double scale, zero;
};

hn::VFromD<HalfFloats> narrowed(hn::VFromD<Doubles> value) {
    const Doubles d;
    const auto largest = hn::Set(d, double{std::numeric_limits<float>::max()});
    const auto infinite = hn::CopySign(hn::Inf(d), value);
    return hn::DemoteTo(HalfFloats(), hn::IfThenElse(hn::Gt(hn::Abs(value), largest), infinite, value));
}

hn::VFromD<HalfFloats> scaled(hn::VFromD<Doubles> value, const Scaling& by) {
    const Doubles d;
    return narrowed(hn::Add(hn::Mul(value, hn::Set(d, by.scale)), hn::Set(d, by.zero)));
}

// Of integers of 32 bits or of floats.
template <class D>
hn::VFromD<Floats> scaled_halves(D d, hn::VFromD<D> value, const Scaling& by) {
    const hn::Half<D> half;
    const Doubles wide;
    const auto lower = scaled(hn::PromoteTo(wide, hn::LowerHalf(half, value)), by);
    const auto upper = scaled(hn::PromoteTo(wide, hn::UpperHalf(half, value)), by);
    static_cast<void>(d);
    return hn::Combine(Floats(), upper, lower);
}

template <bool is_scaled>
hn::VFromD<Floats> decode_doubles(const char* from, const Scaling& by) {
    const Doubles d;
    const auto lower = load(d, from);
    const auto upper = load(d, from + hn::Lanes(d) * sizeof(double));
    if constexpr (is_scaled) {
        return hn::Combine(Floats(), scaled(upper, by), scaled(lower, by));
    } else {
        return hn::Combine(Floats(), narrowed(upper), narrowed(lower));
    }
}

template <bool is_scaled>
hn::VFromD<Floats> decode_floats(const char* from, const Scaling& by) {
    const Floats d;
    const auto value = load(d, from);
    if constexpr (is_scaled) {
        return scaled_halves(d, value, by);
    } else {
        return value;
    }
}

template <class T, bool is_scaled>
hn::VFromD<Floats> decode_integers(const char* from, const Scaling& by, std::int32_t blank, bool has_blank) {
    const Floats d;
    const hn::RebindToSigned<Floats> integers;
    const auto stored = [&] {
        const auto loaded = load(hn::Rebind<T, Floats>(), from);
        if constexpr (sizeof(T) == sizeof(std::int32_t)) {
            return loaded;
        } else {
            return hn::PromoteTo(integers, loaded);
        }
    }();
    const auto value = [&] {
        if constexpr (is_scaled) {
            return scaled_halves(integers, stored, by);
        } else {
            return hn::ConvertTo(d, stored);
        }
    }();
    if (!has_blank) {
        return value;
    }
    const auto is_blank = hn::RebindMask(d, hn::Eq(stored, hn::Set(integers, blank)));
    return hn::IfThenElse(is_blank, hn::Set(d, std::numeric_limits<float>::quiet_NaN()), value);
}

template <bool is_scaled>
std::size_t decode_with(const Encoding& encoding, const char* from, float* to, std::size_t count) {
    const Floats d;
    const std::size_t step = hn::Lanes(d);
    const std::size_t bytes = encoding.pixel_bytes();
    const Scaling by{encoding.scale, encoding.zero};
    // A blank that no stored integer can be is none.
    const std::int64_t wanted = encoding.blank.value_or(0);
    const auto blank = static_cast<std::int32_t>(wanted);
    const bool has_blank = encoding.blank && blank == wanted;
    const auto loop = [&](auto&& decode_one) {
        std::size_t i = 0;
        for (; i + step <= count; i += step) {
            hn::StoreU(decode_one(from + i * bytes), d, to + i);
        }
        return i;
    };
    switch (encoding.bitpix) {
        case 8:
            return loop([&](const char* at) {
                return decode_integers<std::uint8_t, is_scaled>(at, by, blank, has_blank);
            });
        case 16:
            return loop([&](const char* at) {
                return decode_integers<std::int16_t, is_scaled>(at, by, blank, has_blank);
            });
        case 32:
            return loop([&](const char* at) {
                return decode_integers<std::int32_t, is_scaled>(at, by, blank, has_blank);
            });
        case -32:
            return loop([&](const char* at) { return decode_floats<is_scaled>(at, by); });
        case -64:
            return loop([&](const char* at) { return decode_doubles<is_scaled>(at, by); });
        default:
            return 0;  // integers of 64 bits are too rare
    }
}

std::size_t decode_vectors(const Encoding& encoding, const char* from, float* to, std::size_t count) {
    return encoding.scaled() ? decode_with<true>(encoding, from, to, count)
                             : decode_with<false>(encoding, from, to, count);
}

#endif

}  // namespace shearwater::fits::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::fits {

float narrowed(double value) {
    constexpr double largest = std::numeric_limits<float>::max();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return value > largest ? infinity : value < -largest ? -infinity : static_cast<float>(value);
}

namespace {

HWY_EXPORT(decode_vectors);

template <class Value>
Value stored_value(const char* from) {
    if constexpr (std::is_integral_v<Value>) {
        return static_cast<Value>(big_endian<Value>(from));
    } else if constexpr (sizeof(Value) == sizeof(float)) {
        return std::bit_cast<float>(static_cast<std::int32_t>(big_endian<std::int32_t>(from)));
    } else {
        return std::bit_cast<double>(big_endian<std::int64_t>(from));
    }
}

template <class Value>
float decoded(const Encoding& encoding, Value stored) {
    if constexpr (std::is_integral_v<Value>) {
        if (encoding.blank == std::int64_t{stored}) {
            return std::numeric_limits<float>::quiet_NaN();
        }
    }
    if constexpr (sizeof(Value) == 8 && std::is_integral_v<Value>) {
        // Unsigned ones are stored as signed ones. In double precision the small of them would be lost.
        if (encoding.scale == 1 && encoding.zero == 0x1p63) {
            return static_cast<float>(static_cast<std::uint64_t>(stored) ^ (std::uint64_t{1} << 63));
        }
    }
    if (encoding.scaled()) {
        return narrowed(static_cast<double>(stored) * encoding.scale + encoding.zero);
    }
    if constexpr (std::is_same_v<Value, double>) {
        return narrowed(stored);
    } else {
        return static_cast<float>(stored);
    }
}

template <class Value>
void decode_each(const Encoding& encoding, const char* from, std::span<float> out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = decoded(encoding, stored_value<Value>(from + i * sizeof(Value)));
    }
}

}  // namespace

void decode_plainly(const Encoding& encoding, std::span<const char> stored, std::span<float> out) {
    base::check(stored.size() == out.size() * encoding.pixel_bytes(), "the bytes of as many pixels");
    switch (encoding.bitpix) {
        case 8:
            return decode_each<std::uint8_t>(encoding, stored.data(), out);
        case 16:
            return decode_each<std::int16_t>(encoding, stored.data(), out);
        case 32:
            return decode_each<std::int32_t>(encoding, stored.data(), out);
        case 64:
            return decode_each<std::int64_t>(encoding, stored.data(), out);
        case -32:
            return decode_each<float>(encoding, stored.data(), out);
        case -64:
            return decode_each<double>(encoding, stored.data(), out);
        default:
            base::check(false, "FITS has six types of pixels");
    }
}

void decode(const Encoding& encoding, std::span<const char> stored, std::span<float> out) {
    base::check(stored.size() == out.size() * encoding.pixel_bytes(), "the bytes of as many pixels");
    const std::size_t done =
        HWY_DYNAMIC_DISPATCH(decode_vectors)(encoding, stored.data(), out.data(), out.size());
    decode_plainly(encoding, stored.subspan(done * encoding.pixel_bytes()), out.subspan(done));
}

}  // namespace shearwater::fits
#endif
