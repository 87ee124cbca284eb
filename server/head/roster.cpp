#include "server/head/roster.h"

#include <algorithm>
#include <utility>

#include "protocol/wire/convert.h"

namespace shearwater::head {

namespace pb = wire::pb;

namespace {

pb::Role wire_role(tree::Role role) {
    return role == tree::Role::renderer ? pb::ROLE_RENDERER : pb::ROLE_COMPOSITOR;
}

}  // namespace

Roster::Roster(tree::Plan plan, CubeFacts cube, std::uint64_t epoch, int bits)
    : plan_(std::move(plan)),
      cube_(std::move(cube)),
      epoch_(epoch),
      bits_(bits),
      holders_(plan_.nodes.size()) {}

std::optional<tree::Place> Roster::place_of(wire::LinkId link) const {
    const auto found = std::ranges::find(holders_, std::optional{link}, &Holder::link);
    if (found == holders_.end()) {
        return std::nullopt;
    }
    return static_cast<tree::Place>(found - holders_.begin());
}

std::optional<tree::Place> Roster::join(wire::LinkId link, const pb::Join& join, const wire::LinkUp& peer) {
    std::optional<tree::Place> chosen;
    for (std::size_t i = 1; i < holders_.size(); ++i) {
        const tree::NodeSpec& spec = plan_.nodes[i].spec;
        const bool wanted = join.node_name().empty() || join.node_name() == spec.name;
        if (!holders_[i].link && wire_role(spec.role) == join.role() && wanted && !chosen) {
            chosen = static_cast<tree::Place>(i);
        }
    }
    if (!chosen || holds_place(link)) {
        return std::nullopt;
    }
    Holder& holder = at(*chosen);
    holder = {};
    holder.link = link;
    holder.name = peer.peer_name;
    holder.host = peer.peer_host;
    holder.listen = {join.listen_host().empty() ? peer.peer_host : join.listen_host(),
                     static_cast<std::uint16_t>(join.listen_port())};
    holder.report.set_phase(pb::PHASE_JOINED);
    holder.report.set_parent_lost(true);
    news_ = true;
    return chosen;
}

std::optional<tree::Place> Roster::leave(wire::LinkId link) {
    const auto place = place_of(link);
    if (place) {
        at(*place) = {};
        news_ = true;
    }
    return place;
}

bool Roster::report(wire::LinkId link, const pb::Report& report) {
    const auto place = place_of(link);
    if (!place || !std::cmp_equal(*place, report.place())) {
        return false;
    }
    at(*place).report = report;
    check_loaded(at(*place), *place);
    news_ = true;
    return true;
}

void Roster::expect(const volume::Mapping& mapping) {
    expected_ = wire::to_wire(mapping);
    for (std::size_t i = 1; i < holders_.size(); ++i) {
        check_loaded(holders_[i], static_cast<tree::Place>(i));
    }
    news_ = true;
}

// What a renderer said before it heard of the mapping does not make it ready.
void Roster::check_loaded(Holder& holder, tree::Place place) const {
    const bool is_renderer = plan_.at(place).spec.role == tree::Role::renderer;
    if (is_renderer && expected_ && holder.report.phase() == pb::PHASE_READY &&
        holder.report.loaded().SerializeAsString() != expected_->SerializeAsString()) {
        holder.report.set_phase(pb::PHASE_LOADING);
        holder.report.set_fraction(0);
    }
}

std::optional<Roster::Order> Roster::order_for(tree::Place place,
                                               const std::optional<volume::Mapping>& mapping) const {
    const Holder& holder = at(place);
    if (!holder.link) {
        return std::nullopt;
    }
    Order order{.link = *holder.link, .assign = {}};
    order.assign.set_epoch(epoch_);
    order.assign.set_place(static_cast<std::uint32_t>(place));
    if (const tree::Place parent = plan_.at(place).spec.parent; parent != 0) {
        if (!at(parent).link) {
            return std::nullopt;
        }
        order.assign.set_parent_host(at(parent).listen.host);
        order.assign.set_parent_port(at(parent).listen.port);
    }
    describe_work(place, order.assign);
    if (mapping) {
        *order.assign.mutable_mapping() = wire::to_wire(*mapping);
    }
    return order;
}

void Roster::describe_work(tree::Place place, pb::Assign& assign) const {
    const tree::PlannedNode& node = plan_.at(place);
    *assign.mutable_box() = wire::to_wire(node.box);
    assign.set_bits(static_cast<std::uint32_t>(bits_));
    assign.set_copies(static_cast<std::uint32_t>(cube_.copies));
    for (const tree::Place child : node.children) {
        pb::Child* const entry = assign.add_children();
        entry->set_place(static_cast<std::uint32_t>(child));
        *entry->mutable_box() = wire::to_wire(plan_.at(child).box);
    }
    pb::CubeSource* const source = assign.mutable_cube();
    source->set_path(cube_.path);
    source->set_hdu(static_cast<std::uint32_t>(cube_.hdu));
    source->set_plane(cube_.plane);
    *source->mutable_lattice() = wire::to_wire(cube_.lattice);
}

bool Roster::all_ready() const {
    return std::all_of(holders_.begin() + 1, holders_.end(), [](const Holder& holder) {
        return holder.link && holder.report.phase() == pb::PHASE_READY && !holder.report.parent_lost();
    });
}

bool Roster::all_settled() const {
    return std::all_of(holders_.begin() + 1, holders_.end(), [](const Holder& holder) {
        const pb::Phase phase = holder.report.phase();
        return holder.link && !holder.report.parent_lost() &&
               (phase == pb::PHASE_READY || phase == pb::PHASE_FAILED);
    });
}

bool Roster::any_elsewhere() const {
    return std::ranges::any_of(holders_, [](const Holder& holder) {
        const bool is_here =
            holder.host.starts_with("127.") || holder.host == "::1" || holder.host.starts_with("::ffff:127.");
        return holder.link && !is_here;
    });
}

pb::TreeState Roster::state() const {
    pb::TreeState state;
    state.set_ready(all_ready());
    for (std::size_t i = 0; i < holders_.size(); ++i) {
        const tree::PlannedNode& node = plan_.nodes[i];
        const Holder& holder = holders_[i];
        pb::Node* const entry = state.add_nodes();
        entry->set_place(static_cast<std::uint32_t>(i));
        entry->set_parent(node.spec.parent);
        entry->set_role(wire_role(node.spec.role));
        entry->set_name(holder.name.empty() ? node.spec.name : node.spec.name + " (" + holder.name + ")");
        *entry->mutable_box() = wire::to_wire(node.box);
        entry->set_phase(i == 0 ? pb::PHASE_READY : holder.report.phase());
        entry->set_fraction(i == 0 ? 1 : holder.report.fraction());
        entry->set_memory_bytes(holder.report.memory_bytes());
        entry->set_peak_bytes(holder.report.peak_bytes());
        entry->set_error(holder.report.error());
    }
    return state;
}

bool Roster::take_news() {
    return std::exchange(news_, false);
}

}  // namespace shearwater::head
