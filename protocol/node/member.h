#pragma once
// What every daemon does to belong to a tree: it joins the server, is given a place, keeps a link to its
// parent there, and comes back by itself when either link breaks.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/events.h"

namespace shearwater::node {

struct MemberOptions {
    wire::Address server;
    wire::pb::Role role = wire::pb::ROLE_RENDERER;
    std::string node_name;  // the topology's node to ask for; empty: any
    wire::Address listen;   // compositors: where children reach us; an empty host: as the server sees us
    unsigned threads = 1;
};

class Member {
  public:
    explicit Member(MemberOptions options) : options_(std::move(options)) {}

    // What an event meant for the daemon behind the member.
    enum class News { none, assigned, parent_up, parent_down, refused };

    // Dials the server. Call once.
    void start(std::vector<wire::NetEffect>& effects);

    // Takes what concerns the member itself: its own two links and the passing of time. Messages from
    // the parent, and the server's other than Assign, are left to the caller. After `refused` (a wrong
    // secret, say) the member goes on trying; refusal() says why.
    News handle(const wire::NetEvent& event, wire::Time now, std::vector<wire::NetEffect>& effects);

    bool is_server(wire::LinkId link) const { return server_.up && server_.link == link; }
    bool is_parent(wire::LinkId link) const { return parent_.up && parent_.link == link; }
    bool has_parent() const { return parent_.up; }
    const std::optional<wire::pb::Assign>& assignment() const { return assignment_; }
    const std::string& refusal() const { return refusal_; }

    // Sends to the server or the parent; nothing happens while the link is down.
    void tell_server(wire::Message message, std::vector<wire::NetEffect>& effects) const;
    void tell_parent(wire::Message message, std::vector<wire::NetEffect>& effects) const;

  private:
    struct Uplink {
        wire::LinkId link{};
        bool up = false;
        bool dialling = false;
        std::optional<wire::Time> retry_at;  // once time is known
        int failures = 0;

        bool is(wire::LinkId id) const { return (up || dialling) && link == id; }
    };

    void dial(Uplink& uplink, const wire::Address& address, wire::pb::Role role,
              std::vector<wire::NetEffect>& effects);
    void dial_parent(std::vector<wire::NetEffect>& effects);
    void drop(Uplink& uplink, wire::Time now);
    wire::Address parent_address() const;
    News on_up(const wire::LinkUp& up, std::vector<wire::NetEffect>& effects);
    News on_down(const wire::LinkDown& down, wire::Time now);
    News on_assign(const wire::pb::Assign& assign, std::vector<wire::NetEffect>& effects);
    void on_tick(wire::Time now, std::vector<wire::NetEffect>& effects);

    MemberOptions options_;
    std::uint64_t last_link_ = 0;
    Uplink server_;
    Uplink parent_;
    std::optional<wire::pb::Assign> assignment_;
    std::string refusal_;
};

// Which addresses an Assign that repeats a place leaves alone: everything but parent and mapping equal.
bool same_work(const wire::pb::Assign& a, const wire::pb::Assign& b);

}  // namespace shearwater::node
