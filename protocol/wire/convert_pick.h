#pragma once
// Of what a picture shows at a point.

#include <vector>

#include "common/view/ray.h"
#include "common/view/transfer_function.h"
#include "protocol/wire/header.h"

namespace shearwater::wire {

// A client's question: camera and size are valid together, and (x, y) is in the picture.
struct PickRequest {
    std::uint64_t revision = 0;
    view::Camera camera;
    view::ImageSize size;
    view::Vec2 at;
    view::TransferFunction tf;
    std::optional<volume::Box> crop;
};
pb::Pick to_wire(const PickRequest& pick);
Parsed<PickRequest> pick_from(const pb::Pick& pick);

// And its answer. A value that is no number stands for none.
struct PickAnswer {
    std::uint64_t revision = 0;
    std::optional<view::RayHit> hit;
    double value = 0;
    bool incomplete = false;
};
pb::Picked to_wire(const PickAnswer& answer);
// Of a cube of n voxels, inside which it is.
Parsed<PickAnswer> pick_answer_from(const pb::Picked& picked, const volume::Index3& n);

// What one part of the tree has of a ray. As many samples as this are taken at most, of all parts together.
inline constexpr std::size_t most_ray_samples = std::size_t{1} << 19;
struct RayPart {
    std::uint64_t number = 0;
    std::vector<view::RaySample> samples;  // front to back
    bool incomplete = false;
};
pb::Probed to_wire(const RayPart& part);
// Slices go one way only, and depths are above 0 and finite.
Parsed<RayPart> ray_part_from(const pb::Probed& probed);

// A factorisation of one ray.
Parsed<view::Factorisation> ray_from(const pb::Probe& probe);

}  // namespace shearwater::wire
