// The samples' formulas, their files, and what is left when one is stopped.

#include "deploy/samples/sample.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::samples {
namespace {

using testing::HasSubstr;

class Samples : public testing::Test {
  protected:
    std::vector<float> made(const std::string& name, const volume::Index3& n, std::uint64_t seed = 1,
                            int bitpix = -32) {
        const base::Status status = write_sample(name, n, seed, path_, {}, {}, bitpix);
        EXPECT_TRUE(status) << (status ? "" : status.error().message());
        auto cube = fits::Cube::open(path_);
        EXPECT_TRUE(cube) << (cube ? "" : cube.error().message());
        EXPECT_EQ(cube->info().n, n);
        EXPECT_EQ(cube->info().bitpix, bitpix);
        EXPECT_TRUE(cube->info().notes.empty());
        return fits::read_box(*cube, volume::whole(n));
    }
    std::size_t files() const {
        std::size_t count = 0;
        for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder_.path(""))) {
            ++count;
        }
        return count;
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("sample.fits");
};

TEST_F(Samples, EveryKindIsMadeInAnyShapeAndIsTheSameAgain) {
    for (const SampleKind& kind : kinds()) {
        const volume::Index3 n{37, 20, 13};
        const std::vector<float> values = made(std::string(kind.name), n);
        const std::string bytes = support::slurp(path_);
        made(std::string(kind.name), n);
        EXPECT_EQ(support::slurp(path_), bytes) << kind.name;
        EXPECT_FALSE(kind.description.empty());
        EXPECT_EQ(files(), 1U);
        made(std::string(kind.name), {2, 2, 2});
    }
}

TEST_F(Samples, SeedsGiveDifferentCubes) {
    for (const std::string name : {"hi-galaxy", "nbody-web", "random", "noise-sources"}) {
        made(name, {16, 16, 16}, 1);
        const std::string first = support::slurp(path_);
        made(name, {16, 16, 16}, 2);
        EXPECT_NE(support::slurp(path_), first) << name;
    }
}

TEST_F(Samples, SlabIsOneEverywhere) {
    EXPECT_THAT(made("slab", {5, 6, 7}), testing::Each(1.0F));
}

TEST_F(Samples, BallIsOneInsideAndZeroOutside) {
    const volume::Index3 n{50, 40, 61};
    const std::vector<float> values = made("ball", n);
    double sum = 0;
    std::size_t i = 0;
    for (std::int64_t z = 0; z < n[2]; ++z) {
        for (std::int64_t y = 0; y < n[1]; ++y) {
            for (std::int64_t x = 0; x < n[0]; ++x, ++i) {
                const double r = std::hypot(static_cast<double>(x) - 24.5, static_cast<double>(y) - 19.5,
                                            static_cast<double>(z) - 30);
                EXPECT_NEAR(values[i], std::min(1.0, std::max(0.0, 16 - r + 0.5)), 1e-5);
                sum += values[i];
            }
        }
    }
    EXPECT_NEAR(sum / (4.0 / 3 * 3.14159265 * 16 * 16 * 16), 1, 0.01);
}

TEST_F(Samples, RandomIsUniform) {
    const std::vector<float> values = made("random", {64, 64, 64});
    double sum = 0;
    double squares = 0;
    for (const float value : values) {
        ASSERT_GE(value, 0);
        ASSERT_LT(value, 1);
        sum += value;
        squares += double{value} * value;
    }
    const double mean = sum / static_cast<double>(values.size());
    EXPECT_NEAR(mean, 0.5, 0.003);
    EXPECT_NEAR(squares / static_cast<double>(values.size()) - mean * mean, 1.0 / 12, 0.001);
}

TEST_F(Samples, EightBitsHoldTheRoundedValues) {
    const volume::Index3 n{40, 30, 20};
    for (const SampleKind& kind : kinds()) {
        const std::string name(kind.name);
        if (!kind.bytes) {
            EXPECT_EQ(write_sample(name, n, 1, path_, {}, {}, 8).error().code, base::Code::invalid_argument);
            continue;
        }
        std::vector<float> values = made(name, n, 4);
        const std::size_t long_file = support::slurp(path_).size();
        std::ranges::transform(values, values.begin(), [](float value) { return std::nearbyint(value); });
        EXPECT_EQ(made(name, n, 4, 8), values) << name;
        EXPECT_LT(support::slurp(path_).size(), long_file / 3);
    }
}

