#pragma once
// Counts of a cube's values that any division of the cube gives alike: the histograms of disjoint parts
// add up to exactly that of the whole, in any order.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace shearwater::volume {

// Bins follow the floating-point number line: sign, exponent and the first `mantissa_bits` bits of the
// fraction, so that a bin is at most 1/2048 of its value wide over all of single precision, whatever
// outliers there are. Integers below 4096 in size have a bin each.
class Histogram {
  public:
    static constexpr int mantissa_bits = 11;
    static constexpr std::uint32_t bins = 1U << (1 + 8 + mantissa_bits);

    struct Bin {
        std::uint32_t key;  // ordered as the values are
        std::uint64_t count;
        bool operator==(const Bin&) const = default;
    };

    // A key is what remains of a float's bits, ordered as the values are, when so many are dropped.
    static constexpr int dropped_bits = 32 - (1 + 8 + mantissa_bits);
    // Where blank values are counted for a while: a bin of NaN.
    static constexpr std::uint32_t blank_key = bins - 1;
    // The least and the largest of the values that are not blank.
    struct Extremes {
        float least = std::numeric_limits<float>::infinity();
        float most = -std::numeric_limits<float>::infinity();
    };

    Histogram();

    void add(float value);  // NaN and infinities count as blank
    void add(std::span<const float> values);
    void merge(const Histogram& other);

    std::uint64_t valid() const { return valid_; }
    std::uint64_t blank() const { return blank_; }
    double min() const { return min_; }  // of the valid values; 0 when there is none
    double max() const { return max_; }

    // The value below which a share `fraction` in [0, 1] of the valid values lies, interpolated inside
    // its bin (zero's is not divided) and never outside [min, max]; 0 when there is none.
    double quantile(double fraction) const;

    // The bins that are not empty, by rising key; with min, max and blank they are the whole state.
    std::vector<Bin> filled() const;
    // Adds what filled() and the other accessors of another histogram gave. False, and nothing is
    // changed, when a key is out of range or out of order, or min and max contradict the bins.
    bool merge(std::span<const Bin> filled, std::uint64_t blank, double min, double max);

    // The values a bin stands for, [first, second), and the bin of a finite value.
    static double lower_edge(std::uint32_t key);
    static std::uint32_t key_of(float value);

  private:
    std::vector<std::uint64_t> counts_;
    std::uint64_t valid_ = 0;
    std::uint64_t blank_ = 0;
    double min_ = 0;
    double max_ = 0;
};

struct Limits {
    double lo;
    double hi;
};

// The limits that keep the central `percent` of the valid values: (100 - percent) / 2 % are cut from
// either end. {0, 1} when there is no valid value.
Limits percentile_limits(const Histogram& histogram, double percent);

}  // namespace shearwater::volume
