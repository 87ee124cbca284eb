#include "deploy/samples/sample.h"

#include <algorithm>
#include <array>
#include <memory>

#include "deploy/samples/formula.h"
#include "deploy/samples/write_cube.h"

namespace shearwater::samples {

namespace {

using base::Code;

constexpr std::array<SampleKind, 5> all = {{
    {"hi-galaxy", "neutral hydrogen of a warped spiral, its companion and the bridge between, by velocity"},
    {"nbody-web", "walls, filaments and knots of a cosmic web, logarithm of the density"},
    {"slab", "1 everywhere"},
    {"ball", "1 inside a ball of 0.4 of the shortest axis, 0 outside"},
    {"random", "independent values, uniform from 0 to 1"},
}};

constexpr std::int64_t longest_axis = std::int64_t{1} << 20;
constexpr std::int64_t largest_plane = std::int64_t{1} << 30;

std::unique_ptr<Formula> make(std::string_view name, const volume::Index3& n, std::uint64_t seed) {
    if (name == "hi-galaxy") {
        return make_hi_galaxy(n, seed);
    }
    if (name == "nbody-web") {
        return make_cosmic_web(n, seed);
    }
    if (name == "slab") {
        return make_slab(n);
    }
    return name == "ball" ? make_ball(n) : make_random(n, seed);
}

std::string listed() {
    std::string list;
    for (const SampleKind& kind : all) {
        list += (list.empty() ? "" : ", ") + std::string(kind.name);
    }
    return list;
}

}  // namespace

std::span<const SampleKind> kinds() {
    return all;
}

base::Status write_sample(std::string_view name, const volume::Index3& n, std::uint64_t seed,
                          const std::string& path, const volume::Progress& progress,
                          const std::stop_token& stop) {
    const std::string operation = "make the sample " + base::printable(name, 40);
    if (std::none_of(all.begin(), all.end(), [&](const SampleKind& kind) { return kind.name == name; })) {
        return base::error(Code::invalid_argument, operation, "there is none of that name, but " + listed());
    }
    if (std::any_of(n.begin(), n.end(), [](std::int64_t axis) { return axis < 2 || axis > longest_axis; })) {
        return base::error(Code::invalid_argument, operation,
                           "every axis has from 2 to " + std::to_string(longest_axis) + " voxels");
    }
    if (n[0] * n[1] > largest_plane) {
        return base::error(Code::too_large, operation, "a plane has at most 2^30 voxels");
    }
    return write_cube(*make(name, n, seed), n, path, progress, stop);
}

}  // namespace shearwater::samples
