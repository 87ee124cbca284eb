// The head's part as control plane: daemons join, are told what to do, and report.

#include "server/head/head.h"

namespace shearwater::head {

namespace pb = wire::pb;

void Head::on_join(wire::LinkId link, const pb::Join& join, Effects& effects) {
    const auto peer = joining_.find(link);
    if (peer == joining_.end() || join.role() != peer->second.role) {
        fault(link, {pb::REASON_BAD_TYPE, "only a daemon joins, once"}, effects);
        return;
    }
    const auto place = roster_.join(link, join, peer->second);
    joining_.erase(peer);
    if (!place) {
        fault(link, {pb::REASON_NO_PLACE, "the tree has no vacant place for it"}, effects);
        return;
    }
    give_orders(*place, effects);
    for (const tree::Place child : roster_.plan().at(*place).children) {
        give_orders(child, effects);
    }
}

void Head::give_orders(tree::Place place, Effects& effects) const {
    if (auto order = roster_.order_for(place, mapping_)) {
        if (!serving_) {
            order->assign.set_sketch_level(static_cast<std::uint32_t>(roster_.cube().sketch_level));
        }
        effects.net.emplace_back(wire::Send{order->link, wire::message(std::move(order->assign))});
    }
}

void Head::on_report(wire::LinkId link, const pb::Report& report, Effects& effects) {
    if (!roster_.report(link, report)) {
        return;  // said before it heard of its place here
    }
    if (report.phase() == pb::PHASE_WAITING && mapping_) {
        give_orders(static_cast<tree::Place>(report.place()), effects);
    }
}

}  // namespace shearwater::head
