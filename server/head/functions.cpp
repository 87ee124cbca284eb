#include "server/head/functions.h"

#include <algorithm>
#include <utility>

namespace shearwater::head {

namespace pb = wire::pb;
using culling::FunctionKey;

namespace {

constexpr int all_directions =
    culling::DirectionGrid::default_side * culling::DirectionGrid::default_side / 2;

}  // namespace

Functions::Needed Functions::need(wire::LinkId client, const view::TransferFunction& tf, culling::Kind kind,
                                  int level) {
    ++clock_;
    std::vector<culling::Basis> bases;
    std::vector<FunctionKey> keys;
    for (const culling::Member& member : culling::members_of(tf)) {
        bases.push_back(member.basis);
    }
    for (const culling::Footprint footprint : culling::footprints_of(kind)) {
        for (const culling::Basis& basis : bases) {
            keys.push_back({footprint, basis, level});
        }
    }
    Need& need = needs_[client];
    if (need.bases != bases || need.kind != kind) {
        need = {std::move(bases), kind, {}};
        news_ = fresh_ = true;
    }
    Needed needed{.all = true};
    for (const FunctionKey& key : keys) {
        Entry& of = entry(key);
        of.used = clock_;
        needed.any = needed.any || of.any;
        needed.all = needed.all && all_known(of);
        needed.numbers.push_back(of.number);
        if (std::ranges::find(need.numbers, of.number) == need.numbers.end()) {
            need.numbers.push_back(of.number);
            news_ = fresh_ = true;
        }
    }
    while (entries_.size() > most_keys) {
        const auto oldest = std::ranges::min_element(entries_, {}, &Entry::used);
        for (auto& [link, other] : needs_) {
            std::erase(other.numbers, oldest->number);
        }
        dropped_.push_back(oldest->key);
        entries_.erase(oldest);
        news_ = fresh_ = true;
    }
    return needed;
}

void Functions::forget(wire::LinkId client) {
    if (needs_.erase(client) > 0) {
        news_ = fresh_ = true;
    }
}

void Functions::drop_all() {
    for (const Entry& entry : std::exchange(entries_, {})) {
        dropped_.push_back(entry.key);
    }
    needs_.clear();
    news_ = fresh_ = true;
}

Functions::Entry& Functions::entry(const FunctionKey& key) {
    const auto found = std::ranges::find(entries_, key, &Entry::key);
    if (found != entries_.end()) {
        return *found;
    }
    return entries_.emplace_back(
        Entry{.key = key, .number = ++last_number_, .used = clock_, .directions = {}});
}

bool Functions::wanted(std::uint64_t number) const {
    return std::ranges::any_of(needs_, [&](const auto& need) {
        return std::ranges::find(need.second.numbers, number) != need.second.numbers.end();
    });
}

bool Functions::all_known(const Entry& entry) const {
    const auto whole = std::ranges::count_if(
        entry.directions, [](const auto& place) { return place.second >= all_directions; });
    return std::cmp_greater_equal(whole, renderers_);
}

std::optional<wire::Message> Functions::take_wanted(wire::Time now) {
    const bool waiting = std::ranges::any_of(
        entries_, [&](const Entry& entry) { return wanted(entry.number) && !all_known(entry); });
    if (waiting && now - heard_ > patience) {
        // Something may have been lost on its way, or its renderer, and another come in its place.
        ++renewal_;
        news_ = true;
        heard_ = now;
    }
    if (std::exchange(fresh_, false)) {
        changed_ = now;
    }
    if (now - changed_ < rest) {
        return std::nullopt;
    }
    if (!std::exchange(news_, false)) {
        return std::nullopt;
    }
    std::vector<const Entry*> order;
    for (const Entry& entry : entries_) {
        if (wanted(entry.number)) {
            order.push_back(&entry);
        }
    }
    std::ranges::stable_sort(order, std::ranges::greater(), &Entry::used);
    pb::WantFunctions want;
    for (const Entry* const entry : order) {
        pb::FunctionWant& one = *want.add_wants();
        one.set_number(entry->number);
        *one.mutable_key() = wire::to_wire(entry->key);
        for (const auto& [place, directions] : entry->directions) {
            if (directions >= all_directions) {
                one.add_known(static_cast<std::uint32_t>(place));
            }
        }
    }
    want.set_block_edge(static_cast<std::uint32_t>(culling::BlockGrid::default_edge));
    want.set_side(static_cast<std::uint32_t>(culling::DirectionGrid::default_side));
    want.set_renewal(renewal_);
    return wire::message(std::move(want));
}

std::optional<FunctionKey> Functions::key_of(std::uint64_t number) const {
    const auto found = std::ranges::find(entries_, number, &Entry::number);
    return found != entries_.end() ? std::optional(found->key) : std::nullopt;
}

std::optional<FunctionKey> Functions::came(const wire::FunctionPart& part, wire::Time now) {
    const auto found = std::ranges::find(entries_, part.number, &Entry::number);
    if (found == entries_.end() || part.side != culling::DirectionGrid::default_side) {
        return std::nullopt;
    }
    heard_ = now;
    found->any = true;
    if (!part.coarse) {
        int& directions = found->directions[part.place];
        directions = part.first_direction == 0 ? part.directions : directions + part.directions;
    }
    return found->key;
}

}  // namespace shearwater::head
