// The head's part in picking: a client's question becomes a ray that goes down the tree, what comes back says
// where something is, and the cube says what value that has.

#include "protocol/wire/convert_pick.h"
#include "server/head/head.h"

namespace shearwater::head {

namespace pb = wire::pb;

// A peer's pick that leaves would take for a fault of ours is the client's: of another cube's crop, or so far
// out that its ray has no bounds.
wire::Parsed<view::Factorisation> Head::ray_of(const wire::PickRequest& pick) const {
    const view::Lattice& lattice = roster_.cube().lattice;
    view::Factorisation ray = view::factorise_ray(pick.camera, pick.size, pick.at, lattice);
    ray.crop = pick.crop;
    if (const auto valid = view::validate(ray); !valid) {
        return wire::Fault{pb::REASON_INVALID, "pick: " + valid.error().detail};
    }
    return ray;
}

void Head::on_pick(wire::LinkId client, const pb::Pick& pick, wire::Time now, Effects& effects) {
    const auto wanted = wire::pick_from(pick);
    const auto ray = wanted ? ray_of(*wanted) : wanted.error();
    if (!ray) {
        on_link_down(client, effects);
        fault(client, ray.error(), effects);
        return;
    }
    const Picks::Begun begun = picks_.begin(client, *wanted, *ray);
    if (begun.replaced) {
        branch_.forget_probe(*begun.replaced);
    }
    branch_.probe(begun.ray, begun.probe, now, effects.net);
}

void Head::forget_picks(wire::LinkId client) {
    if (const auto number = picks_.forget(client)) {
        branch_.forget_probe(*number);
    }
}

void Head::settle_picks(Effects& effects) {
    for (const wire::RayPart& part : branch_.take_probed()) {
        const auto answered = picks_.resolve(part);
        if (answered && answered->answer.hit) {
            effects.jobs.emplace_back(
                Measure{answered->number, roster_.cube().lattice.n, answered->answer.hit->voxel});
        } else if (answered) {
            effects.net.emplace_back(
                wire::Send{answered->client, wire::message(wire::to_wire(answered->answer))});
        }
    }
}

void Head::on_measured(const Measured& measured, Effects& effects) {
    if (const auto answered = picks_.measured(measured.number, measured.value)) {
        effects.net.emplace_back(
            wire::Send{answered->client, wire::message(wire::to_wire(answered->answer))});
    }
}

}  // namespace shearwater::head
