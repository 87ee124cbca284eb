#pragma once
// Answers of children to what they were asked, put together: a question's once every child that was asked has
// answered, or will not.

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "protocol/wire/events.h"

namespace shearwater::node {

// What is put together: a Whole has a bool `incomplete`, that some child's answer is not in it.
template <class Whole>
class Gathering {
  public:
    // Beyond so many questions the oldest are cut short; a child has so long for its answer.
    Gathering(std::size_t most_pending, std::chrono::seconds patience)
        : most_pending_(most_pending), patience_(patience) {}

    // A question that these children, known by their indices, are asked, and what is known of its answer
    // before.
    void begin(std::uint64_t number, Whole whole, std::set<std::size_t> children, wire::Time now) {
        if (pending_.size() >= most_pending_) {
            pending_.begin()->second.whole.incomplete = true;
            finish(pending_.begin());
        }
        const auto entry =
            pending_.insert_or_assign(number, Pending{std::move(whole), std::move(children), now}).first;
        if (entry->second.waiting.empty()) {
            finish(entry);
        }
    }
    void forget(std::uint64_t number) { pending_.erase(number); }
    void forget_all() { pending_.clear(); }

    // A child's answer, which add(whole) puts to the others'; of no effect where that is not waited for.
    template <class Add>
    void answer(std::uint64_t number, std::size_t child, const Add& add) {
        const auto found = pending_.find(number);
        if (found == pending_.end() || found->second.waiting.erase(child) == 0) {
            return;
        }
        add(found->second.whole);
        if (found->second.waiting.empty()) {
            finish(found);
        }
    }
    void child_gone(std::size_t child) {
        give_up_where([child](std::size_t waiting, wire::Time) { return waiting == child; });
    }
    void tick(wire::Time now) {
        give_up_where([&](std::size_t, wire::Time since) { return now - since > patience_; });
    }

    std::vector<Whole> take_complete() { return std::exchange(complete_, {}); }
    std::size_t pending() const { return pending_.size(); }

  private:
    struct Pending {
        Whole whole;
        std::set<std::size_t> waiting;
        wire::Time since;
    };
    using Entry = typename std::map<std::uint64_t, Pending>::iterator;

    Entry finish(Entry entry) {
        complete_.push_back(std::move(entry->second.whole));
        return pending_.erase(entry);
    }

    template <class Which>
    void give_up_where(const Which& which) {
        for (auto entry = pending_.begin(); entry != pending_.end();) {
            Pending& pending = entry->second;
            const std::size_t given_up = std::erase_if(
                pending.waiting, [&](std::size_t child) { return which(child, pending.since); });
            pending.whole.incomplete = pending.whole.incomplete || given_up > 0;
            entry = given_up > 0 && pending.waiting.empty() ? finish(entry) : std::next(entry);
        }
    }

    std::size_t most_pending_;
    std::chrono::seconds patience_;
    std::map<std::uint64_t, Pending> pending_;
    std::vector<Whole> complete_;
};

}  // namespace shearwater::node
