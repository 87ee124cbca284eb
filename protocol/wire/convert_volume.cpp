// Boxes, lattices, mappings and histograms.

#include <limits>
#include <utility>

#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

pb::Stretch wire_stretch(volume::Stretch stretch) {
    switch (stretch) {
        case volume::Stretch::linear:
            return pb::STRETCH_LINEAR;
        case volume::Stretch::sqrt:
            return pb::STRETCH_SQRT;
        case volume::Stretch::log:
            return pb::STRETCH_LOG;
        case volume::Stretch::asinh:
            break;
    }
    return pb::STRETCH_ASINH;
}

std::optional<volume::Stretch> stretch_from(pb::Stretch stretch) {
    switch (stretch) {
        case pb::STRETCH_LINEAR:
            return volume::Stretch::linear;
        case pb::STRETCH_SQRT:
            return volume::Stretch::sqrt;
        case pb::STRETCH_LOG:
            return volume::Stretch::log;
        case pb::STRETCH_ASINH:
            return volume::Stretch::asinh;
        default:
            return std::nullopt;
    }
}

constexpr std::int64_t max_index = std::int64_t{1} << 40;
// Spacings whose squares and cubes, times any cube's size, are still numbers.
constexpr double min_spacing = 1e-60;
constexpr double max_spacing = 1e60;

void set(pb::Index3& to, const volume::Index3& from) {
    to.set_x(from[0]);
    to.set_y(from[1]);
    to.set_z(from[2]);
}
volume::Index3 index3_from(const pb::Index3& from) {
    return {from.x(), from.y(), from.z()};
}

// Keys as differences, so that neighbouring bins take a byte each.
Parsed<std::vector<volume::Histogram::Bin>> bins_from(const pb::HistogramReport& report) {
    const auto& steps = report.key_steps();
    if (steps.size() != report.counts_size()) {
        return invalid("histogram.counts: as many as keys are wanted");
    }
    if (static_cast<std::size_t>(steps.size()) > volume::Histogram::bins) {
        return invalid("histogram.key_steps: more keys than there are bins");
    }
    std::vector<volume::Histogram::Bin> bins;
    bins.reserve(static_cast<std::size_t>(steps.size()));
    std::uint64_t key = 0;
    std::uint64_t total = 0;
    for (int i = 0; i < steps.size(); ++i) {
        key += steps[i];
        if ((i > 0 && steps[i] == 0) || key >= volume::Histogram::bins) {
            return invalid("histogram.key_steps: keys rise and lie below the number of bins");
        }
        const std::uint64_t count = report.counts(i);
        if (count == 0 || count > std::numeric_limits<std::int64_t>::max() - total) {
            return invalid("histogram.counts: a count is zero or too large");
        }
        total += count;
        bins.push_back({.key = static_cast<std::uint32_t>(key), .count = count});
    }
    if (report.blank() > std::numeric_limits<std::int64_t>::max() - total) {
        return invalid("histogram.blank: too large");
    }
    return bins;
}

}  // namespace

pb::Box to_wire(const volume::Box& box) {
    pb::Box to;
    set(*to.mutable_lo(), box.lo);
    set(*to.mutable_hi(), box.hi);
    return to;
}

Parsed<volume::Box> box_from(const pb::Box& box) {
    const volume::Box from{.lo = index3_from(box.lo()), .hi = index3_from(box.hi())};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (from.lo[axis] < 0 || from.hi[axis] > max_index || from.lo[axis] > from.hi[axis]) {
            return invalid("box: 0 <= lo <= hi <= 2^40 is wanted on every axis");
        }
    }
    if (volume::voxel_count(from.plane_counts()) < 0) {
        return invalid("box: more voxels than can be counted");
    }
    return from;
}

pb::Lattice to_wire(const view::Lattice& lattice) {
    pb::Lattice to;
    set(*to.mutable_n(), lattice.n);
    set(*to.mutable_spacing(), lattice.spacing);
    return to;
}

Parsed<view::Lattice> lattice_from(const pb::Lattice& lattice) {
    const view::Lattice from{.n = index3_from(lattice.n()), .spacing = vec3_from(lattice.spacing())};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (from.n[axis] < 2 || from.n[axis] > max_index) {
            return invalid("lattice.n: 2 to 2^40 voxels are wanted along every axis");
        }
        const double spacing = from.spacing[static_cast<int>(axis)];
        if (!(spacing >= min_spacing && spacing <= max_spacing)) {
            return invalid("lattice.spacing: a number above 0 is wanted on every axis");
        }
    }
    if (volume::voxel_count(from.n) < 0) {
        return invalid("lattice.n: more voxels than can be counted");
    }
    return from;
}

