#pragma once
// Undo and redo of whatever a person changes. Changes that follow one another closely, as a drag's do, are
// one step.

#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "protocol/wire/events.h"

namespace shearwater::model {

// `State`: what is remembered, whole; it can be compared.
template <class State>
class History {
  public:
    static constexpr std::size_t most_steps = 200;  // older ones are forgotten
    static constexpr std::chrono::milliseconds rest{300};

    // The state as it is now. A change while `held`, of one in a row, continues the step begun by the last
    // such change until nothing has changed for as long as `rest`; any other change is a step of its own.
    void observe(const State& state, bool held, wire::Time now) {
        if (!present_) {
            present_ = state;
        }
        if (state == *present_) {
            open_ = open_ && (held || now - changed_at_ < rest);
            return;
        }
        if (!open_ || !held) {
            past_.push_back(*std::move(present_));
            if (past_.size() > most_steps) {
                past_.pop_front();
            }
        }
        future_.clear();
        present_ = state;
        changed_at_ = now;
        open_ = held;
    }

    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    // The state to go back, or forward, to; nothing if there is none.
    std::optional<State> undo() { return step(past_, future_); }
    std::optional<State> redo() { return step(future_, past_); }

  private:
    std::optional<State> step(std::deque<State>& from, std::deque<State>& to) {
        if (from.empty()) {
            return std::nullopt;
        }
        to.push_back(*std::move(present_));
        present_ = std::move(from.back());
        from.pop_back();
        open_ = false;
        return present_;
    }

    std::deque<State> past_, future_;  // the nearest last
    std::optional<State> present_;
    wire::Time changed_at_{};
    bool open_ = false;  // the last change may go on
};

}  // namespace shearwater::model
