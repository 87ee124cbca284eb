#include "protocol/wire/convert_pick.h"

#include <limits>

#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {

pb::Pick to_wire(const PickRequest& pick) {
    pb::Pick to;
    to.set_revision(pick.revision);
    *to.mutable_camera() = to_wire(pick.camera);
    to.set_width(static_cast<std::uint32_t>(pick.size.width));
    to.set_height(static_cast<std::uint32_t>(pick.size.height));
    to.set_x(pick.at.x);
    to.set_y(pick.at.y);
    *to.mutable_transfer_function() = to_wire(pick.tf);
    if (pick.crop) {
        *to.mutable_crop() = to_wire(*pick.crop);
    }
    return to;
}

// A view with the same camera, size, transfer function and crop is checked the same way.
Parsed<PickRequest> pick_from(const pb::Pick& pick) {
    pb::SetView same;
    *same.mutable_camera() = pick.camera();
    same.set_width(pick.width());
    same.set_height(pick.height());
    *same.mutable_transfer_function() = pick.transfer_function();
    if (pick.has_crop()) {
        *same.mutable_crop() = pick.crop();
    }
    auto view = view_from(same);
    if (!view) {
        return view.error();
    }
    if (!(pick.x() >= 0 && pick.x() <= view->size.width && pick.y() >= 0 && pick.y() <= view->size.height)) {
        return invalid("pick: a point of the picture is wanted");
    }
    return PickRequest{pick.revision(),      view->camera,        view->size,
                       {pick.x(), pick.y()}, std::move(view->tf), view->crop};
}

pb::Picked to_wire(const PickAnswer& answer) {
    pb::Picked to;
    to.set_revision(answer.revision);
    to.set_incomplete(answer.incomplete);
    if (answer.hit) {
        to.set_found(true);
        set(*to.mutable_voxel(), answer.hit->voxel);
        to.set_opacity(answer.hit->opacity);
        to.set_value(answer.value);
    }
    return to;
}

Parsed<PickAnswer> pick_answer_from(const pb::Picked& picked, const volume::Index3& n) {
    PickAnswer answer{.revision = picked.revision(),
                      .hit = {},
                      .value = std::numeric_limits<double>::quiet_NaN(),
                      .incomplete = picked.incomplete()};
    if (!picked.found()) {
        return answer;
    }
    const view::RayHit hit{vec3_from(picked.voxel()), picked.opacity()};
    for (int axis = 0; axis < 3; ++axis) {
        const auto last = static_cast<double>(n[static_cast<std::size_t>(axis)] - 1);
        if (!(hit.voxel[axis] >= 0 && hit.voxel[axis] <= last)) {
            return invalid("picked: a voxel outside the cube");
        }
    }
    if (!(hit.opacity >= 0 && hit.opacity <= 1)) {
        return invalid("picked: an opacity of 0 to 1 is wanted");
    }
    answer.hit = hit;
    answer.value = picked.value();
    return answer;
}

pb::Probed to_wire(const RayPart& part) {
    pb::Probed to;
    to.set_number(part.number);
    std::int64_t previous = 0;
    for (const view::RaySample& sample : part.samples) {
        to.add_slice_steps(sample.slice - previous);
        to.add_depths(sample.depth);
        previous = sample.slice;
    }
    to.set_incomplete(part.incomplete);
    return to;
}

Parsed<RayPart> ray_part_from(const pb::Probed& probed) {
    constexpr std::int64_t most_slice = std::int64_t{1} << 41;  // of indices within 2^40
    if (probed.slice_steps_size() != probed.depths_size() ||
        std::cmp_greater(probed.depths_size(), most_ray_samples)) {
        return invalid("probed: a depth a slice is wanted, and no more than are taken");
    }
    RayPart part{.number = probed.number(), .samples = {}, .incomplete = probed.incomplete()};
    part.samples.reserve(static_cast<std::size_t>(probed.depths_size()));
    std::int64_t slice = 0, direction = 0;
    for (int i = 0; i < probed.depths_size(); ++i) {
        const std::int64_t step = probed.slice_steps(i);
        const float depth = probed.depths(i);
        if (step < -most_slice || step > most_slice || (i > 0 && step == 0) ||
            (i > 1 && (step > 0) != (direction > 0))) {
            return invalid("probed: slices in order are wanted");
        }
        slice += step;
        direction = step;
        if (slice < 0 || slice > most_slice || !(depth > 0) || !std::isfinite(depth)) {
            return invalid("probed: a slice of the cube and a depth above 0 are wanted");
        }
        part.samples.push_back({slice, depth});
    }
    return part;
}

Parsed<view::Factorisation> ray_from(const pb::Probe& probe) {
    auto ray = factorisation_from(probe.factorisation());
    if (ray && !view::is_ray(*ray)) {
        return invalid("probe: the factorisation of one ray is wanted");
    }
    return ray;
}

}  // namespace shearwater::wire