pb::Scaling to_wire(const volume::Scaling& scaling) {
    pb::Scaling to;
    to.set_lo(scaling.lo);
    to.set_hi(scaling.hi);
    to.set_stretch(wire_stretch(scaling.stretch));
    return to;
}

Parsed<volume::Scaling> scaling_from(const pb::Scaling& scaling) {
    const auto stretch = stretch_from(scaling.stretch());
    if (!stretch) {
        return invalid("stretch: unknown");
    }
    const volume::Scaling from{.lo = scaling.lo(), .hi = scaling.hi(), .stretch = *stretch};
    if (!from.valid()) {
        return invalid("limits: finite ones with lo <= hi are wanted");
    }
    return from;
}

pb::Mapping to_wire(const volume::Mapping& mapping) {
    pb::Mapping to;
    to.set_lo(mapping.lo);
    to.set_hi(mapping.hi);
    to.set_stretch(wire_stretch(mapping.stretch));
    to.set_bits(static_cast<std::uint32_t>(mapping.bits));
    return to;
}

Parsed<volume::Mapping> mapping_from(const pb::Mapping& mapping) {
    pb::Scaling same;
    same.set_lo(mapping.lo());
    same.set_hi(mapping.hi());
    same.set_stretch(mapping.stretch());
    const auto scaling = scaling_from(same);
    if (!scaling) {
        return invalid("mapping." + scaling.error().text);
    }
    if (mapping.bits() != 8 && mapping.bits() != 16) {
        return invalid("mapping.bits: 8 or 16 is wanted");
    }
    return volume::Mapping::of(*scaling, static_cast<int>(mapping.bits()));
}

pb::HistogramReport to_wire(const volume::Histogram& histogram) {
    pb::HistogramReport to;
    std::uint32_t previous = 0;
    for (const auto& bin : histogram.filled()) {
        to.add_key_steps(bin.key - previous);
        to.add_counts(bin.count);
        previous = bin.key;
    }
    to.set_blank(histogram.blank());
    to.set_min(histogram.min());
    to.set_max(histogram.max());
    return to;
}

Parsed<volume::Histogram> histogram_from(const pb::HistogramReport& report) {
    const auto bins = bins_from(report);
    if (!bins) {
        return bins.error();
    }
    if (!std::isfinite(report.min()) || !std::isfinite(report.max()) || report.min() > report.max()) {
        return invalid("histogram: finite values with min <= max are wanted");
    }
    volume::Histogram histogram;
    if (!histogram.merge(*bins, report.blank(), report.min(), report.max())) {
        return invalid("histogram: min, max and the bins contradict each other");
    }
    return histogram;
}

pb::ValueSummary to_wire(const volume::Summary& summary) {
    pb::ValueSummary to;
    to.mutable_counts()->Assign(summary.counts.begin(), summary.counts.end());
    to.set_below(summary.below);
    to.set_above(summary.above);
    to.set_blank(summary.blank);
    to.set_min(summary.min);
    to.set_max(summary.max);
    to.set_median(summary.median);
    to.set_sigma(summary.sigma);
    to.mutable_quantiles()->Assign(summary.quantiles.begin(), summary.quantiles.end());
    return to;
}

Parsed<volume::Summary> summary_from(const pb::ValueSummary& summary) {
    if (std::cmp_greater(summary.counts_size(), volume::Summary::max_bins) ||
        std::cmp_greater(summary.quantiles_size(), volume::Summary::quantile_count)) {
        return invalid("values: too many bins or quantiles");
    }
    volume::Summary from{.counts = {summary.counts().begin(), summary.counts().end()},
                         .below = summary.below(),
                         .above = summary.above(),
                         .blank = summary.blank(),
                         .min = summary.min(),
                         .max = summary.max(),
                         .median = summary.median(),
                         .sigma = summary.sigma(),
                         .quantiles = {summary.quantiles().begin(), summary.quantiles().end()}};
    if (const auto status = volume::validate(from); !status) {
        return invalid("values: " + status.error().detail);
    }
    return from;
}

}  // namespace shearwater::wire
