#include "server/head/head.h"

#include "protocol/wire/convert_world.h"

namespace shearwater::head {

namespace pb = wire::pb;
using Counted = node::Branch::Counted;

volume::Mapping Head::mapping_from(const volume::Histogram& histogram) const {
    const volume::Limits limits = volume::percentile_limits(histogram, limits_.percentile);
    return {.lo = limits.lo, .hi = limits.hi, .stretch = limits_.stretch, .bits = limits_.bits};
}

std::optional<volume::Mapping> Head::own_mapping() const {
    if (limits_.range) {
        return volume::Mapping::of({limits_.range->lo, limits_.range->hi, limits_.stretch}, limits_.bits);
    }
    const auto histogram = branch_.histogram(Counted::voxels);
    return histogram ? std::optional(mapping_from(*histogram)) : std::nullopt;
}

void Head::settle_sketch(wire::Time now, Effects& effects) {
    if (!branch_.take_histogram_news(Counted::sketches) || sketch_ || roster_.cube().sketch_level == 0) {
        return;
    }
    const auto histogram = branch_.histogram(Counted::sketches);
    if (!histogram) {
        return;
    }
    sketch_ = mapping_from(*histogram);
    if (!values_) {
        values_ = wire::to_wire(volume::summarise(*histogram, mapping_ ? *mapping_ : *sketch_));
        values_->set_provisional(true);
        tell_cube(effects);
    }
    for (auto& [link, session] : sessions_) {
        begin_frames(link, session, now, effects);
    }
}

void Head::settle_mapping(Effects& effects) {
    if (!branch_.take_histogram_news(Counted::voxels) || (values_ && !values_->provisional())) {
        return;
    }
    const auto histogram = branch_.histogram(Counted::voxels);
    if (!histogram) {
        return;
    }
    if (!mapping_) {
        mapping_ = own_mapping();
        tell_mapping(false, effects);
    }
    values_ = wire::to_wire(volume::summarise(*histogram, *mapping_));
    tell_cube(effects);
}

void Head::tell_mapping(bool anew, Effects& effects) {
    roster_.expect(*mapping_);
    pb::SetMapping set;
    *set.mutable_mapping() = wire::to_wire(*mapping_);
    set.set_anew(anew);
    branch_.tell_children(wire::message(std::move(set)), effects.net);
}

// A client that has said nothing of limits before, and says nothing, takes what there are.
void Head::on_scaling(Session& session, const std::optional<volume::Scaling>& scaling, wire::Time now,
                      Effects& effects) {
    if (scaling == std::exchange(session.scaling, scaling)) {
        return;
    }
    if (scaling) {
        remap(volume::Mapping::of(*scaling, limits_.bits), now, effects);
        asked_for_ = true;
    } else if (std::exchange(asked_for_, false)) {
        if (const auto own = own_mapping()) {
            remap(*own, now, effects);
        } else {
            mapping_.reset();  // until all is counted
        }
    }
}

// Renderers read their voxels once more. Until they have, no picture is made but of the sketch, and then
// every client is sent what it looks at as it is now.
void Head::remap(const volume::Mapping& mapping, wire::Time now, Effects& effects) {
    if (mapping_ == mapping) {
        return;
    }
    mapping_ = mapping;
    serving_ = false;
    sketch_.reset();
    branch_.forget_sketches();
    functions_.drop_all();
    for (auto& [link, session] : sessions_) {
        give_up_frames(
            session, [&](const FrameInWork& frame) { return frame.client == link; }, effects);
        if (!session.wanted && session.latest) {
            session.wanted = session.latest;
            session.asked = now;
        }
    }
    tell_mapping(true, effects);
    if (const auto histogram = branch_.histogram(Counted::voxels)) {
        values_ = wire::to_wire(volume::summarise(*histogram, mapping));
    } else if (values_) {
        values_.reset();  // its bins are other values'
    }
    tell_cube(effects);
    tell_state(effects);
}

void Head::tell_cube(Effects& effects) const {
    for (const auto& [link, session] : sessions_) {
        describe_cube(link, effects);
    }
}

void Head::describe_cube(wire::LinkId client, Effects& effects) const {
    const auto& mapping = mapping_ ? mapping_ : sketch_;
    if (!mapping) {
        return;
    }
    const CubeFacts& cube = roster_.cube();
    pb::CubeDescription description;
    description.set_name(cube.name);
    description.set_object(cube.object);
    description.set_unit(cube.unit);
    *description.mutable_lattice() = wire::to_wire(cube.lattice);
    *description.mutable_mapping() = wire::to_wire(*mapping);
    description.set_provisional(!mapping_);
    if (values_) {
        *description.mutable_values() = *values_;
    }
    wire::put(cube.world, *description.mutable_axes());
    effects.net.emplace_back(wire::Send{client, wire::message(std::move(description))});
}

}  // namespace shearwater::head
