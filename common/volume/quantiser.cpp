#include "common/volume/quantiser.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "common/base/check.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/volume/quantiser.cpp"
#include <hwy/foreach_target.h>
// Behind it, once for each target.
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::volume::HWY_NAMESPACE {

using Guess = Quantiser::Guess;

// Codes of all values, or of none where there are no vectors.
#if HWY_TARGET == HWY_SCALAR

template <class Code>
std::size_t find_codes(const Guess&, const float*, std::size_t, Code*) {
    return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Vector = hn::VFromD<Floats>;

// t of finite values, rounded to single precision at the end only: limits may lie close together.
Vector unit(const Guess& guess, Vector value) {
    const hn::ScalableTag<double> wide;
    const hn::Half<Floats> half;
    const auto lo = hn::Set(wide, guess.lo);
    const auto scale = hn::Set(wide, guess.scale);
    const auto of_half = [&](hn::VFromD<decltype(half)> part) {
        const auto t = hn::Mul(hn::Sub(hn::PromoteTo(wide, part), lo), scale);
        return hn::DemoteTo(half, hn::Min(hn::Max(t, hn::Zero(wide)), hn::Set(wide, 1.0)));
    };
    return hn::Combine(Floats(), of_half(hn::UpperHalf(half, value)), of_half(hn::LowerHalf(half, value)));
}

template <Stretch stretch>
Vector approximate(Vector t) {
    const Floats d;
    const Vector one = hn::Set(d, 1.0F);
    if constexpr (stretch == Stretch::sqrt) {
        return hn::Sqrt(t);
    } else if constexpr (stretch == Stretch::log) {
        const Vector log = hn::Log(d, hn::MulAdd(t, hn::Set(d, 999.0F), one));
        return hn::Mul(log, hn::Set(d, Guess::log_factor));
    } else if constexpr (stretch == Stretch::asinh) {
        const Vector u = hn::Mul(t, hn::Set(d, 10.0F));
        const Vector log = hn::Log(d, hn::Add(u, hn::Sqrt(hn::MulAdd(u, u, one))));
        return hn::Mul(log, hn::Set(d, Guess::asinh_factor));
    } else {
        return t;
    }
}

// The guess lies within half a code of the truth, so that this is the code nearest to it or the one below:
// one threshold tells. It is not even looked up where all guesses are far enough from one.
template <Stretch stretch>
hn::VFromD<hn::RebindToSigned<Floats>> codes_of(const Guess& guess, Vector value) {
    const Floats d;
    const hn::RebindToSigned<Floats> integers;
    const auto finite = hn::Le(hn::Abs(value), hn::Set(d, std::numeric_limits<float>::max()));
    const Vector known = hn::IfThenElseZero(finite, value);
    const Vector s = approximate<stretch>(unit(guess, known));
    const Vector place = hn::MulAdd(s, hn::Set(d, guess.top), hn::Set(d, 1.5F));
    auto code = hn::ConvertTo(integers, hn::Add(place, hn::Set(d, 0.5F)));
    const Vector threshold_place = hn::ConvertTo(d, code);
    const auto far = hn::Gt(hn::Abs(hn::Sub(place, threshold_place)), hn::Set(d, guess.margin));
    auto below = hn::Lt(place, threshold_place);
    if (!hn::AllTrue(d, far)) {
        below = hn::Lt(known, hn::GatherIndex(d, guess.thresholds, code));
    }
    code = hn::Add(code, hn::BitCast(integers, hn::VecFromMask(d, below)));
    return hn::IfThenElseZero(hn::RebindMask(integers, finite), code);
}

template <Stretch stretch, class Code>
std::size_t find_codes_of(const Guess& guess, const float* values, std::size_t count, Code* out) {
    const Floats d;
    const hn::Rebind<Code, Floats> narrow;
    const std::size_t step = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        hn::StoreU(hn::DemoteTo(narrow, codes_of<stretch>(guess, hn::LoadU(d, values + i))), narrow, out + i);
    }
    if (i < count) {
        HWY_ALIGN std::array<float, hn::MaxLanes(d)> rest{};
        HWY_ALIGN std::array<Code, hn::MaxLanes(d)> codes;
        std::copy(values + i, values + count, rest.begin());
        hn::Store(hn::DemoteTo(narrow, codes_of<stretch>(guess, hn::Load(d, rest.data()))), narrow,
                  codes.data());
        std::copy_n(codes.begin(), count - i, out + i);
    }
    return count;
}

template <class Code>
std::size_t find_codes(const Guess& guess, const float* values, std::size_t count, Code* out) {
    switch (guess.stretch) {
        case Stretch::linear:
            return find_codes_of<Stretch::linear>(guess, values, count, out);
        case Stretch::sqrt:
            return find_codes_of<Stretch::sqrt>(guess, values, count, out);
        case Stretch::log:
            return find_codes_of<Stretch::log>(guess, values, count, out);
        case Stretch::asinh:
            return find_codes_of<Stretch::asinh>(guess, values, count, out);
    }
    return 0;
}

#endif

std::size_t find_codes8(const Guess& guess, const float* values, std::size_t count, std::uint8_t* out) {
    return find_codes(guess, values, count, out);
}
std::size_t find_codes16(const Guess& guess, const float* values, std::size_t count, std::uint16_t* out) {
    return find_codes(guess, values, count, out);
}

}  // namespace shearwater::volume::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::volume {

