#include "common/view/anchored_function.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace shearwater::view {
namespace {

TransferFunction with(std::vector<OpacityPin> pins) {
    TransferFunction tf = default_transfer_function();
    tf.opacity_pins = std::move(pins);
    return tf;
}

base::Result<TransferFunction> read_toml(std::string_view text, std::string_view source) {
    const auto function = transfer_function_from_toml(text, source);
    return function ? on_scale(*function, nullptr) : function.error();
}

std::string toml_of(const TransferFunction& tf) {
    return to_toml({.tf = tf});
}

std::string fault_of(std::string_view toml) {
    const auto tf = read_toml(toml, "t.toml");
    return tf ? "accepted" : tf.error().message();
}

TEST(Opacity, RampIsLinearBetweenItsEndsAndConstantOutside) {
    const auto tf = with({Ramp{0.2, 0.1, 0.6, 0.5}});
    EXPECT_DOUBLE_EQ(tf.opacity(0.0), 0.1);
    EXPECT_DOUBLE_EQ(tf.opacity(0.2), 0.1);
    EXPECT_DOUBLE_EQ(tf.opacity(0.3), 0.2);
    EXPECT_DOUBLE_EQ(tf.opacity(0.6), 0.5);
    EXPECT_DOUBLE_EQ(tf.opacity(1.0), 0.5);
}

TEST(Opacity, HatsAreTrapeziaTrianglesAndTopHats) {
    const auto trapezium = with({Hat{0.5, 0.2, 0.4, 0.8}});
    EXPECT_DOUBLE_EQ(trapezium.opacity(0.5), 0.8);
    EXPECT_DOUBLE_EQ(trapezium.opacity(0.41), 0.8);
    EXPECT_NEAR(trapezium.opacity(0.35), 0.4, 1e-12);
    EXPECT_DOUBLE_EQ(trapezium.opacity(0.29), 0);
    EXPECT_DOUBLE_EQ(trapezium.opacity(0.71), 0);

    const auto triangle = with({Hat{0.5, 0, 0.4, 0.8}});
    EXPECT_DOUBLE_EQ(triangle.opacity(0.5), 0.8);
    EXPECT_NEAR(triangle.opacity(0.6), 0.4, 1e-12);

    const auto top_hat = with({Hat{0.5, 0.2, 0.2, 0.8}});
    EXPECT_DOUBLE_EQ(top_hat.opacity(0.45), 0.8);
    EXPECT_DOUBLE_EQ(top_hat.opacity(0.39), 0);
    EXPECT_DOUBLE_EQ(top_hat.opacity(0.61), 0);
}

TEST(Opacity, LargestPinWinsExceptInsideABlank) {
    const auto tf = with({Flat{0.3}, Ramp{0, 0, 1, 1}, Blank{0.25, 0.5}});
    EXPECT_DOUBLE_EQ(tf.opacity(0.1), 0.3);
    EXPECT_DOUBLE_EQ(tf.opacity(0.7), 0.7);
    EXPECT_DOUBLE_EQ(tf.opacity(0.25), 0);
    EXPECT_DOUBLE_EQ(tf.opacity(0.4), 0);
    EXPECT_DOUBLE_EQ(tf.opacity(0.5), 0);
    EXPECT_DOUBLE_EQ(tf.opacity(0.51), 0.51);
    EXPECT_DOUBLE_EQ(with({}).opacity(0.5), 0);
}

TEST(Extinction, OneWorldUnitHasThePinsOpacity) {
    for (const double a : {0.0, 1e-9, 0.001, 0.3, 0.999}) {
        EXPECT_NEAR(1 - std::exp(-with({Flat{a}}).extinction(0.5)), a, 1e-15 + a * 1e-9);
    }
    EXPECT_EQ(with({Flat{1}}).extinction(0.5), TransferFunction::opaque);
}

TEST(Colour, IsLinearBetweenPinsAndConstantOutside) {
    TransferFunction tf;
    tf.colour_pins = {{0.2, {0, 0, 1}}, {0.6, {1, 0.5, 0}}};
    EXPECT_EQ(tf.colour(0), (Rgb{0, 0, 1}));
    EXPECT_NEAR(tf.colour(0.3).r, 0.25, 1e-12);
    EXPECT_NEAR(tf.colour(0.3).g, 0.125, 1e-12);
    EXPECT_NEAR(tf.colour(0.3).b, 0.75, 1e-12);
    EXPECT_EQ(tf.colour(1), (Rgb{1, 0.5, 0}));
}

TEST(Colour, PinsAtOnePlaceMakeAStep) {
    TransferFunction tf;
    tf.colour_pins = {{0, {0, 0, 0}}, {0.5, {0, 0, 0}}, {0.5, {1, 1, 1}}, {1, {1, 1, 1}}};
    ASSERT_TRUE(validate(tf));
    EXPECT_EQ(tf.colour(0.499999), (Rgb{0, 0, 0}));
    EXPECT_EQ(tf.colour(0.5), (Rgb{1, 1, 1}));
}

TEST(ColourMaps, AllAreValidCoverTheRangeAndReverse) {
    ASSERT_EQ(colour_map_names().size(), 12u);
    for (const std::string& name : colour_map_names()) {
        TransferFunction tf, back;
        tf.colour_pins = colour_map(name).value();
        back.colour_pins = colour_map(name + "-r").value();
        EXPECT_TRUE(validate(tf)) << name;
        EXPECT_TRUE(validate(back)) << name;
        EXPECT_EQ(tf.colour_pins.front().at, 0) << name;
        EXPECT_EQ(tf.colour_pins.back().at, 1) << name;
        for (double s = 0; s <= 1; s += 0.037) {
            EXPECT_NEAR(tf.colour(s).r, back.colour(1 - s).r, 1e-12) << name;
            EXPECT_NEAR(tf.colour(s).g, back.colour(1 - s).g, 1e-12) << name;
            EXPECT_NEAR(tf.colour(s).b, back.colour(1 - s).b, 1e-12) << name;
        }
    }
}

TEST(ColourMaps, KnownColours) {
    const auto byte = [](std::string_view name, double s) {
        TransferFunction tf;
        tf.colour_pins = colour_map(name).value();
        const Rgb c = tf.colour(s);
        return std::array{std::round(c.r * 255), std::round(c.g * 255), std::round(c.b * 255)};
    };
    EXPECT_THAT(byte("viridis", 0), testing::ElementsAre(68, 1, 84));
    EXPECT_THAT(byte("viridis", 1), testing::ElementsAre(253, 231, 37));
    EXPECT_THAT(byte("inferno", 0), testing::ElementsAre(0, 0, 4));
    EXPECT_THAT(byte("inferno", 1), testing::ElementsAre(252, 255, 164));
    EXPECT_THAT(byte("grey", 0.5), testing::ElementsAre(128, 128, 128));
    EXPECT_THAT(byte("rainbow", 0.4), testing::ElementsAre(0, 255, 255));
}

// Brightness by the eye's weights rises all along the maps that promise it.
TEST(ColourMaps, SequentialMapsRiseInLuma) {
    for (const char* name : {"viridis", "inferno", "magma", "plasma", "cividis", "cubehelix", "grey"}) {
        TransferFunction tf;
        tf.colour_pins = colour_map(name).value();
        double before = -1;
        for (int i = 0; i <= 32; ++i) {
            const Rgb c = tf.colour(i / 32.0);
            const double luma = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
            EXPECT_GT(luma, before) << name << " at " << i;
            before = luma;
        }
    }
}

TEST(ColourMaps, AnUnknownNameListsTheKnownOnes) {
    const auto map = colour_map("virids\n");
    ASSERT_FALSE(map);
    EXPECT_EQ(map.error().code, base::Code::not_found);
    EXPECT_THAT(map.error().message(), testing::HasSubstr("\"virids?\""));
    EXPECT_THAT(map.error().message(), testing::HasSubstr("cubehelix"));
}

TEST(Validation, RefusesWhatIsOutOfRange) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double inf = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(validate(with({Ramp{-1, 0, 2, 1}, Hat{0, 0, 0, 1}, Blank{0.5, 0.5}, Flat{1}})));
    for (const OpacityPin& pin : std::vector<OpacityPin>{
             Ramp{0.5, 0, 0.5, 1}, Ramp{0.6, 0, 0.5, 1}, Ramp{nan, 0, 1, 1}, Ramp{0, 0, inf, 1},
             Ramp{0, -0.1, 1, 1}, Ramp{0, 0, 1, 1.1}, Ramp{0, nan, 1, 1}, Hat{0.5, 0.3, 0.2, 1},
             Hat{0.5, -0.1, 0.2, 1}, Hat{nan, 0, 0.2, 1}, Hat{0.5, 0, 0.2, 2}, Flat{-1}, Flat{nan},
             Blank{0.5, 0.4}, Blank{nan, 1}}) {
        EXPECT_FALSE(validate(with({pin})));
    }
    EXPECT_TRUE(validate(with(std::vector<OpacityPin>(TransferFunction::max_pins, Flat{0.1}))));
    EXPECT_FALSE(validate(with(std::vector<OpacityPin>(TransferFunction::max_pins + 1, Flat{0.1}))));

