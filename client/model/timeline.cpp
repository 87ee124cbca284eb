#include "client/model/timeline.h"

#include <algorithm>
#include <cmath>

namespace shearwater::model {

void Timeline::set_path(flight::Path path) {
    path_ = std::move(path);
    at_ = 0;
    selected_.reset();
    pause();
}

void Timeline::set_fps(int fps) {
    path_.fps = std::clamp(fps, 1, flight::Path::max_fps);
}

double Timeline::span() const {
    constexpr double least = 10, room = 1.15;
    return std::max({least, room * duration(), at_ + frame()});
}

void Timeline::seek(double time) {
    const double within = std::isfinite(time) ? std::clamp(time, 0.0, longest) : 0;
    at_ = std::round(within * path_.fps) / path_.fps;
    selected_ = key_at(at_);
    pause();
}

std::optional<std::size_t> Timeline::key_at(double time) const {
    const auto found = std::ranges::find_if(
        path_.keys, [&](const flight::Key& key) { return std::abs(key.time - time) < frame() / 2; });
    return found == path_.keys.end() ? std::nullopt
                                     : std::optional(static_cast<std::size_t>(found - path_.keys.begin()));
}

void Timeline::keep(const flight::Seen& seen) {
    pause();
    at_ = empty() ? 0 : at_;
    if (const auto there = key_at(at_)) {
        flight::Key& key = path_.keys[*there];
        key.viewpoint = seen.viewpoint;
        key.tf = seen.tf;
        key.scaling = seen.scaling;
        selected_ = there;
    } else if (path_.keys.size() < flight::Path::max_keys) {
        const auto behind = std::ranges::upper_bound(path_.keys, at_, {}, &flight::Key::time);
        const std::size_t cube = behind == path_.keys.begin() ? 0 : std::prev(behind)->cube;
        const auto kept = path_.keys.insert(behind, {at_, cube, seen.viewpoint, seen.tf, seen.scaling});
        selected_ = static_cast<std::size_t>(kept - path_.keys.begin());
    }
}

void Timeline::select(std::size_t key) {
    if (key < path_.keys.size()) {
        seek(path_.keys[key].time);
        selected_ = key;
    }
}

void Timeline::move_selected(double time) {
    if (!selected_ || *selected_ == 0 || !std::isfinite(time)) {
        return;
    }
    auto& keys = path_.keys;
    const std::size_t i = *selected_;
    const double least = keys[i - 1].time + frame();
    const double most = i + 1 < keys.size() ? keys[i + 1].time - frame() : longest;
    if (least <= most) {
        keys[i].time = std::clamp(std::round(time * path_.fps) / path_.fps, least, most);
        at_ = keys[i].time;
        pause();
    }
}

void Timeline::remove_selected() {
    if (!selected_) {
        return;
    }
    auto& keys = path_.keys;
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(*selected_));
    const double begin = keys.empty() ? 0 : keys.front().time;
    for (flight::Key& key : keys) {
        key.time -= begin;
    }
    seek(at_ - begin);
}

void Timeline::play(wire::Time now) {
    if (path_.keys.size() > 1) {
        at_ = at_ >= duration() ? 0 : at_;
        selected_.reset();
        played_from_ = Begun{now, at_};
    }
}

std::optional<flight::Seen> Timeline::advance(wire::Time now, const view::Lattice& lattice) {
    if (!played_from_) {
        return std::nullopt;
    }
    const double passed = std::chrono::duration<double>(now - played_from_->when).count();
    at_ = std::min(played_from_->at + passed, duration());
    if (at_ >= duration()) {
        pause();
    }
    auto now_seen = seen(lattice);
    if (now_seen && playing()) {
        const auto behind = std::ranges::upper_bound(path_.keys, at_, {}, &flight::Key::time);
        now_seen->scaling = std::prev(behind)->scaling;
    }
    return now_seen;
}

std::optional<flight::Seen> Timeline::seen(const view::Lattice& lattice) const {
    return empty() ? std::nullopt : std::optional(flight::seen_at(path_, at_, lattice));
}

}  // namespace shearwater::model
