#pragma once
// Which quality to ask for: while the view moves the best one that holds a frame rate, and a better one
// step by step once it rests.
//
// The cost of a frame is the time that went by for it alone: from when it was sent, or from when the one
// before it came if that was later, until it came. With several under way that is the pipeline's slowest
// stage, and so what the frame rate follows; with one under way it is the whole round trip.

#include <array>
#include <chrono>
#include <deque>
#include <optional>

#include "common/view/factorisation.h"
#include "protocol/wire/events.h"

namespace shearwater::model {

// How well a person wants the pictures drawn.
struct Effort {
    static constexpr double min_rate = 1, max_rate = 60;

    std::optional<view::Quality> fixed;  // always this one
    double target_rate = 20;             // else: frames a second to hold while the view moves
    bool operator==(const Effort&) const = default;
};

class Pace {
  public:
    using Seconds = std::chrono::duration<double>;

    // A quality is left when its frames take more than this share of the time there is, and taken up when
    // they are thought to take less than that one: between the two, what is stays.
    static constexpr double too_dear = 1.1, affordable = 0.9;
    // Before the next step up; and before a quality is tried again that was found too dear, doubled from
    // one time to the next until it has held for as long as the longest pause.
    static constexpr std::chrono::milliseconds least_stay{400};
    static constexpr std::chrono::seconds first_pause{2}, longest_pause{32};
    // A quality is known by its own frames if they are at most this much older than the newest of all;
    // else by how its work compares with the newest one's.
    static constexpr std::chrono::seconds memory{3};
    static constexpr std::size_t most_frames = 6;

    void set(const Effort& effort);
    const Effort& effort() const { return effort_; }
    // A frame has come; `render_seconds` as the server says.
    void count(wire::Time now, wire::Time sent, view::Quality quality, double render_seconds);

    // For the next frame of a view that moves.
    view::Quality while_moving(wire::Time now);
    // For a change that stands alone: nothing says that others will follow.
    view::Quality for_single() const { return effort_.fixed.value_or(view::Quality::normal); }
    // For a view at rest that was asked for at `asked`: what to ask for next, if anything. From draft to
    // normal at once, to high when the normal picture has come.
    std::optional<view::Quality> at_rest(view::Quality asked, bool has_come) const;
    // The last one a view at rest comes to.
    view::Quality best() const { return effort_.fixed.value_or(view::Quality::high); }

    // What a frame is thought to take, if anything is known.
    std::optional<Seconds> cost(view::Quality quality) const;

  private:
    static constexpr int qualities = 3;

    struct Frame {
        wire::Time at;
        double seconds, render_seconds;
    };
    struct Known {
        std::deque<Frame> frames;  // the newest last
        wire::Time not_before{};   // to be taken up
        std::chrono::seconds pause = first_pause;
    };

    const Known& known(view::Quality quality) const { return known_[static_cast<std::size_t>(quality)]; }
    Known& known(view::Quality quality) { return known_[static_cast<std::size_t>(quality)]; }
    bool holds(view::Quality quality, double share) const;
    void step_down(wire::Time now);
    void change_to(view::Quality quality, wire::Time now);

    Effort effort_;
    std::array<Known, qualities> known_;
    std::optional<view::Quality> newest_;  // of the frame that came last
    wire::Time last_came_{};
    view::Quality moving_ = view::Quality::draft;
    wire::Time changed_at_{};
};

}  // namespace shearwater::model
