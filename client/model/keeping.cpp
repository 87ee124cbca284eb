#include "client/model/keeping.h"

#include <algorithm>

namespace shearwater::model {

namespace {

constexpr std::string_view ending = ".autosave.toml";

// FNV-1a: a cube's lattice in a few digits, so that others of its name are told apart.
std::uint64_t fingerprint(const Cube& cube) {
    std::string text = cube.name;
    for (const std::int64_t n : cube.lattice.n) {
        text += '/' + std::to_string(n);
    }
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : text) {
        hash = (hash ^ static_cast<std::uint8_t>(c)) * 1099511628211U;
    }
    return hash;
}

std::string prefix_for(const Cube& cube) {
    return stem_for(cube) + "-" + std::to_string(fingerprint(cube)) + "-";
}

}  // namespace

Remembered remembered(const Wish& wish) {
    return {wish.viewpoint, wish.tf, wish.crop, wish.scaling};
}

void restore(const Remembered& state, Wish& wish) {
    wish.viewpoint = state.viewpoint;
    wish.tf = state.tf;
    wish.crop = state.crop;
    wish.scaling = state.scaling;
}

scene::Scene scene_of(const Wish& wish, const Effort& effort, const std::string& cube) {
    return {.cube = cube,
            .viewpoint = wish.viewpoint,
            .size = wish.size,
            .tf = wish.tf,
            .level_of_detail = wish.level_of_detail,
            .classify = wish.classify,
            .culling = wish.culling,
            .quality = effort.fixed,
            .target_rate = effort.target_rate,
            .crop = wish.crop,
            .stereo = {},
            .scaling = wish.scaling};
}

void apply(const scene::Scene& scene, Wish& wish, Effort& effort) {
    wish.viewpoint = scene.viewpoint;
    wish.tf = scene.tf;
    wish.level_of_detail = scene.level_of_detail;
    wish.classify = scene.classify;
    wish.culling = scene.culling;
    wish.crop = scene.crop;
    wish.scaling = scene.scaling;
    effort.fixed = scene.quality;
    effort.target_rate = scene.target_rate;
}

std::string stem_for(const Cube& cube) {
    std::string name = cube.name.substr(cube.name.find_last_of('/') + 1);
    for (const std::string_view tail : {".gz", ".fz", ".fits", ".fit"}) {
        if (name.size() > tail.size() && name.ends_with(tail)) {
            name.resize(name.size() - tail.size());
        }
    }
    constexpr std::size_t most = 80;
    name.resize(std::min(name.size(), most));
    for (char& c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '-' || c == '_' || c == '.';
        c = plain ? c : '_';
    }
    return name.empty() || name.front() == '.' ? "cube" + name : name;
}

std::string autosave_name(const Cube& cube, int number) {
    return prefix_for(cube) + std::to_string(number) + std::string(ending);
}

bool is_autosave(const std::string& name, const Cube& cube) {
    const std::string prefix = prefix_for(cube);
    if (!name.starts_with(prefix) || !name.ends_with(ending) ||
        name.size() <= prefix.size() + ending.size()) {
        return false;
    }
    const std::string_view number(name.data() + prefix.size(), name.size() - prefix.size() - ending.size());
    return number.find_first_not_of("0123456789") == std::string_view::npos;
}

bool Autosave::due(const scene::Scene& scene, wire::Time now) {
    if (!kept_) {
        kept_ = scene;
    }
    if (*kept_ == scene || now - kept_at_ < interval) {
        return false;
    }
    kept_ = scene;
    kept_at_ = now;
    return true;
}

}  // namespace shearwater::model
