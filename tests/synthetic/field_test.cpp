// Cubes by formula: what they are like, and that a voxel is the same whichever box it is read in.

#include "common/synthetic/field.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace shearwater::synthetic {
namespace {

std::vector<float> filled(const Field& field, const volume::Box& box) {
    std::vector<float> values(static_cast<std::size_t>(box.voxels()));
    field.fill(box, values);
    return values;
}

struct Moments {
    double mean, deviation, share_above_80;
};

Moments moments(const std::vector<float>& values) {
    double sum = 0;
    double squares = 0;
    double above = 0;
    for (const float value : values) {
        sum += value;
        squares += double{value} * value;
        above += value > 80 ? 1 : 0;
    }
    const auto count = static_cast<double>(values.size());
    return {sum / count, std::sqrt(squares / count - sum * sum / count / count), above / count};
}

TEST(Field, IsTheSameInWhateverBoxesItIsRead) {
    const volume::Index3 n{41, 29, 37};
    const volume::Box whole = volume::whole(n);
    for (const Kind& kind : kinds()) {
        const auto field = make_field(kind.name, n, 5);
        ASSERT_TRUE(field) << kind.name;
        const std::vector<float> all = filled(**field, whole);
        // From the last box to the first, of odd sizes, down to single voxels.
        for (const volume::Index3 step : {volume::Index3{13, 7, 5}, {41, 29, 1}, {1, 3, 40}, {6, 1, 1}}) {
            for (std::int64_t z = (n[2] - 1) / step[2] * step[2]; z >= 0; z -= step[2]) {
                for (std::int64_t y = (n[1] - 1) / step[1] * step[1]; y >= 0; y -= step[1]) {
                    for (std::int64_t x = (n[0] - 1) / step[0] * step[0]; x >= 0; x -= step[0]) {
                        const volume::Box box{
                            {x, y, z},
                            {std::min(x + step[0], n[0]) - 1, std::min(y + step[1], n[1]) - 1,
                             std::min(z + step[2], n[2]) - 1}};
                        const std::vector<float> part = filled(**field, box);
                        std::size_t i = 0;
                        for (std::int64_t k = z; k <= box.hi[2]; ++k) {
                            for (std::int64_t j = y; j <= box.hi[1]; ++j) {
                                for (std::int64_t h = x; h <= box.hi[0]; ++h, ++i) {
                                    const auto at = static_cast<std::size_t>((k * n[1] + j) * n[0] + h);
                                    ASSERT_EQ(part[i], all[at]) << kind.name << " " << volume::to_string(box);
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(Field, SeedsGiveDifferentCubes) {
    const volume::Index3 n{16, 16, 16};
    for (const char* name : {"random", "random-bytes", "noise-sources"}) {
        const auto first = filled(**make_field(name, n, 1), volume::whole(n));
        EXPECT_EQ(filled(**make_field(name, n, 1), volume::whole(n)), first) << name;
        EXPECT_NE(filled(**make_field(name, n, 2), volume::whole(n)), first) << name;
    }
}

TEST(Field, RandomBytesAreWholeAndUniform) {
    const volume::Index3 n{64, 64, 64};
    const auto values = filled(**make_field("random-bytes", n, 1), volume::whole(n));
    std::vector<int> counts(256);
    for (const float value : values) {
        ASSERT_EQ(value, std::floor(value));
        ++counts.at(static_cast<std::size_t>(value));
    }
    // 1024 expected of each, give or take 32.
    EXPECT_THAT(counts,
                testing::Each(testing::AllOf(testing::Gt(1024 - 5 * 32), testing::Lt(1024 + 5 * 32))));
    EXPECT_NEAR(moments(values).mean, 127.5, 0.6);
}

TEST(Field, NoiseSourcesHasTheNoiseAndTheSourcesOfASurvey) {
    const volume::Index3 n{128, 128, 128};
    const auto values = filled(**make_field("noise-sources", n, 1), volume::whole(n));
    EXPECT_THAT(values, testing::Each(testing::AllOf(testing::Ge(0.0F), testing::Le(255.0F))));
    const Moments all = moments(values);
    EXPECT_NEAR(all.mean, 40.2, 0.3);
    EXPECT_NEAR(all.share_above_80, 0.0016, 0.0004);
    // Between the tenth and the ninetieth per cent there is hardly anything but noise.
    std::vector<float> sorted = values;
    std::ranges::sort(sorted);
    EXPECT_NEAR(sorted[sorted.size() / 2], 40, 0.2);
    EXPECT_NEAR(sorted[sorted.size() / 10], 40 - 12.816, 0.2);
    EXPECT_NEAR(sorted[sorted.size() / 10 * 9], 40 + 12.816, 0.4);
    EXPECT_GT(sorted.back(), 200);
}

TEST(Field, NoiseAloneStraysAboveEighty) {
    // A place where no source is, in a cube so large that most of it is empty.
    const volume::Index3 n{4096, 4096, 4096};
    const auto values = filled(**make_field("noise-sources", n, 1), {{0, 0, 0}, {255, 255, 15}});
    const Moments all = moments(values);
    EXPECT_NEAR(all.mean, 40, 0.05);
    EXPECT_NEAR(all.deviation, 10, 0.05);
    // Four deviations: 3.17e-5 of 2^20 voxels are 33.
    EXPECT_NEAR(all.share_above_80 * static_cast<double>(values.size()), 33, 25);
}

TEST(Field, WhatCannotBeMadeIsSaid) {
    EXPECT_THAT(make_field("pear", {9, 9, 9}, 1).error().message(), testing::HasSubstr("noise-sources"));
    for (const volume::Index3 n : {volume::Index3{1, 9, 9}, {9, -1, 9}, {9, 9, (1 << 20) + 1}}) {
        const auto field = make_field("random", n, 1);
        ASSERT_FALSE(field);
        EXPECT_EQ(field.error().code, base::Code::invalid_argument);
    }
}

}  // namespace
}  // namespace shearwater::synthetic
