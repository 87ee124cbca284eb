#include "server/head/head.h"

#include <algorithm>

#include "common/view/factorisation.h"
#include "common/volume/levels.h"

namespace shearwater::head {

namespace pb = wire::pb;
using namespace std::chrono_literals;

Head::Head(Roster roster, Limits limits)
    : roster_(std::move(roster)), limits_(limits), functions_(roster_.plan().renderers_below(0).size()) {
    std::vector<node::Branch::ChildSpec> children;
    for (const tree::Place child : roster_.plan().at(0).children) {
        const volume::Box& box = roster_.plan().at(child).box;
        children.push_back({child, box, volume::nodes_to_make(box, roster_.cube().lattice.n).front()});
    }
    std::vector<wire::NetEffect> none;
    branch_.configure(roster_.epoch(), children, none);
    mapping_ = own_mapping();
    if (mapping_) {
        roster_.expect(*mapping_);
    }
}

Effects Head::handle(const wire::NetEvent& event, wire::Time now) {
    Effects effects;
    if (const auto* up = std::get_if<wire::LinkUp>(&event)) {
        on_link_up(*up, effects);
    } else if (const auto* received = std::get_if<wire::Received>(&event)) {
        on_received(*received, now, effects);
    } else if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
        on_link_down(down->link, effects);
    } else {
        on_tick(now, effects);
    }
    collect(now, effects);
    return effects;
}

Effects Head::handle(JobEvent event, wire::Time now) {
    Effects effects;
    if (auto* read = std::get_if<VoxelsRead>(&event)) {
        branch_.deliver_voxels(read->voxels, effects.net);
        return effects;
    }
    if (const auto* measured = std::get_if<Measured>(&event)) {
        on_measured(*measured, effects);
        return effects;
    }
    if (const auto* looked = std::get_if<node::Looked>(&event)) {
        on_looked(looked->number, looked->visible, now, effects);
        collect(now, effects);
        return effects;
    }
    if (auto* given = std::get_if<Given>(&event)) {
        on_given(std::move(*given), now, effects);
        collect(now, effects);
        return effects;
    }
    on_finished(std::move(std::get<Finished>(event)), now, effects);
    return effects;
}

void Head::on_link_up(const wire::LinkUp& up, Effects& effects) {
    switch (up.role) {
        case pb::ROLE_CLIENT:
            if (sessions_.size() >= max_clients) {
                fault(up.link, {pb::REASON_TOO_MANY_LINKS, "the server has as many clients as it takes"},
                      effects);
                break;
            }
            sessions_[up.link];
            effects.net.emplace_back(wire::Send{up.link, wire::message(roster_.state())});
            describe_cube(up.link, effects);
            break;
        case pb::ROLE_RENDERER:
        case pb::ROLE_COMPOSITOR:
            joining_.emplace(up.link, up);
            break;
        default:
            break;  // a child says which by Adopt
    }
}

void Head::on_received(const wire::Received& received, wire::Time now, Effects& effects) {
    const wire::LinkId link = received.link;
    const wire::Body& body = received.message.body;
    if (const auto session = sessions_.find(link); session != sessions_.end()) {
        on_client_message(session->second, received, now, effects);
    } else if (branch_.is_child(link)) {
        if (const auto need = branch_.receive(link, received.message, effects.net)) {
            effects.jobs.emplace_back(ReadVoxels{*need});
        }
    } else if (const auto* adopt = std::get_if<pb::Adopt>(&body)) {
        branch_.adopt(link, *adopt, effects.net);
    } else if (const auto* join = std::get_if<pb::Join>(&body)) {
        on_join(link, *join, effects);
    } else if (const auto* report = std::get_if<pb::Report>(&body)) {
        on_report(link, *report, effects);
    } else {
        fault(link, {pb::REASON_BAD_TYPE, std::string(wire::name(body)) + " has no business on this link"},
              effects);
    }
}

void Head::fault(wire::LinkId link, const wire::Fault& fault, Effects& effects) {
    effects.net.emplace_back(wire::CloseLink{link, fault.reason, fault.text});
}

void Head::on_client_message(Session& session, const wire::Received& received, wire::Time now,
                             Effects& effects) {
    if (const auto* wanted = std::get_if<pb::SetView>(&received.message.body)) {
        auto view = wire::view_from(*wanted);
        if (!view) {
            on_link_down(received.link, effects);
            fault(received.link, view.error(), effects);
            return;
        }
        if (view->crop) {
            if (const auto fits = view::validate_crop(*view->crop, roster_.cube().lattice.n); !fits) {
                on_link_down(received.link, effects);
                fault(received.link, {pb::REASON_INVALID, fits.error().message()}, effects);
                return;
            }
        }
        session.wanted = *std::move(view);
        session.asked = now;
        on_scaling(session, session.wanted->scaling, now, effects);
        give_up_refinements(received.link, session, effects);
        begin_frames(received.link, session, now, effects);
    } else if (const auto* shown = std::get_if<pb::FrameShown>(&received.message.body)) {
        std::erase(session.in_flight, shown->number());
        begin_frames(received.link, session, now, effects);
    } else if (const auto* pick = std::get_if<pb::Pick>(&received.message.body)) {
        on_pick(received.link, *pick, now, effects);
    } else {
        const std::string name(wire::name(received.message.body));
        on_link_down(received.link, effects);
        fault(received.link, {pb::REASON_BAD_TYPE, "a client does not send " + name}, effects);
    }
}

void Head::on_link_down(wire::LinkId link, Effects& effects) {
    joining_.erase(link);
    branch_.link_down(link);
    roster_.leave(link);
    functions_.forget(link);
    forget_picks(link);
    if (sessions_.erase(link) > 0) {
        std::erase_if(frames_, [&](const auto& entry) {
            const bool gone = entry.second.client == link;
            if (gone) {
                give_up(entry.first, entry.second, effects);
            }
            return gone;
        });
    }
}

void Head::on_tick(wire::Time now, Effects& effects) {
    branch_.tick(now);
    if (!serving_ && mapping_ && roster_.all_settled()) {
        begin_serving(now, effects);
    }
    for (auto& [link, session] : sessions_) {
        // What was missing has come back: the same view once more, whole.
        const bool again = session.incomplete && !session.wanted && session.in_flight.empty() &&
                           session.latest && roster_.all_ready() && now - session.begun > 500ms;
        if (again) {
            session.wanted = session.latest;
            session.asked = now;
        }
        begin_frames(link, session, now, effects);
    }
    if (now - last_state_ > 250ms) {
        last_state_ = now;
        tell_state(effects);
    }
}

void Head::tell_state(Effects& effects) {
    if (!roster_.take_news()) {
        return;
    }
    const wire::Message state = wire::message(roster_.state());
    for (const auto& [link, session] : sessions_) {
        effects.net.emplace_back(wire::Send{link, state});
    }
}

}  // namespace shearwater::head
