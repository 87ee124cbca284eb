#include "common/culling/settings.h"

namespace shearwater::culling {

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
