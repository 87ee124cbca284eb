#include "client/model/pace.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace shearwater::model {

namespace {

using view::Quality;

// Samples on the way to a picture: pixels times slices.
double work_of(Quality quality) {
    const view::Sampling sampling = view::sampling(quality);
    return sampling.resolution * sampling.resolution * std::exp2(-sampling.slice_exponent);
}

Quality next_above(Quality quality) {
    return quality == Quality::draft ? Quality::normal : Quality::high;
}
Quality next_below(Quality quality) {
    return quality == Quality::high ? Quality::normal : Quality::draft;
}

// The mean, without the largest and the smallest where there are enough: a single hiccup says nothing, and
// of frames that come in pairs one is dear and the other cheap.
double typical(std::vector<double> values) {
    std::ranges::sort(values);
    const std::ptrdiff_t trim = values.size() > 2 ? 1 : 0;
    double sum = 0;
    std::for_each(values.begin() + trim, values.end() - trim, [&](double value) { sum += value; });
    return sum / static_cast<double>(std::ssize(values) - 2 * trim);
}

}  // namespace

void Pace::set(const Effort& effort) {
    effort_ = effort;
    if (!std::isfinite(effort_.target_rate)) {
        effort_.target_rate = Effort{}.target_rate;
    }
    effort_.target_rate = std::clamp(effort_.target_rate, Effort::min_rate, Effort::max_rate);
    for (Known& each : known_) {  // what was too dear may be affordable now
        each.not_before = {};
        each.pause = first_pause;
    }
}

void Pace::count(wire::Time now, wire::Time sent, Quality quality, double render_seconds) {
    const double seconds = std::max(0.0, Seconds(now - std::max(sent, last_came_)).count());
    last_came_ = now;
    newest_ = quality;
    std::deque<Frame>& frames = known(quality).frames;
    // The peer's figure is its own affair: not a number counts as none.
    frames.push_back({now, seconds, render_seconds > 0 ? std::min(render_seconds, seconds) : 0});
    while (frames.size() > most_frames || frames.front().at + memory < now) {
        frames.pop_front();
    }
}

std::optional<Pace::Seconds> Pace::cost(Quality quality) const {
    if (!newest_) {
        return std::nullopt;
    }
    const std::deque<Frame>& own = known(quality).frames;
    const bool knows_itself = !own.empty() && own.back().at + memory >= last_came_;
    const std::deque<Frame>& frames = knows_itself ? own : known(*newest_).frames;
    const double more = knows_itself ? 1 : work_of(quality) / work_of(*newest_);
    std::vector<double> costs;
    for (const Frame& frame : frames) {
        costs.push_back(frame.seconds + frame.render_seconds * (more - 1));
    }
    return Seconds(typical(std::move(costs)));
}

bool Pace::holds(Quality quality, double share) const {
    const auto seconds = cost(quality);
    return seconds && seconds->count() * effort_.target_rate <= share;
}

Quality Pace::while_moving(wire::Time now) {
    if (effort_.fixed) {
        return *effort_.fixed;
    }
    const Quality above = next_above(moving_);
    if (newest_ && !holds(moving_, too_dear)) {
        step_down(now);
    } else if (above != moving_ && now >= changed_at_ + least_stay && now >= known(above).not_before &&
               holds(above, affordable)) {
        change_to(above, now);
    }
    return moving_;
}

void Pace::step_down(wire::Time now) {
    if (moving_ == Quality::draft) {
        return;
    }
    Known& left = known(moving_);
    left.pause = now - changed_at_ >= longest_pause ? first_pause : left.pause;
    left.not_before = now + left.pause;
    left.pause = std::min(2 * left.pause, longest_pause);
    const Quality below = next_below(moving_);
    change_to(holds(below, 1) ? below : Quality::draft, now);
}

void Pace::change_to(Quality quality, wire::Time now) {
    moving_ = quality;
    changed_at_ = now;
}

std::optional<Quality> Pace::at_rest(Quality asked, bool has_come) const {
    if (effort_.fixed) {
        return asked != *effort_.fixed ? effort_.fixed : std::nullopt;
    }
    if (asked == Quality::draft) {
        return Quality::normal;
    }
    return asked == Quality::normal && has_come ? std::optional(Quality::high) : std::nullopt;
}

}  // namespace shearwater::model