    TransferFunction tf = with({});
    tf.background.g = 1.5;
    EXPECT_FALSE(validate(tf));
    for (const auto& pins : std::vector<std::vector<ColourPin>>{
             {}, {{0.5, {}}, {0.4, {}}}, {{nan, {}}}, {{0, {0, 0, nan}}}, {{0, {2, 0, 0}}}}) {
        tf = with({});
        tf.colour_pins = pins;
        EXPECT_FALSE(validate(tf));
    }
}

TEST(Opacity, AHatLeansWithinItsBase) {
    const auto tf = with({Hat{0.5, 0.1, 0.4, 0.8, 0.1}});  // feet at 0.3 and 0.7, shoulders at 0.55 and 0.65
    EXPECT_DOUBLE_EQ(tf.opacity(0.3), 0);
    EXPECT_NEAR(tf.opacity(0.425), 0.4, 1e-12);
    EXPECT_DOUBLE_EQ(tf.opacity(0.56), 0.8);
    EXPECT_DOUBLE_EQ(tf.opacity(0.64), 0.8);
    EXPECT_NEAR(tf.opacity(0.675), 0.4, 1e-12);
    EXPECT_DOUBLE_EQ(tf.opacity(0.701), 0);
    // Upright on one side, as far as it can lean.
    const auto most = with({Hat{0.5, 0, 0.4, 0.8, -0.2}});
    EXPECT_TRUE(validate(most));
    EXPECT_DOUBLE_EQ(most.opacity(0.299), 0);
    EXPECT_NEAR(most.opacity(0.301), 0.798, 1e-12);
    EXPECT_FALSE(validate(with({Hat{0.5, 0, 0.4, 0.8, -0.21}})));
    EXPECT_FALSE(validate(with({Hat{0.5, 0, 0.4, 0.8, std::numeric_limits<double>::quiet_NaN()}})));
}

