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
    return kind == Kind::off ? enough : std::min(threshold, enough);
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
