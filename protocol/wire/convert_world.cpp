#include "protocol/wire/convert_world.h"

#include <algorithm>

#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

pb::WorldAxis to_wire(const wcs::Axis& axis) {
    pb::WorldAxis to;
    to.set_name(axis.name);
    to.set_label(axis.label);
    to.set_unit(axis.unit);
    switch (axis.notation) {
        case wcs::Notation::plain:
            to.set_notation(pb::NOTATION_PLAIN);
            break;
        case wcs::Notation::hours:
            to.set_notation(pb::NOTATION_HOURS);
            break;
        case wcs::Notation::degrees:
            to.set_notation(pb::NOTATION_DEGREES);
            break;
    }
    to.set_circle(axis.circle);
    for (const int nodes : axis.nodes) {
        to.add_nodes(static_cast<std::uint32_t>(nodes));
    }
    to.mutable_values()->Assign(axis.values.begin(), axis.values.end());
    return to;
}

Parsed<wcs::Axis> axis_from(const pb::WorldAxis& axis, int along) {
    if (axis.values().empty()) {
        return wcs::Axis{};
    }
    if (std::cmp_greater(axis.values_size(), wcs::Axis::max_values) || axis.nodes_size() != 3) {
        return invalid("axes: the nodes are too many, or not along three axes");
    }
    wcs::Axis from{.name = base::printable(axis.name(), 40),
                   .label = base::printable(axis.label(), 12),
                   .unit = base::printable(axis.unit(), 20),
                   .circle = axis.circle(),
                   .values = {axis.values().begin(), axis.values().end()}};
    switch (axis.notation()) {
        case pb::NOTATION_PLAIN:
            break;
        case pb::NOTATION_HOURS:
            from.notation = wcs::Notation::hours;
            break;
        case pb::NOTATION_DEGREES:
            from.notation = wcs::Notation::degrees;
            break;
        default:
            return invalid("axes: an unknown notation");
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t nodes = axis.nodes(static_cast<int>(a));
        from.nodes[a] = static_cast<int>(std::min<std::uint32_t>(nodes, wcs::Axis::max_nodes + 1));
    }
    if (const auto valid = wcs::validate(from, along); !valid) {
        return invalid("axes: " + valid.error().detail);
    }
    return from;
}

}  // namespace

void put(const wcs::Axes& axes, WorldAxes& to) {
    if (std::ranges::none_of(axes, &wcs::Axis::known)) {
        return;
    }
    for (const wcs::Axis& axis : axes) {
        *to.Add() = to_wire(axis);
    }
}

Parsed<wcs::Axes> axes_from(const WorldAxes& axes) {
    wcs::Axes from;
    if (axes.empty()) {
        return from;
    }
    if (std::cmp_not_equal(axes.size(), from.size())) {
        return invalid("axes: one for each of the cube's is wanted");
    }
    for (int along = 0; along < axes.size(); ++along) {
        auto axis = axis_from(axes[along], along);
        if (!axis) {
            return axis.error();
        }
        from[static_cast<std::size_t>(along)] = *std::move(axis);
    }
    return from;
}

}  // namespace shearwater::wire
