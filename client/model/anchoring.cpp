#include "client/model/anchoring.h"

namespace shearwater::model {

std::optional<view::TransferFunction> Anchoring::settle(const Status& status,
                                                        const view::TransferFunction& shown, wire::Time now) {
    if (!pending_) {
        return std::nullopt;
    }
    if (function_.unit == view::Unit::stretched) {
        pending_ = false;
        return function_.tf;
    }
    if (first_ && *first_ != shown) {
        pending_ = false;
        return std::nullopt;
    }
    if (!status.cube) {
        return std::nullopt;
    }
    const Cube& cube = *status.cube;
    const bool by_values = function_.unit != view::Unit::value;
    if (by_values && cube.values == nullptr) {
        ready_ = status.tree.ready ? ready_.value_or(now) : now;
        if (now - *ready_ < patience) {
            return std::nullopt;
        }
    }
    const bool provisional =
        cube.provisional || (by_values && cube.values != nullptr && cube.provisional_values);
    if (provisional && first_) {
        return std::nullopt;
    }
    const view::ValueScale scale = cube.scale();
    auto tf = view::on_scale(function_, &scale);
    pending_ = provisional && tf;
    if (!tf) {
        fault_ = tf.error().message();
        return std::nullopt;
    }
    first_ = *tf;
    return *std::move(tf);
}

}  // namespace shearwater::model
