#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "protocol/wire/convert.h"
#include "tests/wire/examples.h"

namespace shearwater::wire {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t max_index = std::int64_t{1} << 40;

template <class T>
void expect_invalid(const Parsed<T>& parsed, std::string_view field) {
    ASSERT_FALSE(parsed) << field;
    EXPECT_EQ(parsed.error().reason, pb::REASON_INVALID);
    EXPECT_NE(parsed.error().text.find(field), std::string::npos) << parsed.error().text;
}

TEST(BoxConversion, ThereAndBack) {
    for (const volume::Box& box : {volume::Box{{0, 0, 0}, {1, 2, 3}}, volume::Box{{5, 6, 7}, {5, 6, 7}},
                                   volume::Box{{0, 0, 0}, {max_index, 10, 10}}}) {
        EXPECT_EQ(box_from(to_wire(box)).value(), box);
    }
}

TEST(BoxConversion, Hostile) {
    const auto with = [](std::int64_t lo, std::int64_t hi) {
        std::vector<pb::Box> boxes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            volume::Box box{{0, 0, 0}, {4, 4, 4}};
            box.lo[axis] = lo;
            box.hi[axis] = hi;
            boxes.push_back(to_wire(box));
        }
        return boxes;
    };
    constexpr auto lowest = std::numeric_limits<std::int64_t>::min();
    constexpr auto highest = std::numeric_limits<std::int64_t>::max();
    for (const auto& [lo, hi] : {std::pair{-1L, 4L},
                                 {5L, 4L},
                                 {0L, max_index + 1},
                                 {lowest, highest},
                                 {lowest, 0L},
                                 {0L, highest},
                                 {highest, highest}}) {
        for (const pb::Box& box : with(lo, hi)) {
            expect_invalid(box_from(box), "box");
        }
    }
    // Each index is in range; the product of the three is not.
    expect_invalid(box_from(to_wire(volume::Box{{0, 0, 0}, {max_index, max_index, max_index}})), "box");
}

TEST(LatticeConversion, ThereAndBack) {
    const view::Lattice lattice{{2, 100, max_index}, {1, 1e-6, 1e9}};
    const view::Lattice back = lattice_from(to_wire(lattice)).value();
    EXPECT_EQ(back.n, lattice.n);
    EXPECT_EQ(back.spacing, lattice.spacing);
}

TEST(LatticeConversion, Hostile) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::int64_t n : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-5}, max_index + 1,
                                     std::numeric_limits<std::int64_t>::max()}) {
            view::Lattice lattice{{4, 4, 4}, {1, 1, 1}};
            lattice.n[axis] = n;
            expect_invalid(lattice_from(to_wire(lattice)), "lattice.n");
        }
        for (const double spacing : {0.0, -1.0, nan, inf, -inf, 1e-300, 1e300}) {
            view::Lattice lattice{{4, 4, 4}, {1, 1, 1}};
            lattice.spacing[static_cast<int>(axis)] = spacing;
            expect_invalid(lattice_from(to_wire(lattice)), "lattice.spacing");
        }
    }
    expect_invalid(lattice_from(to_wire(view::Lattice{{max_index, max_index, 4}, {1, 1, 1}})), "lattice.n");
    expect_invalid(lattice_from(pb::Lattice()), "lattice.n");
}

TEST(MappingConversion, ThereAndBack) {
    using volume::Stretch;
    for (const Stretch stretch : {Stretch::linear, Stretch::sqrt, Stretch::log, Stretch::asinh}) {
        for (const int bits : {8, 16}) {
            const volume::Mapping mapping{.lo = -1.5, .hi = 3e9, .stretch = stretch, .bits = bits};
            EXPECT_EQ(mapping_from(to_wire(mapping)).value(), mapping);
        }
    }
    const volume::Mapping constant{.lo = 5, .hi = 5};
    EXPECT_EQ(mapping_from(to_wire(constant)).value(), constant);
}

TEST(MappingConversion, Hostile) {
    const pb::Mapping good = to_wire(volume::Mapping{});
    constexpr double largest = std::numeric_limits<double>::max();
    for (const auto& [lo, hi] :
         {std::pair{1.0, 0.0}, {nan, 1.0}, {0.0, nan}, {-inf, 0.0}, {0.0, inf}, {-largest, largest}}) {
        pb::Mapping mapping = good;
        mapping.set_lo(lo);
        mapping.set_hi(hi);
        expect_invalid(mapping_from(mapping), "mapping");
    }
    for (const int stretch : {-1, 4, 1000}) {
        pb::Mapping mapping = good;
        mapping.set_stretch(static_cast<pb::Stretch>(stretch));
        expect_invalid(mapping_from(mapping), "mapping.stretch");
    }
    for (const std::uint32_t bits : {0U, 7U, 9U, 32U, 0xFFFFFFFFU}) {
        pb::Mapping mapping = good;
        mapping.set_bits(bits);
        expect_invalid(mapping_from(mapping), "mapping.bits");
    }
    expect_invalid(mapping_from(pb::Mapping()), "mapping.bits");
}

volume::Histogram histogram() {
    volume::Histogram h;
    for (int i = 0; i < 5000; ++i) {
        h.add(std::sin(static_cast<float>(i)) * static_cast<float>(i));
    }
    h.add(std::numeric_limits<float>::quiet_NaN());
    h.add(std::numeric_limits<float>::max());
    h.add(-std::numeric_limits<float>::max());
    h.add(0.0F);
    return h;
}

