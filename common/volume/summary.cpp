#include "common/volume/summary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace shearwater::volume {

namespace {

constexpr double robust_sigma = 1.4826;  // of a normal distribution, per median distance from the median

// How many of a histogram's values lie below another, and the way back. Values are taken to lie evenly in
// their bins, except in zero's, which as a rule is of zeros.
class Cumulative {
  public:
    explicit Cumulative(const Histogram& histogram) {
        std::uint64_t total = 0;
        for (const Histogram::Bin& bin : histogram.filled()) {
            const double from = std::max(Histogram::lower_edge(bin.key), histogram.min());
            const double to = from == 0 ? 0 : std::min(Histogram::lower_edge(bin.key + 1), histogram.max());
            total += bin.count;
            bins_.push_back({from, std::max(from, to), total});
        }
    }

    std::size_t bins() const { return bins_.size(); }
    double total() const { return static_cast<double>(bins_.back().up_to); }

    double below(double value) const { return count(value, value); }
    // With all of a bin that begins at the value: as a rule these have no other.
    double up_to(double value) const {
        return count(value, std::nextafter(value, std::numeric_limits<double>::infinity()));
    }

    double value_at(double share) const {
        const double wanted = share * total();
        const auto bin = std::lower_bound(bins_.begin(), bins_.end() - 1, wanted, [](const Bin& b, double w) {
            return static_cast<double>(b.up_to) < w;
        });
        const double before = before_bin(bin);
        const double part = (wanted - before) / (static_cast<double>(bin->up_to) - before);
        return bin->from + (bin->to - bin->from) * std::clamp(part, 0.0, 1.0);
    }

    // The distance from `middle` within which half of the values lie.
    double half_width(double middle) const {
        if (up_to(middle) - below(middle) >= total() / 2) {
            return 0;
        }
        double least = 0, most = std::max(middle - bins_.front().from, bins_.back().to - middle);
        for (int i = 0; i < 64; ++i) {
            const double width = least + (most - least) / 2;
            (up_to(middle + width) - below(middle - width) >= total() / 2 ? most : least) = width;
        }
        return most;
    }

  private:
    struct Bin {
        double from, to;
        std::uint64_t up_to;  // values in this bin and those before
    };

    double before_bin(std::vector<Bin>::const_iterator bin) const {
        return bin == bins_.begin() ? 0 : static_cast<double>((bin - 1)->up_to);
    }

    // Those below the value; of a bin that begins there all, where it counts as begun.
    double count(double value, double begins_below) const {
        const auto after = std::lower_bound(bins_.begin(), bins_.end(), begins_below,
                                            [](const Bin& b, double v) { return b.from < v; });
        if (after == bins_.begin()) {
            return 0;
        }
        const auto bin = after - 1;
        const double before = before_bin(bin);
        const double share =
            bin->from >= value || bin->to <= value ? 1 : (value - bin->from) / (bin->to - bin->from);
        return before + (static_cast<double>(bin->up_to) - before) * share;
    }

    std::vector<Bin> bins_;
};

// As many as there are values to tell apart between the limits: more would leave gaps between.
std::size_t bins_for(const Histogram& histogram, const Mapping& mapping) {
    const std::uint32_t from = Histogram::key_of(static_cast<float>(mapping.lo));
    const std::uint32_t to = Histogram::key_of(static_cast<float>(mapping.hi));
    std::size_t different = 0;
    for (const Histogram::Bin& bin : histogram.filled()) {
        different += bin.key >= from && bin.key <= to ? 1 : 0;
    }
    return std::clamp<std::size_t>(std::bit_floor(different), 16, Summary::max_bins);
}

base::Status refuse(const char* why) {
    return base::error(base::Code::invalid_argument, "use a summary of values", why);
}

}  // namespace

double Summary::share_of(std::size_t quantile) {
    const double u = static_cast<double>(quantile) / (quantile_count - 1);
    const double low = u * u * u, high = (1 - u) * (1 - u) * (1 - u);
    return low / (low + high);
}

