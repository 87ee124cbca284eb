#include "common/culling/settings.h"

#include <algorithm>

#include "common/view/factorisation.h"

namespace shearwater::culling {

std::span<const Footprint> footprints_of(Kind kind) {
    static constexpr std::array both{Footprint::block, Footprint::column};
    return std::span(both).first(kind == Kind::opof ? 2 : 1);
}

double Settings::opaque() const {
    constexpr double enough = view::opaque_enough;
    // Rays next to one another may end far apart, one too bright and one too dark, and between pixels the
    // warp's cubic (Catmull-Rom) makes as much more of it as its weights' sizes sum up to, (9/8 + 1/8)^2.
    constexpr double overshoot = 25.0 / 16;
    return kind == Kind::off ? enough : std::min(1 - (1 - threshold) / overshoot, enough);
}

base::Status validate(const Settings& settings) {
    if (settings.kind < Kind::off || settings.kind > Kind::opof) {
        return base::error(base::Code::invalid_argument, "cull", "there is no such kind of opacity function");
    }
    if (!(settings.threshold >= 0.5 && settings.threshold < 1)) {
        return base::error(base::Code::invalid_argument, "cull", "a threshold is 0.5 to less than 1");
    }
    return {};
}

}  // namespace shearwater::culling
