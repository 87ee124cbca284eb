#include "common/volume/quantiser.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "common/base/check.h"

namespace shearwater::volume {

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

template <Stretch stretch>
float approximate(float t) {
    if constexpr (stretch == Stretch::sqrt) {
        return std::sqrt(t);
    } else if constexpr (stretch == Stretch::log) {
        return std::log(1 + 999 * t) * 0.144764827F;  // 1 / (3 ln 10)
    } else if constexpr (stretch == Stretch::asinh) {
        const float u = 10 * t;
        return std::log(u + std::sqrt(u * u + 1)) * 0.333538656F;  // 1 / asinh 10
    } else {
        return t;
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

template <Stretch stretch, class Code>
void Quantiser::run(std::span<const float> values, std::span<Code> out) const {
    const double lo = mapping_.lo;
    // The largest scale stands for a constant cube's: its values guess the first or the last code.
    constexpr double steepest = std::numeric_limits<double>::max();
    const double scale =
        mapping_.lo < mapping_.hi ? std::min(1 / (mapping_.hi - mapping_.lo), steepest) : steepest;
    const int levels = mapping_.levels();
    const auto top = static_cast<float>(levels - 1);
    const float* thresholds = thresholds_.data();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float value = values[i];
        if (!(std::fabs(value) <= largest)) {
            out[i] = 0;
            continue;
        }
        const double t = std::min(std::max((double{value} - lo) * scale, 0.0), 1.0);
        const float guess = approximate<stretch>(static_cast<float>(t)) * top + 1.5F;
        auto code = static_cast<std::uint32_t>(std::min(static_cast<int>(guess), levels));
        while (value < thresholds[code]) {
            --code;
        }
        while (value >= thresholds[code + 1]) {
            ++code;
        }
        out[i] = static_cast<Code>(code);
    }
}

template <class Code>
void Quantiser::dispatch(std::span<const float> values, std::span<Code> out) const {
    base::check(values.size() == out.size(), "one code per value");
    switch (mapping_.stretch) {
        case Stretch::linear:
            return run<Stretch::linear>(values, out);
        case Stretch::sqrt:
            return run<Stretch::sqrt>(values, out);
        case Stretch::log:
            return run<Stretch::log>(values, out);
        case Stretch::asinh:
            return run<Stretch::asinh>(values, out);
    }
}

void Quantiser::codes(std::span<const float> values, std::span<std::uint8_t> out) const {
    base::check(mapping_.bits == 8, "8-bit codes of an 8-bit mapping");
    dispatch(values, out);
}

void Quantiser::codes(std::span<const float> values, std::span<std::uint16_t> out) const {
    dispatch(values, out);
}

}  // namespace shearwater::volume