TEST(Opacity, DensityMultipliesTheExtinction) {
    auto tf = with({Ramp{0, 0, 1, 0.9}, Blank{0.5, 0.6}});
    auto dense = tf;
    for (const double k : {0.001, 0.3, 1.0, 2.0, 1000.0}) {
        dense.density = k;
        ASSERT_TRUE(validate(dense));
        for (const double s : {0.0, 0.2, 0.55, 0.8, 1.0}) {
            EXPECT_NEAR(dense.extinction(s), std::min(k * tf.extinction(s), TransferFunction::opaque), 1e-9);
            EXPECT_NEAR(dense.opacity(s), 1 - std::pow(1 - tf.opacity(s), k), 1e-12);
            EXPECT_EQ(dense.height(s), tf.opacity(s));
        }
    }
    dense = with({Flat{1}});
    dense.density = 0.001;
    EXPECT_EQ(dense.opacity(0.5), 1);
    EXPECT_EQ(dense.extinction(0.5), TransferFunction::opaque);
    for (const double k : {0.0, -1.0, 1e4, std::numeric_limits<double>::quiet_NaN()}) {
        dense.density = k;
        EXPECT_FALSE(validate(dense)) << k;
    }
}

TEST(Toml, ReadsEveryKind) {
    const auto read = read_toml(R"(
background = [255, 51, 0]
[[colour]]
at = 0
rgb = [0, 0, 0]
[[colour]]
at = 1.0
rgb = [255, 127.5, 51]
[[opacity]]
kind = "ramp"
x0 = 0.2
a0 = 0.0
x1 = 1
a1 = 0.5
[[opacity]]
kind = "hat"
centre = 0.6
top = 0.1
base = 0.3
height = 0.4
[[opacity]]
kind = "flat"
height = 0.001
[[opacity]]
kind = "blank"
lo = 0.25
hi = 0.5
)",
                                "t.toml");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(*read, (TransferFunction{.opacity_pins = {Ramp{0.2, 0, 1, 0.5}, Hat{0.6, 0.1, 0.3, 0.4},
                                                        Flat{0.001}, Blank{0.25, 0.5}},
                                       .colour_pins = {{0, {0, 0, 0}}, {1, {1, 0.5, 0.2}}},
                                       .background = {1, 0.2, 0}}));
}

