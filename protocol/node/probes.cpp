#include "protocol/node/probes.h"

#include <algorithm>

namespace shearwater::node {

void Probes::begin(std::uint64_t number, const view::Factorisation& ray, std::set<std::size_t> children,
                   bool incomplete, wire::Time now) {
    if (pending_.size() >= most_pending) {
        pending_.begin()->second.part.incomplete = true;
        finish(pending_.begin());
    }
    const auto entry = pending_.insert_or_assign(number, Pending{.part = {number, {}, incomplete},
                                                                 .sign = ray.faces[0].sign,
                                                                 .waiting = std::move(children),
                                                                 .since = now});
    if (entry.first->second.waiting.empty()) {
        finish(entry.first);
    }
}

Probes::Entry Probes::finish(Entry entry) {
    complete_.push_back(std::move(entry->second.part));
    return pending_.erase(entry);
}

// A ray meets a sub-volume's slices one after another, and no other's between them: their order is that of
// visibility. Should two children claim a slice, one of them has it.
void Probes::answer(std::size_t child, const wire::RayPart& part) {
    const auto found = pending_.find(part.number);
    if (found == pending_.end() || found->second.waiting.erase(child) == 0) {
        return;
    }
    Pending& pending = found->second;
    const auto before = [&](const view::RaySample& a, const view::RaySample& b) {
        return pending.sign > 0 ? a.slice < b.slice : a.slice > b.slice;
    };
    std::vector<view::RaySample>& all = pending.part.samples;
    const auto own = static_cast<std::ptrdiff_t>(all.size());
    all.insert(all.end(), part.samples.begin(), part.samples.end());
    std::sort(all.begin() + own, all.end(), before);
    std::inplace_merge(all.begin(), all.begin() + own, all.end(), before);
    const auto repeated = std::ranges::unique(all, {}, &view::RaySample::slice);
    all.erase(repeated.begin(), repeated.end());
    all.resize(std::min(all.size(), wire::most_ray_samples));
    pending.part.incomplete = pending.part.incomplete || part.incomplete;
    if (pending.waiting.empty()) {
        finish(found);
    }
}

template <class Which>
void Probes::give_up_where(const Which& which) {
    for (auto entry = pending_.begin(); entry != pending_.end();) {
        Pending& pending = entry->second;
        const std::size_t given_up =
            std::erase_if(pending.waiting, [&](std::size_t child) { return which(child, pending.since); });
        pending.part.incomplete = pending.part.incomplete || given_up > 0;
        entry = given_up > 0 && pending.waiting.empty() ? finish(entry) : std::next(entry);
    }
}

void Probes::child_gone(std::size_t child) {
    give_up_where([child](std::size_t waiting, wire::Time) { return waiting == child; });
}

void Probes::tick(wire::Time now) {
    give_up_where([now](std::size_t, wire::Time since) { return now - since > patience; });
}

}  // namespace shearwater::node
