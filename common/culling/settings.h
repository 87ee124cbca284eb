#pragma once
// How a person wants hidden blocks to be left out.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/result.h"
#include "common/culling/block_grid.h"

namespace shearwater::culling {

enum class Kind {
    off,
    pof,          // by the least opacity of a block's footprint (POF 3.1)
    opof_linear,  // by the least ratio of opacity to thickness (OPOF 4)
    opof,         // by the least optical depth to thickness
};
// In the order of Kind.
inline constexpr std::array<std::string_view, 4> kind_names{"off", "pof", "opof-linear", "opof"};

// What lines are taken together in a function: those through a block, over what they have in it, or those
// that pass it half-way, between its planes.
enum class Footprint { block, column };
// Of the functions that a kind goes by; those of blocks, which are found sooner, first.
std::span<const Footprint> footprints_of(Kind kind);

struct Settings {
    Kind kind = Kind::off;
    // What lies behind so much opacity is left out: a block that every ray has it before, and the rest of a
    // ray's way through a sub-volume that gives it, which is then as good as opaque. A picture differs at
    // most by what is left of the light, here less than half a level of 255.
    double threshold = default_threshold;

    // At which rays are done (view::Sampling).
    double opaque() const;

    static constexpr double default_threshold = 1 - 1.0 / 510;
    bool operator==(const Settings&) const = default;
};

// A kind that there is, and a threshold of 0.5 to less than 1.
base::Status validate(const Settings& settings);

}  // namespace shearwater::culling