TEST(Toml, NamesAMapAndDefaultsToInferno) {
    EXPECT_EQ(read_toml("colourmap = \"turbo-r\"", "t").value().colour_pins, colour_map("turbo-r").value());
    EXPECT_EQ(read_toml("", "t").value().colour_pins, colour_map("inferno").value());
}

TEST(Toml, WritesWhatItReadsBack) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0, 1);
    for (int round = 0; round < 50; ++round) {
        TransferFunction tf;
        const double x = share(random);
        tf.opacity_pins = {Ramp{x, share(random), x + 1e-7, share(random)},
                           Hat{share(random), 0, x, share(random)}, Flat{share(random) * 1e-12},
                           Blank{x / 3, x}};
        tf.colour_pins = {{0, {share(random), 0, 1}}, {x, {1.0 / 255, share(random), 17.0 / 255}}};
        tf.background = {x, 0, 1};
        tf.density = 0.1 + x;
        std::get<Hat>(tf.opacity_pins[1]).lean = (x / 2) * (2 * share(random) - 1);
        const auto back = read_toml(toml_of(tf), "t");
        ASSERT_TRUE(back) << back.error().message() << "\n" << toml_of(tf);
        ASSERT_EQ(back->opacity_pins, tf.opacity_pins) << toml_of(tf);
        ASSERT_EQ(back->density, tf.density);
        for (std::size_t i = 0; i < 2; ++i) {  // channels are written times 255
            EXPECT_EQ(back->colour_pins[i].at, tf.colour_pins[i].at);
            EXPECT_NEAR(back->colour_pins[i].rgb.g, tf.colour_pins[i].rgb.g, 1e-15);
        }
    }
    for (const std::string& name : colour_map_names()) {
        TransferFunction tf = default_transfer_function();
        tf.colour_pins = colour_map(name + "-r").value();
        EXPECT_EQ(read_toml(toml_of(tf), "t").value(), tf) << name;
        EXPECT_THAT(toml_of(tf), testing::HasSubstr("colourmap = \"" + name + "-r\"")) << name;
    }
}

