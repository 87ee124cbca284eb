#include "common/synthetic/field.h"

#include <algorithm>
#include <array>

#include "common/synthetic/make.h"

namespace shearwater::synthetic {

namespace {

constexpr std::array<Kind, 5> all = {{
    {"slab", "1 everywhere", false},
    {"ball", "1 inside a ball of 0.4 of the shortest axis, 0 outside", false},
    {"random", "independent values, uniform from 0 to 1", false},
    {"random-bytes", "independent whole numbers, uniform from 0 to 255", true},
    {"noise-sources", "noise of mean 40 and deviation 10, and 40 blobs and 4 filaments in it, from 0 to 255",
     true},
}};

constexpr std::int64_t longest_axis = std::int64_t{1} << 20;

std::string listed() {
    std::string list;
    for (const Kind& kind : all) {
        list += (list.empty() ? "" : ", ") + std::string(kind.name);
    }
    return list;
}

}  // namespace

std::span<const Kind> kinds() {
    return all;
}

base::Result<std::unique_ptr<const Field>> make_field(std::string_view name, const volume::Index3& n,
                                                      std::uint64_t seed) {
    const auto refuse = [&](std::string why) {
        return base::error(base::Code::invalid_argument, "make the cube " + base::printable(name, 40),
                           std::move(why));
    };
    if (std::ranges::any_of(n, [](std::int64_t axis) { return axis < 2 || axis > longest_axis; })) {
        return refuse("every axis has from 2 to " + std::to_string(longest_axis) + " voxels");
    }
    if (name == "slab") {
        return make_slab();
    }
    if (name == "ball") {
        return make_ball(n);
    }
    if (name == "random") {
        return make_random(seed);
    }
    if (name == "random-bytes") {
        return make_random_bytes(seed);
    }
    if (name == "noise-sources") {
        return make_noise_sources(n, seed);
    }
    return refuse("there is none of that name, but " + listed());
}

}  // namespace shearwater::synthetic
