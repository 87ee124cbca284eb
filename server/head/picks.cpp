#include "server/head/picks.h"

#include <algorithm>
#include <limits>

#include "protocol/wire/convert.h"

namespace shearwater::head {

Picks::Begun Picks::begin(wire::LinkId client, const wire::PickRequest& pick,
                          const view::Factorisation& ray) {
    Begun begun{.probe = {}, .ray = ray, .replaced = forget(client)};
    begun.probe.set_number(++last_number_);
    *begun.probe.mutable_factorisation() = wire::to_wire(begun.ray);
    *begun.probe.mutable_transfer_function() = wire::to_wire(pick.tf);
    by_client_[client] = {last_number_,
                          begun.ray,
                          {.revision = pick.revision, .value = std::numeric_limits<double>::quiet_NaN()}};
    return begun;
}

std::optional<std::uint64_t> Picks::forget(wire::LinkId client) {
    const auto found = by_client_.extract(client);
    return found.empty() ? std::nullopt : std::optional(found.mapped().number);
}

Picks::Entry Picks::find(std::uint64_t number) {
    return std::ranges::find_if(by_client_, [&](const auto& entry) { return entry.second.number == number; });
}

std::optional<Picks::Answered> Picks::resolve(const wire::RayPart& part) {
    const Entry found = find(part.number);
    if (found == by_client_.end()) {
        return std::nullopt;
    }
    Pick& pick = found->second;
    pick.answer.hit = view::half_way(pick.ray, part.samples);
    pick.answer.incomplete = part.incomplete;
    Answered answered{pick.number, found->first, pick.answer};
    if (!pick.answer.hit) {
        by_client_.erase(found);
    }
    return answered;
}

std::optional<Picks::Answered> Picks::measured(std::uint64_t number, double value) {
    const Entry found = find(number);
    if (found == by_client_.end()) {
        return std::nullopt;
    }
    Answered answered{number, found->first, found->second.answer};
    answered.answer.value = value;
    by_client_.erase(found);
    return answered;
}

}  // namespace shearwater::head
