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
    if (limits_.range) {
        mapping_ = volume::Mapping{.lo = limits_.range->lo,
                                   .hi = limits_.range->hi,
                                   .stretch = limits_.stretch,
                                   .bits = limits_.bits};
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
    if (auto* looked = std::get_if<Looked>(&event)) {
        on_looked(std::move(*looked), now, effects);
        collect(now, effects);
        return effects;
    }
    auto& finished = std::get<Finished>(event);
    const auto frame = frames_.find(finished.number);
    if (frame == frames_.end()) {
        return effects;  // its client has gone
    }
    const wire::LinkId client = frame->second.client;
    frames_.erase(frame);
    if (const auto session = sessions_.find(client); session != sessions_.end()) {
        tell_state(effects);  // what is known of the tree is as new as the picture
        session->second.incomplete = std::get<pb::Frame>(finished.frame.body).missing_size() > 0;
        effects.net.emplace_back(wire::Send{client, std::move(finished.frame)});
        begin_frames(client, session->second, now, effects);
        collect(now, effects);
    }
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

void Head::on_client_message(Session& session, const wire::Received& received, wire::Time now,
                             Effects& effects) {
    if (const auto* wanted = std::get_if<pb::SetView>(&received.message.body)) {
        auto view = wire::view_from(*wanted);
        if (!view) {
            on_link_down(received.link, effects);
            fault(received.link, view.error(), effects);
            return;
        }
        session.wanted = *std::move(view);
        session.asked = now;
        give_up_refinements(received.link, session, effects);
        begin_frames(received.link, session, now, effects);
    } else if (const auto* shown = std::get_if<pb::FrameShown>(&received.message.body)) {
        std::erase(session.in_flight, shown->number());
        begin_frames(received.link, session, now, effects);
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

// Of a session's frames those that are still drawn and need not be.
template <class Which>
void Head::give_up_frames(Session& session, const Which& which, Effects& effects) {
    std::erase_if(frames_, [&](const auto& entry) {
        const auto& [number, frame] = entry;
        const bool is_left = !frame.merged && which(frame);
        if (is_left) {
            give_up(number, frame, effects);
            std::erase(session.in_flight, number);
        }
        return is_left;
    });
}

// A view that is wanted in a lower quality than one under way has begun to move, and need not wait for what
// is no longer looked at. Views of the same quality are left: else none of a drag's would be finished.
void Head::give_up_refinements(wire::LinkId client, Session& session, Effects& effects) {
    const auto is_finer = [&](const FrameInWork& frame) {
        return frame.client == client &&
               static_cast<int>(frame.view->quality) > static_cast<int>(session.wanted->quality);
    };
    give_up_frames(session, is_finer, effects);
}

// All is loaded. Whoever has looked at the sketch is to see the cube.
void Head::begin_serving(wire::Time now, Effects& effects) {
    serving_ = true;
    for (auto& [link, session] : sessions_) {
        if (!session.sketched) {
            continue;
        }
        const auto is_sketch = [&](const FrameInWork& frame) { return frame.client == link && frame.sketch; };
        give_up_frames(session, is_sketch, effects);
        if (!session.wanted) {
            session.wanted = session.latest;
            session.asked = now;
        }
    }
}

std::optional<volume::Mapping> Head::sketch_for(const wire::View& view) const {
    if (serving_ || !sketch_ || !view.sketch) {
        return std::nullopt;
    }
    return mapping_ ? mapping_ : sketch_;
}

void Head::give_up(std::uint64_t number, const FrameInWork& frame, Effects& effects) {
    branch_.cancel(number, effects.net);
    if (frame.begun && !frame.merged) {
        effects.jobs.emplace_back(GiveUp{number});
    }
}

void Head::begin_frames(wire::LinkId client, Session& session, wire::Time now, Effects& effects) {
    while (session.wanted && session.in_flight.size() < frames_in_flight) {
        const std::optional<volume::Mapping> sketch = sketch_for(*session.wanted);
        if (!serving_ && !sketch) {
            return;
        }
        session.latest = std::exchange(session.wanted, std::nullopt);
        session.begun = now;
        session.sketched = sketch.has_value();
        const wire::View& view = *session.latest;
        view::Factorisation factorisation = view::factorise(
            view.camera, view.size, roster_.cube().lattice,
            view::sampling(view.quality, view.level_of_detail.value_or(limits_.level_of_detail),
                           view.classify));
        pb::Render render;
        if (sketch) {
            factorisation.slice_exponent = roster_.cube().sketch_level;
            factorisation.classify = view::Classify::post;
            *render.mutable_sketch() = wire::to_wire(*sketch);
        }
        render.set_frame(++last_frame_);
        *render.mutable_factorisation() = wire::to_wire(factorisation);
        *render.mutable_transfer_function() = wire::to_wire(view.tf);
        frames_.emplace(last_frame_, FrameInWork{.client = client,
                                                 .view = std::make_shared<const wire::View>(view),
                                                 .asked = session.asked,
                                                 .sketch = sketch.has_value()});
        session.in_flight.push_back(last_frame_);
        if (!sketch && can_cull(client, view, factorisation.level())) {
            FrameInWork& frame = frames_.at(last_frame_);
            frame.render = std::move(render);
            frame.factorisation = factorisation;
            effects.jobs.emplace_back(Look{last_frame_, std::move(factorisation), view.tf, view.culling});
        } else {
            branch_.begin(factorisation, render, now, effects.net);
        }
    }
}

void Head::collect(wire::Time now, Effects& effects) {
    settle_functions(now, effects);
    settle_sketch(now, effects);
    settle_mapping(effects);
    for (node::MergeJob& job : branch_.take_complete()) {
        const auto found = frames_.find(job.frame->number);
        if (found == frames_.end()) {
            continue;
        }
        FrameInWork& frame = found->second;
        frame.begun = true;
        if (job.last()) {
            frame.merged = true;
            effects.jobs.emplace_back(Finish{std::move(job), frame.view, frame.asked, frame.sketch});
        } else {
            effects.jobs.emplace_back(Lay{std::move(job), frame.view});
        }
    }
}

}  // namespace shearwater::head
