#include "common/volume/histogram.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/volume/histogram.cpp"
#include <hwy/foreach_target.h>
// Behind it, once for each target.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace shearwater::volume::HWY_NAMESPACE {

using Extremes = Histogram::Extremes;

// Keys of as many of the values as whole vectors hold, and says how many those are.
#if HWY_TARGET == HWY_SCALAR

std::size_t find_keys(const float*, std::size_t, std::uint32_t*, Extremes&) {
    return 0;
}

#else

namespace hn = hwy::HWY_NAMESPACE;

std::size_t find_keys(const float* values, std::size_t count, std::uint32_t* keys, Extremes& extremes) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> integers;
    const hn::RebindToUnsigned<decltype(d)> unsigneds;
    const auto infinity = hn::Inf(d);
    auto least = hn::Set(d, extremes.least);
    auto most = hn::Set(d, extremes.most);
    const std::size_t step = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + step <= count; i += step) {
        const auto value = hn::Add(hn::LoadU(d, values + i), hn::Zero(d));
        const auto valid = hn::Lt(hn::Abs(value), infinity);
        least = hn::Min(least, hn::IfThenElse(valid, value, infinity));
        most = hn::Max(most, hn::IfThenElse(valid, value, hn::Neg(infinity)));
        const auto signs = hn::ShiftRight<31>(hn::BitCast(integers, value));
        const auto turned = hn::Or(hn::BitCast(unsigneds, signs), hn::Set(unsigneds, 0x80000000U));
        const auto key =
            hn::ShiftRight<Histogram::dropped_bits>(hn::Xor(hn::BitCast(unsigneds, value), turned));
        const auto is_valid = hn::RebindMask(unsigneds, valid);
        hn::StoreU(hn::IfThenElse(is_valid, key, hn::Set(unsigneds, Histogram::blank_key)), unsigneds,
                   keys + i);
    }
    extremes.least = hn::GetLane(hn::MinOfLanes(d, least));
    extremes.most = hn::GetLane(hn::MaxOfLanes(d, most));
    return i;
}

#endif

}  // namespace shearwater::volume::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace shearwater::volume {

HWY_EXPORT(find_keys);

namespace {

constexpr std::uint32_t sign_bit = 0x80000000U;
constexpr std::uint32_t exponent_bits = 0x7f800000U;

bool finite(float value) {
    return (std::bit_cast<std::uint32_t>(value) & exponent_bits) != exponent_bits;
}

// The bits of a float, turned so that they rise with the value: negative ones all flipped, the others
// moved above them. Adding zero makes -0 into +0.
std::uint32_t ordered_bits(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value + 0.0F);
    return bits ^ ((bits & sign_bit) != 0 ? 0xffffffffU : sign_bit);
}

// The definition of what the vectors do.
std::uint32_t find_key(float value, Histogram::Extremes& extremes) {
    if (!finite(value)) {
        return Histogram::blank_key;
    }
    extremes.least = std::min(extremes.least, value);
    extremes.most = std::max(extremes.most, value);
    return Histogram::key_of(value);
}

}  // namespace

Histogram::Histogram() : counts_(bins, 0) {}

std::uint32_t Histogram::key_of(float value) {
    return ordered_bits(value) >> dropped_bits;
}

double Histogram::lower_edge(std::uint32_t key) {
    const std::uint32_t ordered = key << dropped_bits;
    const std::uint32_t bits = ordered ^ ((ordered & sign_bit) != 0 ? sign_bit : 0xffffffffU);
    const auto value = std::bit_cast<float>(bits);
    if (!finite(value)) {
        return (bits & sign_bit) != 0 ? -0x1p128 : 0x1p128;
    }
    return double{value};
}

void Histogram::add(float value) {
    add(std::span<const float>(&value, 1));
}

