#pragma once
// The limits of values that a person chooses for the cube, and what becomes of the transfer function then.

#include <optional>

#include "client/model/status.h"
#include "common/base/result.h"
#include "common/view/transfer_function.h"
#include "common/volume/mapping.h"

namespace shearwater::model {

// By what limits are found: so many percent of the values in their middle, or zscale.
enum class LimitsBy { all, p999, p995, p99, p95, zscale };

// Those of a cube's values with the stretch it has; nothing where no values are known.
std::optional<volume::Scaling> scaling_by(LimitsBy by, const Cube& cube);

// Whether a cube can be shown so: the lower limit is below the upper one.
base::Status validate(const volume::Scaling& scaling);

// The transfer function with its pins at the data values that they have on the cube now, once its values are
// scaled so. Those that would lie beyond all that can be placed stay as they are.
view::TransferFunction held(const view::TransferFunction& tf, const Cube& cube,
                            const volume::Scaling& scaling);

}  // namespace shearwater::model
