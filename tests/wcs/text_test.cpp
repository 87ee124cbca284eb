// World values as text.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "common/wcs/text.h"

namespace shearwater::wcs {
namespace {

const Axis ra{
    .name = "right ascension", .label = "RA", .unit = "deg", .notation = Notation::hours, .circle = true};
const Axis dec{.name = "declination", .label = "Dec", .unit = "deg", .notation = Notation::degrees};
const Axis glon{.name = "galactic longitude", .label = "GLon", .unit = "deg", .circle = true};
const Axis velocity{.name = "velocity", .label = "Vel", .unit = "km/s"};

TEST(WorldText, RightAscension) {
    constexpr double second = 1.0 / 240;
    for (const auto& [value, resolution, text] : {std::tuple(0.0, 15.0, "00h"),
                                                  {308.717916667, 15, "21h"},
                                                  {308.717916667, 0.25, "20h35m"},
                                                  {308.717916667, second, "20h34m52s"},
                                                  {308.717916667, 0.1 * second, "20h34m52.3s"},
                                                  {308.717916667, 0.07 * second, "20h34m52.30s"},
                                                  {359.99999, second, "00h00m00s"},
                                                  {359.99, 15, "00h"},
                                                  {-15.0, 15, "23h"},
                                                  {375.0, second, "01h00m00s"},
                                                  {14.999999999, second, "01h00m00s"},
                                                  {14.9999, 0.001 * second, "00h59m59.976s"}}) {
        EXPECT_EQ(number_text(ra, value, resolution), text) << value << " " << resolution;
    }
}

TEST(WorldText, Declination) {
    constexpr double second = 1.0 / 3600;
    for (const auto& [value, resolution, text] : {std::tuple(60.153888, 1.0, "+60\u00b0"),
                                                  {60.153888, second, "+60\u00b009'14\""},
                                                  {-0.5, 0.5, "-00\u00b030'"},
                                                  {-0.00001, second, "+00\u00b000'00\""},
                                                  {-61.8404527, 0.1 * second, "-61\u00b050'25.6\""},
                                                  {9.99999, second, "+10\u00b000'00\""}}) {
        EXPECT_EQ(number_text(dec, value, resolution), text) << value << " " << resolution;
    }
}

TEST(WorldText, PlainNumbers) {
    for (const auto& [value, resolution, text] : {std::tuple(42.0, 1.0, "42"),
                                                  {42.25, 0.5, "42.2"},
                                                  {-0.01, 0.1, "0.0"},
                                                  {1.42040575, 0.0005, "1.4204"},
                                                  {-1200.0, 200.0, "-1200"},
                                                  {3e12, 1e11, "3e+12"},
                                                  {1.25e-9, 5e-11, "1.25e-09"},
                                                  {0.0, 1e-12, "0"}}) {
        EXPECT_EQ(number_text(velocity, value, resolution), text) << value << " " << resolution;
    }
    EXPECT_EQ(number_text(glon, 359.5, 0.5), "359.5\u00b0");
    EXPECT_EQ(number_text(glon, 359.99, 0.5), "0.0\u00b0");
    EXPECT_EQ(number_text(glon, -2, 1), "358\u00b0");
    EXPECT_EQ(value_text(velocity, 42, 1), "42 km/s");
    EXPECT_EQ(value_text(glon, 42, 1), "42\u00b0");
    EXPECT_EQ(title_text(velocity), "velocity (km/s)");
    EXPECT_EQ(short_title_text(velocity), "Vel (km/s)");
    EXPECT_EQ(title_text(ra), "right ascension");
    for (const Axis& axis : {ra, dec, glon, velocity}) {
        EXPECT_EQ(number_text(axis, std::nan(""), 1), "-");
        EXPECT_EQ(number_text(axis, HUGE_VAL, 1), "-");
        for (const double resolution : {0.0, -1.0, HUGE_VAL, std::nan(""), 1e-300, 1e300}) {
            for (const double value : {0.0, 1e-300, 1e100, -1e100, 1e15}) {
                EXPECT_LT(number_text(axis, value, resolution).size(), 130U);
            }
        }
    }
}

TEST(WorldText, Places) {
    Axes axes;
    axes[0] = ra;
    axes[0].nodes = {2, 1, 1};
    axes[0].values = {15.25, 14.75};
    axes[2] = velocity;
    axes[2].nodes = {1, 1, 2};
    axes[2].values = {-100, 100};
    EXPECT_EQ(place_text(axes, {11, 9, 21}, {5, 4, 12}), "RA 01h00m00s  Vel 20 km/s");
    EXPECT_EQ(plane_text(axes, 2, {11, 9, 21}, 0), "-100 km/s");
    EXPECT_EQ(plane_text(axes, 1, {11, 9, 21}, 0), "");
    EXPECT_EQ(place_text({}, {11, 9, 21}, {5, 4, 12}), "");
}

}  // namespace
}  // namespace shearwater::wcs
