#pragma once
// Which codes occur where in a brick.

#include <span>

#include "renderer/shear/brick_volume.h"

namespace shearwater::shear {

// Fills in the ranges of a brick and of its micro-bricks from its codes in the store.
template <class Code>
void survey_codes(std::span<const Code> store, Brick& brick, MicroBricks& micro_bricks);

extern template void survey_codes(std::span<const std::uint8_t>, Brick&, MicroBricks&);
extern template void survey_codes(std::span<const std::uint16_t>, Brick&, MicroBricks&);

}  // namespace shearwater::shear