double Summary::value_at(double share) const {
    const double width = max > min ? max - min : 1;
    if (!(share > 0)) {
        return min + share * width;
    }
    if (share >= 1) {
        return max + (share - 1) * width;
    }
    const double odds = std::cbrt(share / (1 - share));
    const double u = odds / (1 + odds) * (quantile_count - 1);
    auto i = std::min(static_cast<std::size_t>(u), quantile_count - 2);
    // The root is rounded.
    i -= i > 0 && share_of(i) > share ? 1 : 0;
    i += i < quantile_count - 2 && share_of(i + 1) <= share ? 1 : 0;
    const double part = (share - share_of(i)) / (share_of(i + 1) - share_of(i));
    return quantiles[i] + (quantiles[i + 1] - quantiles[i]) * part;
}

double Summary::share_below(double value) const {
    const double width = max > min ? max - min : 1;
    if (value < min) {
        return (value - min) / width;
    }
    if (value >= max) {
        return 1 + (value - max) / width;
    }
    const auto next = std::upper_bound(quantiles.begin(), quantiles.end(), value);
    if (next == quantiles.begin() || next == quantiles.end()) {
        return next == quantiles.begin() ? 0 : 1;
    }
    const auto i = static_cast<std::size_t>(next - quantiles.begin() - 1);
    const double part = (value - quantiles[i]) / (quantiles[i + 1] - quantiles[i]);
    return share_of(i) + (share_of(i + 1) - share_of(i)) * part;
}

Summary summarise(const Histogram& histogram, const Mapping& mapping) {
    Summary summary;
    summary.blank = histogram.blank();
    if (histogram.valid() == 0) {
        return summary;
    }
    const Cumulative all(histogram);
    summary.min = histogram.min();
    summary.max = histogram.max();
    summary.median = all.value_at(0.5);
    summary.sigma = robust_sigma * all.half_width(summary.median);
    for (std::size_t i = 0; i < Summary::quantile_count; ++i) {
        summary.quantiles.push_back(all.value_at(Summary::share_of(i)));
    }
    const std::size_t bins = bins_for(histogram, mapping);
    const auto whole = [](double count) { return static_cast<std::uint64_t>(std::llround(count)); };
    std::uint64_t before = summary.below = whole(all.below(mapping.lo));
    for (std::size_t i = 1; i <= bins; ++i) {
        const std::uint64_t up_to =
            i < bins
                ? whole(all.below(mapping.value_of_s(static_cast<double>(i) / static_cast<double>(bins))))
                : whole(all.up_to(mapping.hi));
        summary.counts.push_back(std::max(up_to, before) - before);
        before = std::max(up_to, before);
    }
    summary.above = histogram.valid() - before;
    return summary;
}

base::Status validate(const Summary& summary) {
    if (summary.counts.size() > Summary::max_bins) {
        return refuse("too many bins");
    }
    if (summary.quantiles.size() != (summary.counts.empty() ? 0 : Summary::quantile_count)) {
        return refuse("the number of quantiles is not what it should be");
    }
    std::uint64_t room = std::numeric_limits<std::int64_t>::max();
    const auto fits = [&](std::uint64_t count) {
        const bool good = count <= room;
        room -= good ? count : 0;
        return good;
    };
    if (!fits(summary.below) || !fits(summary.above) || !fits(summary.blank) ||
        !std::all_of(summary.counts.begin(), summary.counts.end(), fits)) {
        return refuse("more voxels than can be counted");
    }
    if (!std::isfinite(summary.max - summary.min) || !std::isfinite(summary.sigma) || summary.sigma < 0 ||
        !(summary.min <= summary.median && summary.median <= summary.max)) {
        return refuse("finite numbers with min <= median <= max are wanted");
    }
    double last = summary.min;
    for (const double quantile : summary.quantiles) {
        if (!(last <= quantile && quantile <= summary.max)) {
            return refuse("quantiles must rise from min to max");
        }
        last = quantile;
    }
    return {};
}

}  // namespace shearwater::volume