TEST(Toml, RefusesByName) {
    using testing::HasSubstr;
    EXPECT_THAT(fault_of("colormap = \"inferno\""), HasSubstr("unknown key \"colormap\""));
    EXPECT_THAT(fault_of("[[opacity]]\nkind = \"slope\""), HasSubstr("unknown kind \"slope\""));
    EXPECT_THAT(fault_of("[[opacity]]\nkind = \"flat\"\nheight = 0.1\nhigh = 2"),
                HasSubstr("unknown key \"high\""));
    EXPECT_THAT(fault_of("[[opacity]]\nkind = \"ramp\"\nx0 = 0\na0 = 0\nx1 = 1"), HasSubstr("a1"));
    EXPECT_THAT(fault_of("[[opacity]]\nheight = 0.1"), HasSubstr("kind"));
    EXPECT_THAT(fault_of("[[opacity]]\nkind = \"flat\"\nheight = \"0.1\""), HasSubstr("height"));
    EXPECT_THAT(fault_of("[[opacity]]\nkind = \"flat\"\nheight = nan"), HasSubstr("height"));
    EXPECT_THAT(fault_of("[[opacity]]\nkind = \"flat\"\nheight = 7"), HasSubstr("opacity pin 1"));
    EXPECT_THAT(fault_of("[[colour]]\nat = 0"), HasSubstr("rgb"));
    EXPECT_THAT(fault_of("[[colour]]\nat = 0\nrgb = [0, 256, 0]"), HasSubstr("0 to 255"));
    EXPECT_THAT(fault_of("[[colour]]\nat = 0\nrgb = [0, 0]"), HasSubstr("3 numbers"));
    EXPECT_THAT(fault_of("colourmap = \"nope\""), HasSubstr("nope"));
    EXPECT_THAT(fault_of("colourmap = 3"), HasSubstr("colourmap"));
    EXPECT_THAT(fault_of("colourmap = \"grey\"\n[[colour]]\nat = 0\nrgb = [0, 0, 0]"), HasSubstr("not both"));
    EXPECT_THAT(fault_of("opacity = 3"), HasSubstr("[[opacity]]"));
    EXPECT_THAT(fault_of("opacity = [1, 2]"), HasSubstr("[[opacity]]"));
    EXPECT_THAT(fault_of("background = [0, 0, -1]"), HasSubstr("background"));
    EXPECT_THAT(fault_of("a = [[["), HasSubstr("line 1"));
    EXPECT_THAT(fault_of("density = 0"), HasSubstr("density"));
    EXPECT_THAT(fault_of("density = \"thick\""), HasSubstr("density"));
    EXPECT_THAT(fault_of("scale = 3"), HasSubstr("[scale]"));
    EXPECT_THAT(fault_of("[scale]\nunit = \"furlong\""), HasSubstr("percentile"));
    EXPECT_THAT(fault_of("[scale]\nunits = \"sigma\""), HasSubstr("unknown key \"units\""));
    EXPECT_THAT(fault_of("[scale]\nunit = \"sigma\""), HasSubstr("the cube is not known"));
}

TEST(Toml, HostileTextIsRefusedAndNeverCrashes) {
    EXPECT_NE(fault_of(std::string(2 << 20, ' ')), "accepted");
    EXPECT_NE(fault_of("a = " + std::string(100000, '[')), "accepted");
    EXPECT_NE(fault_of(std::string("\0\xff\xfe", 3)), "accepted");
    std::string many;
    for (std::size_t i = 0; i <= TransferFunction::max_pins; ++i) {
        many += "[[opacity]]\nkind = \"flat\"\nheight = 0.1\n";
    }
    EXPECT_THAT(fault_of(many), testing::HasSubstr("more than 256"));

    const std::string good = toml_of(with({Ramp{}, Hat{}, Flat{}, Blank{}}));
    std::mt19937 random(11);
    for (int round = 0; round < 3000; ++round) {
        std::string text = good;
        for (int edit = 0; edit < 3; ++edit) {
            text[random() % text.size()] = static_cast<char>(random() % 256);
        }
        const auto read = read_toml(text.substr(0, random() % text.size()), "fuzz");
        EXPECT_TRUE(!read || validate(*read));
    }
}

}  // namespace
}  // namespace shearwater::view