void Histogram::add(std::span<const float> values) {
    std::array<std::uint32_t, 512> keys;
    Extremes extremes;
    const std::uint64_t count = values.size();
    while (!values.empty()) {
        const auto part = values.first(std::min(values.size(), keys.size()));
        std::size_t done = HWY_DYNAMIC_DISPATCH(find_keys)(part.data(), part.size(), keys.data(), extremes);
        for (; done < part.size(); ++done) {
            keys[done] = find_key(part[done], extremes);
        }
        for (std::size_t i = 0; i < part.size(); ++i) {
            ++counts_[keys[i]];
        }
        values = values.subspan(part.size());
    }
    const std::uint64_t blank = std::exchange(counts_[blank_key], 0);
    const std::uint64_t valid = count - blank;
    blank_ += blank;
    if (valid != 0) {
        min_ = valid_ == 0 ? extremes.least : std::min(min_, double{extremes.least});
        max_ = valid_ == 0 ? extremes.most : std::max(max_, double{extremes.most});
        min_ += 0.0;
        max_ += 0.0;
        valid_ += valid;
    }
}

void Histogram::merge(const Histogram& other) {
    blank_ += other.blank_;
    if (other.valid_ == 0) {
        return;
    }
    min_ = valid_ == 0 ? other.min_ : std::min(min_, other.min_);
    max_ = valid_ == 0 ? other.max_ : std::max(max_, other.max_);
    valid_ += other.valid_;
    std::transform(counts_.begin(), counts_.end(), other.counts_.begin(), counts_.begin(), std::plus<>());
}

double Histogram::quantile(double fraction) const {
    if (valid_ == 0) {
        return 0;
    }
    const double wanted = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(valid_);
    double below = 0;
    for (std::uint32_t key = key_of(static_cast<float>(min_)); key < bins; ++key) {
        const auto count = static_cast<double>(counts_[key]);
        if (count > 0 && below + count >= wanted) {
            const double first = lower_edge(key);
            // What lies in one bin with zero is zero, as a rule: a share of a float's least would look odd.
            const double share = first == 0 ? 0 : (wanted - below) / count;
            return std::clamp(first + (lower_edge(key + 1) - first) * share, min_, max_);
        }
        below += count;
    }
    return max_;
}

std::vector<Histogram::Bin> Histogram::filled() const {
    std::vector<Bin> result;
    for (std::uint32_t key = 0; key < bins; ++key) {
        if (counts_[key] != 0) {
            result.push_back({key, counts_[key]});
        }
    }
    return result;
}

bool Histogram::merge(std::span<const Bin> filled, std::uint64_t blank, double min, double max) {
    constexpr float largest = std::numeric_limits<float>::max();
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t total = valid_;
    std::uint32_t next = key_of(-largest);
    for (const Bin& bin : filled) {
        if (bin.key < next || bin.key > key_of(largest) || bin.count == 0 || bin.count > most - total) {
            return false;
        }
        next = bin.key + 1;
        total += bin.count;
    }
    if (blank > most - blank_ || !(min <= max) || !(std::fabs(min) <= largest) ||
        !(std::fabs(max) <= largest)) {
        return false;
    }
    if (!filled.empty() && (key_of(static_cast<float>(min)) != filled.front().key ||
                            key_of(static_cast<float>(max)) != filled.back().key)) {
        return false;
    }
    for (const Bin& bin : filled) {
        counts_[bin.key] += bin.count;
    }
    if (!filled.empty()) {
        min_ = valid_ == 0 ? min : std::min(min_, min);
        max_ = valid_ == 0 ? max : std::max(max_, max);
    }
    valid_ = total;
    blank_ += blank;
    return true;
}

Limits percentile_limits(const Histogram& histogram, double percent) {
    if (histogram.valid() == 0) {
        return {0, 1};
    }
    const double cut = (1 - std::clamp(percent, 0.0, 100.0) / 100) / 2;
    return {histogram.quantile(cut), histogram.quantile(1 - cut)};
}

}  // namespace shearwater::volume
#endif
