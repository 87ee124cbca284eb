#include "client/model/limits.h"

#include <array>

#include "common/view/anchored_function.h"
#include "common/volume/zscale.h"

namespace shearwater::model {

std::optional<volume::Scaling> scaling_by(LimitsBy by, const Cube& cube) {
    if (!cube.values || cube.values->empty()) {
        return std::nullopt;
    }
    const volume::Summary& values = *cube.values;
    // Of the values, by the others in their order.
    constexpr std::array percents{100.0, 99.9, 99.5, 99.0, 95.0};
    if (by == LimitsBy::zscale) {
        const volume::Limits limits = volume::zscale_limits(values);
        return volume::Scaling{limits.lo, limits.hi, cube.mapping.stretch};
    }
    const double cut = (100 - percents.at(static_cast<std::size_t>(by))) / 200;
    return volume::Scaling{values.value_at(cut), values.value_at(1 - cut), cube.mapping.stretch};
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
