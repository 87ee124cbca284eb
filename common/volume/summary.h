#pragma once
// What people are told of a cube's values: a histogram fine enough to draw, and quantiles.

#include <cstdint>
#include <vector>

#include "common/base/result.h"
#include "common/volume/histogram.h"
#include "common/volume/mapping.h"

namespace shearwater::volume {

struct Summary {
    static constexpr std::size_t max_bins = 512;
    static constexpr std::size_t quantile_count = 1001;

    std::vector<std::uint64_t> counts;  // of bins evenly spaced in s, from 0 to 1
    std::uint64_t below = 0, above = 0, blank = 0;
    double min = 0, max = 0;        // of the valid values
    double median = 0, sigma = 0;   // 1.4826 times the median distance from the median
    std::vector<double> quantiles;  // rising: number i is the value with share_of(i) below it

    bool operator==(const Summary&) const = default;

    // No voxel has a value.
    bool empty() const { return quantiles.empty(); }

    // u^3 / (u^3 + (1 - u)^3), u from 0 to 1 in even steps: 0.3 % apart in the middle, and dense enough at
    // the ends to tell the uppermost in 10^9.
    static double share_of(std::size_t quantile);

    // Linear between quantiles. Beyond 0 and 1 shares go on evenly, as far beyond the extremes as these are
    // apart, so that each is the other's inverse where values differ. Not empty.
    double value_at(double share) const;
    double share_below(double value) const;
};

// Of a histogram whose values are mapped so. There are fewer bins where there are few different values.
Summary summarise(const Histogram& histogram, const Mapping& mapping);

// Sizes within their limits, or none of both where it is empty; numbers finite, quantiles rising from min to
// max, counts that can be added up.
base::Status validate(const Summary& summary);

}  // namespace shearwater::volume
