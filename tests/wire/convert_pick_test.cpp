// Picks there and back, and what is refused.

#include "protocol/wire/convert_pick.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const volume::Index3 picked_n{10, 9, 8};

TEST(Pick, ComesBack) {
    PickRequest asked = pick_request();
    EXPECT_FALSE(pick_from(to_wire(asked))->crop);
    asked.crop = volume::Box{{1, 2, 3}, {4, 5, 6}};
    const PickRequest back = pick_from(to_wire(asked)).value();
    EXPECT_EQ(back.crop, asked.crop);
    EXPECT_EQ(back.revision, asked.revision);
    EXPECT_EQ(back.camera, asked.camera);
    EXPECT_EQ(back.size, asked.size);
    EXPECT_EQ(back.at, asked.at);
    EXPECT_EQ(back.tf, asked.tf);
}

TEST(Pick, OutsideThePictureIsRefused) {
    for (const view::Vec2 at :
         {view::Vec2{-1, 5}, {5, -0.1}, {641, 5}, {5, 481}, {not_a_number, 5}, {5, not_a_number}}) {
        pb::Pick bad = to_wire(pick_request());
        bad.set_x(at.x);
        bad.set_y(at.y);
        EXPECT_EQ(pick_from(bad).error().reason, pb::REASON_INVALID);
    }
    pb::Pick bad = to_wire(pick_request());
    bad.set_width(0);
    EXPECT_TRUE(pick_from(bad).has_error());
    bad = to_wire(pick_request());
    bad.mutable_camera()->mutable_up()->set_y(not_a_number);
    EXPECT_TRUE(pick_from(bad).has_error());
    bad = to_wire(pick_request());
    bad.mutable_transfer_function()->clear_colour_pins();
    EXPECT_TRUE(pick_from(bad).has_error());
}

TEST(PickAnswer, ComesBack) {
    const PickAnswer nothing{.revision = 3, .hit = {}, .value = not_a_number, .incomplete = true};
    EXPECT_FALSE(pick_answer_from(to_wire(nothing), picked_n).value().hit);
    EXPECT_TRUE(pick_answer_from(to_wire(nothing), picked_n).value().incomplete);
    const PickAnswer some{.revision = 4, .hit = view::RayHit{{9, 0, 3.5}, 0.25}, .value = -7};
    const PickAnswer back = pick_answer_from(to_wire(some), picked_n).value();
    EXPECT_EQ(back.revision, 4U);
    EXPECT_EQ(back.hit->voxel, some.hit->voxel);
    EXPECT_EQ(back.hit->opacity, 0.25);
    EXPECT_EQ(back.value, -7);
}

TEST(PickAnswer, OutsideTheCubeIsRefused) {
    for (const view::Vec3 voxel : {view::Vec3{9.01, 0, 0}, {0, -0.1, 0}, {0, 0, not_a_number}}) {
        const PickAnswer bad{.revision = 4, .hit = view::RayHit{voxel, 0.25}};
        EXPECT_EQ(pick_answer_from(to_wire(bad), picked_n).error().reason, pb::REASON_INVALID);
    }
    const PickAnswer bad{.revision = 4, .hit = view::RayHit{{0, 0, 0}, 1.5}};
    EXPECT_TRUE(pick_answer_from(to_wire(bad), picked_n).has_error());
}

TEST(RayPart, ComesBackByRisingAndByFallingSlices) {
    for (const std::vector<view::RaySample>& samples :
         {std::vector<view::RaySample>{{3, 1}, {4, 0.5F}, {9, 2}},
          {{9, 1}, {8, 0.5F}, {0, 2}},
          {{5, 1}},
          {}}) {
        const RayPart part{.number = 6, .samples = samples, .incomplete = samples.empty()};
        const RayPart back = ray_part_from(to_wire(part)).value();
        EXPECT_EQ(back.number, 6U);
        EXPECT_EQ(back.samples, samples);
        EXPECT_EQ(back.incomplete, part.incomplete);
    }
}

TEST(RayPart, OutOfOrderOrRangeIsRefused) {
    const auto refused = [](std::vector<view::RaySample> samples) {
        return ray_part_from(to_wire(RayPart{.number = 6, .samples = std::move(samples)})).has_error();
    };
    EXPECT_TRUE(refused({{3, 1}, {3, 1}}));
    EXPECT_TRUE(refused({{3, 1}, {5, 1}, {4, 1}}));
    EXPECT_TRUE(refused({{-1, 1}}));
    EXPECT_TRUE(refused({{3, 0}}));
    EXPECT_TRUE(refused({{3, -1}}));
    EXPECT_TRUE(refused({{3, std::numeric_limits<float>::infinity()}}));
    EXPECT_TRUE(refused({{std::int64_t{1} << 50, 1}}));
    pb::Probed uneven = to_wire(RayPart{.number = 6, .samples = {{3, 1}}});
    uneven.add_depths(1);
    EXPECT_TRUE(ray_part_from(uneven).has_error());
    EXPECT_TRUE(refused(std::vector<view::RaySample>(most_ray_samples + 1, {0, 1})));
}

TEST(Probe, IsOfOneRay) {
    pb::Probe probe;
    *probe.mutable_factorisation() = to_wire(factorisation());
    EXPECT_EQ(ray_from(probe).error().reason, pb::REASON_INVALID);
}

}  // namespace
}  // namespace shearwater::wire::test