HWY_EXPORT(find_codes8);
HWY_EXPORT(find_codes16);

namespace {

// Integers in the order of the floats they stand for.
std::int64_t rank_of(float value) {
    const auto bits = std::bit_cast<std::int32_t>(value);
    return bits >= 0 ? bits : -std::int64_t{bits & 0x7fffffff};
}

float float_of(std::int64_t rank) {
    const auto magnitude = std::bit_cast<float>(static_cast<std::int32_t>(rank < 0 ? -rank : rank));
    return rank < 0 ? -magnitude : magnitude;
}

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

// The least finite float at or above `from` whose code is `code` or more; infinity when there is none.
float threshold(const Mapping& mapping, int code, float from) {
    std::int64_t below = rank_of(from) - 1;  // known or taken to have a lesser code
    std::int64_t above = rank_of(largest) + 1;
    // Gallop away from the expected place, so that bisection has a short way.
    const double expected = mapping.value_of_s((code - 1.5) / (mapping.levels() - 1));
    const std::int64_t start =
        rank_of(static_cast<float>(std::clamp(expected, -double{largest}, double{largest})));
    const auto reaches = [&](std::int64_t rank) { return mapping.code(float_of(rank)) >= code; };
    for (std::int64_t step = 1; step < above - below; step *= 4) {
        const std::int64_t left = start - step;
        const std::int64_t right = start + step;
        if (left > below && left < above) {
            (reaches(left) ? above : below) = left;
        }
        if (right > below && right < above) {
            (reaches(right) ? above : below) = right;
        }
    }
    while (above - below > 1) {
        const std::int64_t middle = below + (above - below) / 2;
        (reaches(middle) ? above : below) = middle;
    }
    return above > rank_of(largest) ? infinity : float_of(above);
}

float approximate(Stretch stretch, float t) {
    switch (stretch) {
        case Stretch::linear:
            return t;
        case Stretch::sqrt:
            return std::sqrt(t);
        case Stretch::log:
            return std::log(1 + 999 * t) * Quantiser::Guess::log_factor;
        case Stretch::asinh: {
            const float u = 10 * t;
            return std::log(u + std::sqrt(u * u + 1)) * Quantiser::Guess::asinh_factor;
        }
    }
    return t;
}

// The definition: from any guess to the right code, threshold by threshold.
template <class Code>
void find_plainly(const Quantiser::Guess& guess, std::span<const float> values, std::span<Code> out) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float value = values[i];
        if (!(std::fabs(value) <= largest)) {
            out[i] = 0;
            continue;
        }
        const double t = std::clamp((double{value} - guess.lo) * guess.scale, 0.0, 1.0);
        const float place = approximate(guess.stretch, static_cast<float>(t)) * guess.top + 1.5F;
        auto code = static_cast<std::uint32_t>(std::min(place, guess.top + 1));
        while (value < guess.thresholds[code]) {
            --code;
        }
        while (value >= guess.thresholds[code + 1]) {
            ++code;
        }
        out[i] = static_cast<Code>(code);
    }
}

}  // namespace

Quantiser::Quantiser(const Mapping& mapping) : mapping_(mapping) {
    base::check(mapping.bits == 8 || mapping.bits == 16, "a mapping has 8 or 16 bits");
    const int levels = mapping.levels();
    thresholds_.resize(static_cast<std::size_t>(levels) + 2, -infinity);
    float from = -largest;
    for (int code = 2; code <= levels && from < infinity; ++code) {
        from = threshold(mapping_, code, from);
        thresholds_[static_cast<std::size_t>(code)] = from;
    }
    std::replace(thresholds_.begin() + 2, thresholds_.end(), -infinity, infinity);
}

Quantiser::Guess Quantiser::guess() const {
    constexpr double steepest = std::numeric_limits<double>::max();
    const double scale = mapping_.lo < mapping_.hi ? 1 / (mapping_.hi - mapping_.lo) : steepest;
    return {.stretch = mapping_.stretch,
            .lo = mapping_.lo,
            .scale = std::min(scale, steepest),
            .top = static_cast<float>(mapping_.levels() - 1),
            // Several times what single precision can be wrong by, in codes.
            .margin = mapping_.bits == 8 ? 0x1p-10F : 0x1p-4F,
            .good = scale < steepest,
            .thresholds = thresholds_.data()};
}

void Quantiser::codes(std::span<const float> values, std::span<std::uint8_t> out) const {
    base::check(values.size() == out.size(), "one code per value");
    base::check(mapping_.bits == 8, "8-bit codes of an 8-bit mapping");
    const Guess by = guess();
    const std::size_t done =
        by.good ? HWY_DYNAMIC_DISPATCH(find_codes8)(by, values.data(), values.size(), out.data()) : 0;
    find_plainly(by, values.subspan(done), out.subspan(done));
}

void Quantiser::codes(std::span<const float> values, std::span<std::uint16_t> out) const {
    base::check(values.size() == out.size(), "one code per value");
    const Guess by = guess();
    const std::size_t done =
        by.good ? HWY_DYNAMIC_DISPATCH(find_codes16)(by, values.data(), values.size(), out.data()) : 0;
    find_plainly(by, values.subspan(done), out.subspan(done));
}

}  // namespace shearwater::volume
#endif
