#pragma once
// From one transfer function to another.

#include "common/view/transfer_function.h"

namespace shearwater::flight {

// `share` in [0, 1] of the way from `a` to `b`; at the ends exactly those. Colours are mixed at every value.
// Pins that are of the same kinds one by one move and grow into each other. Others fade: those of `a` shrink
// while those of `b` grow, and blanks change half-way.
view::TransferFunction blend(const view::TransferFunction& a, const view::TransferFunction& b, double share);

}  // namespace shearwater::flight
