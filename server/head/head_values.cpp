#include "server/head/head.h"

#include "protocol/wire/convert_world.h"

namespace shearwater::head {

namespace pb = wire::pb;
using Counted = node::Branch::Counted;

volume::Mapping Head::mapping_from(const volume::Histogram& histogram) const {
    const volume::Limits limits = volume::percentile_limits(histogram, limits_.percentile);
    return {.lo = limits.lo, .hi = limits.hi, .stretch = limits_.stretch, .bits = limits_.bits};
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
        mapping_ = mapping_from(*histogram);
        pb::SetMapping set;
        *set.mutable_mapping() = wire::to_wire(*mapping_);
        branch_.tell_children(wire::message(std::move(set)), effects.net);
    }
    values_ = wire::to_wire(volume::summarise(*histogram, *mapping_));
    tell_cube(effects);
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