TEST(HistogramConversion, ThereAndBack) {
    for (const volume::Histogram& h : {histogram(), volume::Histogram()}) {
        const volume::Histogram back = histogram_from(to_wire(h)).value();
        EXPECT_EQ(back.filled(), h.filled());
        EXPECT_EQ(back.valid(), h.valid());
        EXPECT_EQ(back.blank(), h.blank());
        EXPECT_EQ(back.min(), h.min());
        EXPECT_EQ(back.max(), h.max());
    }
}

TEST(HistogramConversion, AFullOneKeepsItsLimit) {
    pb::HistogramReport report;
    for (std::uint32_t i = 0; i < volume::Histogram::bins; ++i) {
        report.add_key_steps(1);
        report.add_counts(std::uint64_t{1} << 40);
    }
    EXPECT_LT(report.ByteSizeLong(), limit_of(type_of(message(report).body))->body);
}

TEST(HistogramConversion, Hostile) {
    const pb::HistogramReport good = to_wire(histogram());
    pb::HistogramReport report = good;
    report.add_counts(1);
    expect_invalid(histogram_from(report), "histogram.counts");

    report = good;
    report.set_key_steps(3, 0);
    expect_invalid(histogram_from(report), "histogram.key_steps");
    report = good;
    report.set_key_steps(3, 0xFFFFFFFF);
    expect_invalid(histogram_from(report), "histogram.key_steps");
    report = good;
    report.set_key_steps(0, volume::Histogram::bins);
    expect_invalid(histogram_from(report), "histogram.key_steps");

    for (const std::uint64_t count : {std::uint64_t{0}, std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
        report = good;
        report.set_counts(2, count);
        expect_invalid(histogram_from(report), "histogram.counts");
    }
    report = good;
    report.set_counts(0, std::uint64_t{1} << 62);
    report.set_counts(1, std::uint64_t{1} << 62);
    expect_invalid(histogram_from(report), "histogram.counts");
    report = good;
    report.set_blank(~std::uint64_t{0});
    expect_invalid(histogram_from(report), "histogram.blank");

    for (const double value : {nan, inf, -inf}) {
        report = good;
        report.set_min(value);
        expect_invalid(histogram_from(report), "histogram");
        report = good;
        report.set_max(value);
        expect_invalid(histogram_from(report), "histogram");
    }
    report = good;
    report.set_min(0);
    expect_invalid(histogram_from(report), "contradict");

    pb::HistogramReport many;
    for (std::uint32_t i = 0; i <= volume::Histogram::bins; ++i) {
        many.add_key_steps(1);
        many.add_counts(1);
    }
    expect_invalid(histogram_from(many), "histogram.key_steps");
}

TEST(SummaryConversion, ThereAndBack) {
    const volume::Summary summary = test::summary();
    EXPECT_EQ(summary_from(to_wire(summary)).value(), summary);
    EXPECT_TRUE(summary_from(pb::ValueSummary{}).value().empty()) << "of a cube that is blank";
}

TEST(SummaryConversion, ALargestOneKeepsItsLimit) {
    volume::Summary summary = test::summary();
    summary.counts.assign(volume::Summary::max_bins, std::uint64_t{1} << 52);
    pb::CubeDescription description;
    *description.mutable_values() = to_wire(summary);
    ASSERT_TRUE(summary_from(description.values()));
    EXPECT_LT(description.ByteSizeLong(), limit_of(type_of(message(description).body))->body / 8);
}

TEST(SummaryConversion, Hostile) {
    const auto refused = [](const char* what, const auto& change) {
        pb::ValueSummary summary = to_wire(test::summary());
        change(summary);
        const auto from = summary_from(summary);
        ASSERT_FALSE(from) << what;
        EXPECT_EQ(from.error().reason, pb::REASON_INVALID);
        EXPECT_EQ(from.error().text.find("values: "), 0U) << from.error().text;
    };
    refused("bins", [](auto& s) { s.mutable_counts()->Resize(513, 1); });
    refused("no bins", [](auto& s) { s.clear_counts(); });
    refused("quantiles", [](auto& s) { s.add_quantiles(4); });
    refused("no quantiles", [](auto& s) { s.clear_quantiles(); });
    refused("counts", [](auto& s) { s.set_counts(0, ~std::uint64_t{0}); });
    refused("below", [](auto& s) { s.set_below(std::uint64_t{1} << 63); });
    refused("blank", [](auto& s) { s.set_blank(~std::uint64_t{0}); });
    for (const double value : {nan, inf, -inf}) {
        refused("min", [&](auto& s) { s.set_min(value); });
        refused("max", [&](auto& s) { s.set_max(value); });
        refused("median", [&](auto& s) { s.set_median(value); });
        refused("sigma", [&](auto& s) { s.set_sigma(value); });
        refused("quantile", [&](auto& s) { s.set_quantiles(500, value); });
    }
    refused("falling", [](auto& s) { s.set_quantiles(500, -2); });
    refused("outside", [](auto& s) { s.set_quantiles(1000, 5); });
    refused("a negative sigma", [](auto& s) { s.set_sigma(-0.1); });
}

}  // namespace
}  // namespace shearwater::wire
