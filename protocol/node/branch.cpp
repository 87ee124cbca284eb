#include "protocol/node/branch.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "protocol/wire/convert_culling.h"

namespace shearwater::node {

using wire::NetEffect;

namespace {

auto& of(Branch::Counted counted, auto& each) {
    return each[static_cast<std::size_t>(counted)];
}

}  // namespace

void Branch::configure(std::uint64_t epoch, const std::vector<ChildSpec>& specs,
                       std::vector<NetEffect>& effects) {
    std::vector<Child> children;
    for (const ChildSpec& spec : specs) {
        children.push_back({.spec = spec, .link = {}, .histograms = {}});
    }
    const bool same =
        epoch == epoch_ && std::ranges::equal(children, children_, {}, &Child::spec, &Child::spec);
    if (same) {
        return;
    }
    cancel_all(effects);
    wanted_.reset();
    for (const Child& old : children_) {
        if (old.link) {
            effects.push_back(wire::CloseLink{*old.link, wire::pb::REASON_REPLACED, "the tree has changed"});
        }
    }
    epoch_ = epoch;
    children_ = std::move(children);
    voxel_routes_.clear();
}

const Branch::Child* Branch::child_of(wire::LinkId link) const {
    const auto found = std::ranges::find(children_, std::optional{link}, &Child::link);
    return found == children_.end() ? nullptr : &*found;
}

std::size_t Branch::index_of(const Child& child) const {
    return static_cast<std::size_t>(&child - children_.data());
}

int Branch::adopt(wire::LinkId link, const wire::pb::Adopt& adopt, std::vector<NetEffect>& effects) {
    const auto found = std::ranges::find_if(
        children_, [&](const Child& child) { return std::cmp_equal(child.spec.place, adopt.place()); });
    if (adopt.epoch() != epoch_ || found == children_.end() || is_child(link)) {
        effects.push_back(wire::CloseLink{link, wire::pb::REASON_NO_PLACE, "no such child is expected here"});
        return -1;
    }
    if (found->link) {
        const wire::LinkId old = *found->link;
        link_down(old);
        effects.push_back(
            wire::CloseLink{old, wire::pb::REASON_REPLACED, "the child has come back on a new link"});
    }
    found->link = link;
    if (wanted_) {
        effects.push_back(wire::Send{link, *wanted_});
    }
    return found->spec.place;
}

void Branch::begin(const view::Factorisation& factorisation, const wire::pb::Render& render, wire::Time now,
                   std::vector<NetEffect>& effects) {
    if (pending_.size() >= max_pending) {
        const std::uint64_t oldest = pending_.begin()->first;
        cancel(oldest, effects);
    }
    std::vector<volume::Box> boxes;
    std::ranges::transform(children_, std::back_inserter(boxes), [](const Child& c) { return c.spec.box; });
    Pending pending{
        .frame = std::make_shared<MergedFrame>(render.frame(), factorisation, view::bands_of(factorisation)),
        .order = view::visibility_order(factorisation, boxes),
        .parts = std::vector<Part>(children_.size()),
        .account = {},
        .waiting = {},
        .passed_on = 0,
        .since = now};
    const wire::Message message = wire::message(render);
    for (std::size_t i = 0; i < children_.size(); ++i) {
        if (children_[i].link) {
            pending.waiting.insert(i);
            effects.push_back(wire::Send{*children_[i].link, message});
        } else {
            give_up(pending, i);
        }
    }
    pending_.insert_or_assign(render.frame(), std::move(pending));
    pass_on(render.frame());
}

void Branch::cancel(std::uint64_t frame, std::vector<NetEffect>& effects) {
    const auto found = pending_.find(frame);
    if (found == pending_.end()) {
        return;
    }
    wire::pb::Cancel cancel;
    cancel.set_frame(frame);
    for (const std::size_t index : found->second.waiting) {
        if (const auto link = children_[index].link) {
            effects.push_back(wire::Send{*link, wire::message(cancel)});
        }
    }
    pending_.erase(found);
}

void Branch::cancel_all(std::vector<NetEffect>& effects) {
    probes_.forget_all();
    replies_.forget_all();
    while (!pending_.empty()) {
        const std::uint64_t frame = pending_.begin()->first;
        cancel(frame, effects);
    }
}

void Branch::give_up(Pending& pending, std::size_t index) const {
    const ChildSpec& spec = children_[index].spec;
    pending.waiting.erase(index);
    pending.parts[index].known = pending.frame->bands.size();
    pending.parts[index].given_up = true;
    pending.account.missing.push_back({spec.place, spec.box});
}

void Branch::pass_on(std::uint64_t frame) {
    const auto found = pending_.find(frame);
    if (found == pending_.end()) {
        return;
    }
    Pending& pending = found->second;
    std::size_t known = pending.frame->bands.size();
    for (const Part& part : pending.parts) {
        known = std::min(known, part.known);
    }
    while (pending.passed_on < known) {
        complete_.push_back(take_bands(pending, known));
    }
    if (pending.waiting.empty()) {
        if (pending.frame->bands.empty()) {
            complete_.push_back(take_bands(pending, 0));
        }
        complete_.back().account = std::move(pending.account);
        pending_.erase(found);
    }
}

// Up to the first band that somebody has something in.
MergeJob Branch::take_bands(Pending& pending, std::size_t known) {
    MergeJob job{.frame = pending.frame, .first = pending.passed_on, .end = pending.passed_on};
    while (job.end < known && job.windows.empty()) {
        for (const int child : pending.order) {
            auto& windows = pending.parts[static_cast<std::size_t>(child)].windows;
            if (const auto found = windows.find(job.end); found != windows.end()) {
                job.windows.push_back(found->second.window);
                job.payloads.push_back(std::move(found->second.payload));
                windows.erase(found);
            }
        }
        ++job.end;
    }
    pending.passed_on = job.end;
    return job;
}

std::vector<MergeJob> Branch::take_complete() {
    return std::exchange(complete_, {});
}

void Branch::link_down(wire::LinkId link) {
    const Child* const child = child_of(link);
    if (child == nullptr) {
        return;
    }
    const std::size_t index = index_of(*child);
    children_[index].link.reset();
    probes_.child_gone(index);
    replies_.child_gone(index);
    std::erase_if(voxel_routes_, [&](const auto& route) { return route.second.link == link; });
    std::vector<std::uint64_t> touched;
    for (auto& [frame, pending] : pending_) {
        if (pending.waiting.contains(index)) {
            give_up(pending, index);
            touched.push_back(frame);
        }
    }
    std::ranges::for_each(touched, [this](std::uint64_t frame) { pass_on(frame); });
}

void Branch::tick(wire::Time now) {
    probes_.tick(now);
    replies_.tick(now);
    std::vector<std::uint64_t> late;
    for (auto& [frame, pending] : pending_) {
        if (now - pending.since > patience) {
            while (!pending.waiting.empty()) {
                give_up(pending, *pending.waiting.begin());
            }
            late.push_back(frame);
        }
    }
    std::ranges::for_each(late, [this](std::uint64_t frame) { pass_on(frame); });
}

void Branch::fault(wire::LinkId link, const wire::Fault& fault, std::vector<NetEffect>& effects) {
    link_down(link);
    effects.push_back(wire::CloseLink{link, fault.reason, fault.text});
}

std::optional<wire::pb::NeedVoxels> Branch::receive(wire::LinkId link, const wire::Message& message,
                                                    std::vector<NetEffect>& effects) {
    const Child* const child = child_of(link);
    base::check(child != nullptr, "a message was taken for a child's");
    if (std::holds_alternative<wire::pb::Windows>(message.body)) {
        on_windows(*child, message, effects);
    } else if (const auto* report = std::get_if<wire::pb::HistogramReport>(&message.body)) {
        on_histogram(index_of(*child), *report, effects);
    } else if (std::holds_alternative<wire::pb::Functions>(message.body)) {
        if (const auto part = wire::functions_from(message)) {
            functions_.push_back(message);
        } else {
            fault(link, part.error(), effects);
        }
    } else if (const auto* probed = std::get_if<wire::pb::Probed>(&message.body)) {
        on_probed(*child, *probed, effects);
    } else if (const auto* replied = std::get_if<wire::pb::Replied>(&message.body)) {
        on_replied(*child, *replied, effects);
    } else if (const auto* need = std::get_if<wire::pb::NeedVoxels>(&message.body)) {
        const auto box = wire::box_from(need->box());
        if (!box || !child->spec.reads.contains(*box)) {
            fault(link, {wire::pb::REASON_INVALID, "voxels were asked for outside what the child reads"},
                  effects);
            return std::nullopt;
        }
        voxel_routes_.insert_or_assign(static_cast<int>(need->place()), VoxelRoute{link, *need});
        return *need;
    } else {
        fault(link,
              {wire::pb::REASON_BAD_TYPE, "a child does not send " + std::string(wire::name(message.body))},
              effects);
    }
    return std::nullopt;
}

void Branch::on_windows(const Child& child, const wire::Message& message, std::vector<NetEffect>& effects) {
    const auto& body = std::get<wire::pb::Windows>(message.body);
    const auto found = pending_.find(body.frame());
    const std::size_t index = index_of(child);
    if (found == pending_.end() || found->second.parts[index].given_up) {
        return;  // it is cancelled, or goes on without
    }
    Pending& pending = found->second;
    Part& part = pending.parts[index];
    if (!pending.waiting.contains(index)) {
        fault(*child.link, {wire::pb::REASON_INVALID, "windows: all of the frame's bands were known"},
              effects);
        return;
    }
    auto windows = wire::windows_from(message, pending.frame->bands, part.known);
    if (!windows) {
        fault(*child.link, windows.error(), effects);
        return;
    }
    std::vector<Missing> missing;
    for (const wire::pb::Missing& entry : body.missing()) {
        const auto box = wire::box_from(entry.box());
        if (!box) {
            fault(*child.link, box.error(), effects);
            return;
        }
        missing.push_back({static_cast<int>(entry.place()), *box});
    }
    part.known = windows->bands;
    if (!windows->window.rect.empty()) {
        part.windows.emplace(windows->bands - 1, Waiting{windows->window, message.payload});
    }
    wire::pb::LeafStats& stats = pending.account.stats;
    stats.set_window_bytes(stats.window_bytes() + message.payload_size());
    if (part.known == pending.frame->bands.size()) {
        pending.waiting.erase(index);
        pending.account.missing.insert(pending.account.missing.end(), missing.begin(), missing.end());
        add(body.stats(), stats);
    }
    pass_on(body.frame());
}

void Branch::on_histogram(std::size_t index, const wire::pb::HistogramReport& report,
                          std::vector<NetEffect>& effects) {
    auto histogram = wire::histogram_from(report);
    if (!histogram) {
        fault(*children_[index].link, histogram.error(), effects);
        return;
    }
    const auto counted = report.sketch() ? Counted::sketches : Counted::voxels;
    of(counted, children_[index].histograms) = *std::move(histogram);
    of(counted, histogram_news_) = true;
}

std::optional<volume::Histogram> Branch::histogram(Counted counted) const {
    volume::Histogram sum;
    for (const Child& child : children_) {
        if (!of(counted, child.histograms)) {
            return std::nullopt;
        }
        sum.merge(*of(counted, child.histograms));
    }
    return sum;
}

void Branch::forget_sketches() {
    for (Child& child : children_) {
        of(Counted::sketches, child.histograms).reset();
    }
    of(Counted::sketches, histogram_news_) = false;
}

bool Branch::take_histogram_news(Counted counted) {
    return std::exchange(of(counted, histogram_news_), false);
}

void Branch::tell_children(const wire::Message& message, std::vector<NetEffect>& effects) const {
    for (const Child& child : children_) {
        if (child.link) {
            effects.push_back(wire::Send{*child.link, message});
        }
    }
}

void Branch::want_functions(const wire::Message& wanted, std::vector<NetEffect>& effects) {
    wanted_ = wanted;
    tell_children(wanted, effects);
}

void Branch::deliver_voxels(const wire::Message& voxels, std::vector<NetEffect>& effects) {
    const auto place = static_cast<int>(std::get<wire::pb::Voxels>(voxels.body).place());
    const auto route = voxel_routes_.find(place);
    if (route != voxel_routes_.end()) {
        effects.push_back(wire::Send{route->second.link, voxels});
        route->second.unanswered.reset();
    }
}

std::vector<wire::pb::NeedVoxels> Branch::unanswered() const {
    std::vector<wire::pb::NeedVoxels> needs;
    for (const auto& [place, route] : voxel_routes_) {
        if (route.unanswered) {
            needs.push_back(*route.unanswered);
        }
    }
    return needs;
}

}  // namespace shearwater::node
