#include "compositor/junction/junction.h"

#include "common/volume/levels.h"
#include "protocol/wire/convert.h"

namespace shearwater::junction {

namespace pb = wire::pb;
using namespace std::chrono_literals;
using Counted = node::Branch::Counted;

Effects Junction::start() {
    Effects effects;
    member_.start(effects.net);
    return effects;
}

Effects Junction::handle(const wire::NetEvent& event, wire::Time now) {
    Effects effects;
    switch (member_.handle(event, now, effects.net)) {
        case node::Member::News::assigned:
            on_assigned(effects);
            break;
        case node::Member::News::parent_up:
            send_histogram(Counted::sketches, effects);
            send_histogram(Counted::voxels, effects);
            for (const pb::NeedVoxels& need : branch_.unanswered()) {
                member_.tell_parent(wire::message(need), effects.net);
            }
            break;
        case node::Member::News::parent_down:
            branch_.cancel_all(effects.net);
            break;
        case node::Member::News::none:
        case node::Member::News::refused:
            break;
    }
    if (const auto* received = std::get_if<wire::Received>(&event)) {
        if (member_.is_parent(received->link)) {
            on_parent_message(*received, now, effects);
        } else if (!member_.is_server(received->link)) {
            on_child_message(*received, effects);
        }
    } else if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
        branch_.link_down(down->link);
    } else if (std::holds_alternative<wire::Tick>(event)) {
        branch_.tick(now);
        if (now - last_report_ > 1s) {
            last_report_ = now;
            report(effects);
        }
    }
    for (const Counted counted : {Counted::sketches, Counted::voxels}) {
        if (branch_.take_histogram_news(counted)) {
            send_histogram(counted, effects);
        }
    }
    for (wire::Message& functions : branch_.take_functions()) {
        member_.tell_parent(std::move(functions), effects.net);
    }
    for (const wire::RayPart& part : branch_.take_probed()) {
        member_.tell_parent(wire::message(wire::to_wire(part)), effects.net);
    }
    for (const wire::Reply& reply : branch_.take_replies()) {
        member_.tell_parent(wire::message(wire::to_wire(reply)), effects.net);
    }
    for (node::MergeJob& job : branch_.take_complete()) {
        effects.merges.push_back({std::move(job)});
    }
    return effects;
}

Effects Junction::handle(MergeDone done) {
    Effects effects;
    member_.tell_parent(std::move(done.windows), effects.net);
    return effects;
}

void Junction::on_assigned(Effects& effects) {
    const pb::Assign& assign = *member_.assignment();
    std::vector<node::Branch::ChildSpec> children;
    const auto lattice = wire::lattice_from(assign.cube().lattice());
    for (const pb::Child& child : assign.children()) {
        if (const auto box = wire::box_from(child.box())) {
            const bool in_cube = lattice && volume::whole(lattice->n).contains(*box);
            children.push_back({static_cast<int>(child.place()), *box,
                                in_cube ? volume::nodes_to_make(*box, lattice->n).front() : *box});
        }
    }
    branch_.configure(assign.epoch(), children, effects.net);
    report(effects);
}

void Junction::on_parent_message(const wire::Received& received, wire::Time now, Effects& effects) {
    const wire::Message& message = received.message;
    if (const auto* render = std::get_if<pb::Render>(&message.body)) {
        const auto factorisation = wire::factorisation_from(render->factorisation());
        if (!factorisation) {
            effects.net.emplace_back(
                wire::CloseLink{received.link, factorisation.error().reason, factorisation.error().text});
            return;
        }
        branch_.begin(*factorisation, *render, now, effects.net);
    } else if (const auto* cancel = std::get_if<pb::Cancel>(&message.body)) {
        branch_.cancel(cancel->frame(), effects.net);
    } else if (const auto* probe = std::get_if<pb::Probe>(&message.body)) {
        if (const auto ray = wire::ray_from(*probe)) {
            branch_.probe(*ray, *probe, now, effects.net);
        } else {
            effects.net.emplace_back(wire::CloseLink{received.link, ray.error().reason, ray.error().text});
        }
    } else if (const auto* give = std::get_if<pb::GiveFunctions>(&message.body)) {
        branch_.ask(give->request(), message, now, effects.net);
    } else if (const auto* look = std::get_if<pb::Look>(&message.body)) {
        branch_.ask(look->request(), message, now, effects.net);
    } else if (std::holds_alternative<pb::WantFunctions>(message.body)) {
        branch_.want_functions(message, effects.net);
    } else if (const auto* mapping = std::get_if<pb::SetMapping>(&message.body)) {
        if (mapping->anew()) {
            branch_.forget_sketches();
        }
        branch_.tell_children(message, effects.net);
    } else if (std::holds_alternative<pb::Voxels>(message.body)) {
        branch_.deliver_voxels(message, effects.net);
    }
}

void Junction::on_child_message(const wire::Received& received, Effects& effects) {
    if (const auto* adopt = std::get_if<pb::Adopt>(&received.message.body)) {
        branch_.adopt(received.link, *adopt, effects.net);
    } else if (branch_.is_child(received.link)) {
        if (const auto need = branch_.receive(received.link, received.message, effects.net)) {
            member_.tell_parent(wire::message(*need), effects.net);
        }
    } else {
        effects.net.emplace_back(
            wire::CloseLink{received.link, pb::REASON_BAD_TYPE, "a child says first which place it holds"});
    }
}

void Junction::send_histogram(Counted counted, Effects& effects) {
    if (const auto histogram = branch_.histogram(counted)) {
        pb::HistogramReport report = wire::to_wire(*histogram);
        report.set_sketch(counted == Counted::sketches);
        member_.tell_parent(wire::message(std::move(report)), effects.net);
    }
}

void Junction::report(Effects& effects) {
    if (!member_.assignment()) {
        return;
    }
    pb::Report report;
    report.set_place(member_.assignment()->place());
    report.set_phase(pb::PHASE_READY);
    report.set_fraction(1);
    report.set_memory_bytes(memory_.resident);
    report.set_peak_bytes(memory_.peak);
    report.set_parent_lost(!member_.has_parent());
    member_.tell_server(wire::message(std::move(report)), effects.net);
}

}  // namespace shearwater::junction
