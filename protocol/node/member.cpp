#include "protocol/node/member.h"

#include <google/protobuf/util/message_differencer.h>
#include <algorithm>

namespace shearwater::node {

using namespace std::chrono_literals;

namespace {

std::chrono::milliseconds back_off(int failures) {
    return std::min<std::chrono::milliseconds>(5000ms, 100ms * (1 << std::min(failures, 6)));
}

}  // namespace

void Member::start(std::vector<wire::NetEffect>& effects) {
    dial(server_, options_.server, options_.role, effects);
}

void Member::dial(Uplink& uplink, const wire::Address& address, wire::pb::Role role,
                  std::vector<wire::NetEffect>& effects) {
    uplink.link = wire::LinkId{++last_link_};
    uplink.dialling = true;
    uplink.retry_at.reset();
    effects.push_back(wire::Dial{uplink.link, address, role});
}

wire::Address Member::parent_address() const {
    // No host: the parent is the server itself, as we know it.
    if (assignment_->parent_host().empty()) {
        return options_.server;
    }
    return {assignment_->parent_host(), static_cast<std::uint16_t>(assignment_->parent_port())};
}

void Member::dial_parent(std::vector<wire::NetEffect>& effects) {
    dial(parent_, parent_address(), wire::pb::ROLE_CHILD, effects);
}

Member::News Member::handle(const wire::NetEvent& event, wire::Time now,
                            std::vector<wire::NetEffect>& effects) {
    if (const auto* up = std::get_if<wire::LinkUp>(&event)) {
        return on_up(*up, effects);
    }
    if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
        return on_down(*down, now);
    }
    if (const auto* received = std::get_if<wire::Received>(&event)) {
        const auto* assign = std::get_if<wire::pb::Assign>(&received->message.body);
        return assign != nullptr && is_server(received->link) ? on_assign(*assign, effects) : News::none;
    }
    on_tick(now, effects);
    return News::none;
}

Member::News Member::on_up(const wire::LinkUp& up, std::vector<wire::NetEffect>& effects) {
    if (server_.is(up.link)) {
        server_.up = true;
        server_.dialling = false;
        server_.failures = 0;
        wire::pb::Join join;
        join.set_role(options_.role);
        join.set_listen_host(options_.listen.host);
        join.set_listen_port(options_.listen.port);
        join.set_threads(options_.threads);
        join.set_node_name(options_.node_name);
        tell_server(wire::message(std::move(join)), effects);
        return News::none;
    }
    if (parent_.is(up.link)) {
        parent_.up = true;
        parent_.dialling = false;
        parent_.failures = 0;
        wire::pb::Adopt adopt;
        adopt.set_epoch(assignment_->epoch());
        adopt.set_place(assignment_->place());
        tell_parent(wire::message(std::move(adopt)), effects);
        return News::parent_up;
    }
    return News::none;
}

void Member::drop(Uplink& uplink, wire::Time now) {
    uplink.up = false;
    uplink.dialling = false;
    uplink.retry_at = now + back_off(uplink.failures++);
}

Member::News Member::on_down(const wire::LinkDown& down, wire::Time now) {
    if (server_.is(down.link)) {
        drop(server_, now);
        if (down.reason == wire::pb::REASON_BAD_SECRET || down.reason == wire::pb::REASON_BAD_VERSION ||
            down.reason == wire::pb::REASON_NO_PLACE) {
            refusal_ = down.text;
            return News::refused;
        }
    } else if (parent_.is(down.link)) {
        const bool was_up = parent_.up;
        drop(parent_, now);
        return was_up ? News::parent_down : News::none;
    }
    return News::none;
}

Member::News Member::on_assign(const wire::pb::Assign& assign, std::vector<wire::NetEffect>& effects) {
    const bool parent_stays = assignment_ && assignment_->epoch() == assign.epoch() &&
                              assignment_->place() == assign.place() &&
                              assignment_->parent_host() == assign.parent_host() &&
                              assignment_->parent_port() == assign.parent_port();
    assignment_ = assign;
    if (!parent_stays || !(parent_.up || parent_.dialling)) {
        if (parent_.up || parent_.dialling) {
            effects.push_back(
                wire::CloseLink{parent_.link, wire::pb::REASON_REPLACED, "a new parent was assigned"});
        }
        parent_ = {};
        dial_parent(effects);
    }
    return News::assigned;
}

void Member::on_tick(wire::Time now, std::vector<wire::NetEffect>& effects) {
    if (!server_.up && !server_.dialling && server_.retry_at && now >= *server_.retry_at) {
        dial(server_, options_.server, options_.role, effects);
    }
    if (!parent_.up && !parent_.dialling && parent_.retry_at && now >= *parent_.retry_at) {
        dial_parent(effects);
    }
}

void Member::tell_server(wire::Message message, std::vector<wire::NetEffect>& effects) const {
    if (server_.up) {
        effects.push_back(wire::Send{server_.link, std::move(message)});
    }
}

void Member::tell_parent(wire::Message message, std::vector<wire::NetEffect>& effects) const {
    if (parent_.up) {
        effects.push_back(wire::Send{parent_.link, std::move(message)});
    }
}

bool same_work(const wire::pb::Assign& a, const wire::pb::Assign& b) {
    using google::protobuf::util::MessageDifferencer;
    return MessageDifferencer::Equals(a.box(), b.box()) && MessageDifferencer::Equals(a.cube(), b.cube()) &&
           a.bits() == b.bits() && a.copies() == b.copies();
}

}  // namespace shearwater::node
