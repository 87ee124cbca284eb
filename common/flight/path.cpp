#include "common/flight/path.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "common/base/check.h"
#include "common/flight/blend.h"

namespace shearwater::flight {

namespace {

using Value = std::function<double(const Key&)>;

// The slope at a key by Fritsch and Carlson: 0 at a turning point, else the harmonic mean of the secants on
// both sides, weighted by the intervals.
double slope(const std::vector<Key>& keys, std::size_t i, const Value& value) {
    const auto secant = [&](std::size_t from) {
        return (value(keys[from + 1]) - value(keys[from])) / (keys[from + 1].time - keys[from].time);
    };
    if (i == 0) {
        return secant(0);
    }
    if (i + 1 == keys.size()) {
        return secant(i - 1);
    }
    const double before = secant(i - 1);
    const double after = secant(i);
    if (before * after <= 0) {
        return 0;
    }
    const double h_before = keys[i].time - keys[i - 1].time;
    const double h_after = keys[i + 1].time - keys[i].time;
    const double w_before = 2 * h_after + h_before;
    const double w_after = h_after + 2 * h_before;
    return (w_before + w_after) / (w_before / before + w_after / after);
}

// Where in the flight a time is: between keys `from` and the next, `share` of the way.
struct Place {
    std::size_t from;
    double share;
};

Place place_of(const Path& path, double time) {
    base::check(!path.keys.empty(), "a path has keys");
    const auto& keys = path.keys;
    const auto after = std::ranges::upper_bound(keys, time, {}, &Key::time);
    if (after == keys.begin()) {
        return {0, 0};
    }
    const auto from = static_cast<std::size_t>(after - keys.begin()) - 1;
    if (after == keys.end()) {
        return {from, 0};
    }
    return {from, (time - keys[from].time) / (after->time - keys[from].time)};
}

// The cubic of Hermite between two keys.
double curve(const std::vector<Key>& keys, const Place& place, const Value& value) {
    const std::size_t i = place.from;
    const double a = value(keys[i]);
    if (place.share <= 0) {
        return a;
    }
    const double b = value(keys[i + 1]);
    if (a == b) {
        return a;
    }
    const double t = place.share;
    const double h = keys[i + 1].time - keys[i].time;
    const double from = h * slope(keys, i, value);
    const double to = h * slope(keys, i + 1, value);
    const double u = 1 - t;
    return a * (1 + 2 * t) * u * u + from * t * u * u + b * t * t * (3 - 2 * t) - to * t * t * u;
}

// Exactly those of a key at its time, and where one of the two says nothing those before.
std::optional<volume::Scaling> scaling_between(const Key& a, const Key& b, double share) {
    if (!a.scaling || !b.scaling || a.cube != b.cube || a.scaling->stretch != b.scaling->stretch) {
        return a.scaling;
    }
    return volume::Scaling{std::lerp(a.scaling->lo, b.scaling->lo, share),
                           std::lerp(a.scaling->hi, b.scaling->hi, share), a.scaling->stretch};
}

base::Status refused(std::size_t key, const std::string& what) {
    return base::error(base::Code::invalid_argument, fmt::format("key {}", key + 1), what);
}

base::Status validate_key(const Path& path, std::size_t i) {
    const Key& key = path.keys[i];
    if (const auto valid = view::validate(key.viewpoint); !valid) {
        return refused(i, valid.error().detail);
    }
    if (!std::isfinite(key.time)) {
        return refused(i, "its time is not finite");
    }
    if (!path.cubes.empty() && key.cube >= path.cubes.size()) {
        return refused(i, fmt::format("there is no cube {}", key.cube + 1));
    }
    if (const auto valid = view::validate(key.tf); !valid) {
        return refused(i, valid.error().detail);
    }
    if (key.scaling && !key.scaling->valid()) {
        return refused(i, "its limits have to be finite, the lower first");
    }
    return {};
}

}  // namespace

int Path::frames() const {
    constexpr double rounding = 1e-6;
    return keys.empty() ? 0 : static_cast<int>(std::floor(keys.back().time * fps + rounding)) + 1;
}

base::Status validate(const Path& path) {
    if (path.keys.empty() || path.keys.size() > Path::max_keys || path.cubes.size() > Path::max_cubes) {
        return base::error(
            base::Code::invalid_argument, "flight path",
            fmt::format("needs 1 to {} keys and at most {} cubes", Path::max_keys, Path::max_cubes));
    }
    if (path.fps < 1 || path.fps > Path::max_fps) {
        return base::error(base::Code::invalid_argument, "flight path",
                           fmt::format("the fps must lie between 1 and {}", Path::max_fps));
    }
    for (std::size_t i = 0; i < path.keys.size(); ++i) {
        if (const auto valid = validate_key(path, i); !valid) {
            return valid;
        }
        if (i == 0 ? path.keys[0].time != 0 : path.keys[i].time <= path.keys[i - 1].time) {
            return refused(
                i, i == 0 ? "the first key's time must be 0" : "its time is not after the key's before");
        }
    }
    if (path.keys.back().time > Path::max_seconds) {
        return refused(path.keys.size() - 1, "no flight may last longer than a day");
    }
    return {};
}

std::size_t cube_at(const Path& path, double time) {
    return path.keys[place_of(path, time).from].cube;
}

Seen seen_at(const Path& path, double time, const view::Lattice& lattice) {
    const Place place = place_of(path, time);
    const Key& last = path.keys[place.from];
    if (place.share <= 0) {
        return {last.viewpoint, last.tf, last.scaling};
    }
    const auto follow = [&](const Value& value) { return curve(path.keys, place, value); };
    const auto of_orbit = [&](double view::Orbit::*angle) {
        return follow([=](const Key& key) { return key.viewpoint.orbit.*angle; });
    };
    const auto of_target = [&](double view::Vec3::*axis) {
        return follow([=](const Key& key) { return key.viewpoint.orbit.target.*axis; });
    };
    const double distance =
        std::exp(follow([&](const Key& key) { return std::log(view::distance_of(key.viewpoint, lattice)); }));
    return {.viewpoint = {.orbit = {.azimuth = of_orbit(&view::Orbit::azimuth),
                                    .elevation = of_orbit(&view::Orbit::elevation),
                                    .distance = distance,
                                    .target = {of_target(&view::Vec3::x), of_target(&view::Vec3::y),
                                               of_target(&view::Vec3::z)},
                                    .roll = of_orbit(&view::Orbit::roll)},
                          .projection = last.viewpoint.projection,
                          .fov = follow([](const Key& key) { return key.viewpoint.fov; })},
            .tf = blend(last.tf, path.keys[place.from + 1].tf, place.share),
            .scaling = scaling_between(last, path.keys[place.from + 1], place.share)};
}

Shot shot_at(const Path& path, double time, const view::Lattice& lattice) {
    Seen seen = seen_at(path, time, lattice);
    return {
        .camera = view::camera(seen.viewpoint, lattice), .tf = std::move(seen.tf), .scaling = seen.scaling};
}

}  // namespace shearwater::flight
