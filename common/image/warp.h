#pragma once
// From the intermediate images of a view to its picture: the last stage, done once, at the head.

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"

namespace shearwater::image {

// `windows`: at most one per face of the factorisation. Each output pixel takes the face of its ray's
// principal axis, resamples it, is put over the background and rounded to 8 bits; alpha is 255.
Image<Rgba8> warp(const view::Factorisation& factorisation, std::span<const Window> windows,
                  const view::Camera& camera, const view::ImageSize& size, const view::Rgb& background,
                  base::Workers& workers);

// The same before background and rounding: premultiplied, with alpha.
Image<RgbaF> warp_float(const view::Factorisation& factorisation, std::span<const Window> windows,
                        const view::Camera& camera, const view::ImageSize& size, base::Workers& workers);

}  // namespace shearwater::image