TEST_F(Samples, GalaxyStandsOutOfItsNoiseAndCornersAreBlank) {
    const volume::Index3 n{96, 96, 64};
    const std::vector<float> values = made("hi-galaxy", n);
    const auto at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        return values[static_cast<std::size_t>(x + n[0] * (y + n[1] * z))];
    };
    EXPECT_TRUE(std::isnan(at(0, 0, 10)));
    EXPECT_TRUE(std::isnan(at(95, 95, 50)));
    EXPECT_FALSE(std::isnan(at(0, 48, 0)));
    float peak = 0;
    double squares = 0;
    for (std::int64_t y = 30; y < 66; ++y) {
        for (std::int64_t x = 30; x < 66; ++x) {
            squares += double{at(x, y, 0)} * at(x, y, 0);  // a channel without gas
            for (std::int64_t z = 0; z < n[2]; ++z) {
                peak = std::max(peak, at(x, y, z));
            }
        }
    }
    const double noise = std::sqrt(squares / (36 * 36));
    EXPECT_NEAR(noise, 0.0008, 0.0003);
    EXPECT_GT(peak, 30 * noise);
    auto cube = fits::Cube::open(path_);
    EXPECT_EQ(cube->info().unit, "Jy/beam");
    EXPECT_EQ(cube->info().axis_types, (std::array<std::string, 3>{"RA---SIN", "DEC--SIN", "VRAD"}));
}

TEST_F(Samples, WebHasDenseKnotsInWideVoids) {
    const std::vector<float> values = made("nbody-web", {64, 64, 64});
    const auto share_above = [&](float limit) {
        return static_cast<double>(
                   std::count_if(values.begin(), values.end(), [=](float v) { return v > limit; })) /
               static_cast<double>(values.size());
    };
    EXPECT_GT(share_above(-0.5F), 0.1);
    EXPECT_LT(share_above(-0.5F), 0.5);
    EXPECT_GT(share_above(0.5F), 0.001);
    EXPECT_LT(share_above(0.5F), 0.05);
}

TEST_F(Samples, WhatCannotBeMadeIsSaid) {
    EXPECT_THAT(write_sample("cube", {9, 9, 9}, 1, path_).error().message(), HasSubstr("hi-galaxy"));
    EXPECT_EQ(write_sample("ball", {9, 1, 9}, 1, path_).error().code, base::Code::invalid_argument);
    EXPECT_EQ(write_sample("ball", {9, 9, std::int64_t{1} << 40}, 1, path_).error().code,
              base::Code::invalid_argument);
    EXPECT_EQ(write_sample("ball", {1 << 20, 1 << 20, 2}, 1, path_).error().code, base::Code::too_large);
    EXPECT_EQ(write_sample("ball", {1 << 15, 1 << 15, 1 << 20}, 1, path_).error().code,
              base::Code::too_large);
    EXPECT_EQ(write_sample("ball", {9, 9, 9}, 1, folder_.path("none/sample.fits")).error().code,
              base::Code::io);
    EXPECT_EQ(files(), 0U);
}

TEST_F(Samples, AStopLeavesNothingBehindAndTheOldFileInPlace) {
    support::spill(path_, "old");
    std::stop_source stop;
    double told = 0;
    const auto progress = [&](double share) {
        told = share;
        EXPECT_EQ(files(), 2U);
        if (share > 0.3) {
            stop.request_stop();
        }
    };
    const base::Status status = write_sample("random", {16, 16, 100}, 1, path_, progress, stop.get_token());
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().code, base::Code::cancelled);
    EXPECT_GT(told, 0.3);
    EXPECT_LT(told, 1);
    EXPECT_EQ(files(), 1U);
    EXPECT_EQ(support::slurp(path_), "old");
}

}  // namespace
}  // namespace shearwater::samples
