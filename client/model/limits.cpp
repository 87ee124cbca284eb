#include "client/model/limits.h"

#include "common/view/anchored_function.h"
#include "common/volume/zscale.h"

namespace shearwater::model {

std::optional<volume::Scaling> scaling_by(LimitsBy by, const Cube& cube) {
    if (!cube.values || cube.values->empty()) {
        return std::nullopt;
    }
    const volume::Summary& values = *cube.values;
    const auto central = [&](double percent) {
        const double cut = (100 - percent) / 200;
        return volume::Limits{values.value_at(cut), values.value_at(1 - cut)};
    };
    volume::Limits limits{values.min, values.max};
    switch (by) {
        case LimitsBy::all:
            break;
        case LimitsBy::p999:
            limits = central(99.9);
            break;
        case LimitsBy::p995:
            limits = central(99.5);
            break;
        case LimitsBy::p99:
            limits = central(99);
            break;
        case LimitsBy::p95:
            limits = central(95);
            break;
        case LimitsBy::zscale:
            limits = volume::zscale_limits(values);
            break;
    }
    return volume::Scaling{limits.lo, limits.hi, cube.mapping.stretch};
}

base::Status validate(const volume::Scaling& scaling) {
    if (!scaling.valid() || !(scaling.lo < scaling.hi)) {
        return base::error(base::Code::invalid_argument, "set the limits",
                           "the lower one has to be below the upper one");
    }
    return {};
}

view::TransferFunction held(const view::TransferFunction& tf, const Cube& cube,
                            const volume::Scaling& scaling) {
    const view::AnchoredFunction by_value = view::anchored(tf, view::Unit::value, cube.scale());
    const view::ValueScale next(volume::Mapping::of(scaling, cube.mapping.bits));
    auto placed = view::on_scale(by_value, &next);
    return placed ? *std::move(placed) : tf;
}

}  // namespace shearwater::model
