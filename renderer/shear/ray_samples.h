#pragma once
// The samples of a single ray, one after the other, as the kernel's definition takes them: what a pick asks
// of the sub-volume.

#include <vector>

#include "common/view/ray.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

// Those that the sub-volume owns and that have opacity, front to back, with their optical depths. A ray is as
// view::factorise_ray makes it. Behind so many no more are looked for, nor behind what lets no light pass.
inline constexpr std::size_t most_ray_samples = std::size_t{1} << 18;
std::vector<view::RaySample> sample_ray(const BrickVolume& volume, const OpacityTable& table,
                                        const view::Factorisation& ray);

}  // namespace shearwater::shear
