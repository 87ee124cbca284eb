// The head's part in picking: a client's question becomes a ray that goes down the tree, what comes back says
// where something is, and the cube says what value that has.

#include "protocol/wire/convert_pick.h"
#include "server/head/head.h"

namespace shearwater::head {

namespace pb = wire::pb;

void Head::on_pick(wire::LinkId client, const pb::Pick& pick, wire::Time now, Effects& effects) {
    auto wanted = wire::pick_from(pick);
    if (wanted && wanted->crop) {
        if (const auto fits = view::validate_crop(*wanted->crop, roster_.cube().lattice.n); !fits) {
            wanted = wire::Fault{pb::REASON_INVALID, fits.error().detail};
        }
    }
    if (!wanted) {
        on_link_down(client, effects);
        fault(client, wanted.error(), effects);
        return;
    }
    const Picks::Begun begun = picks_.begin(client, *wanted, roster_.cube().lattice);
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
