#pragma once
// Pictures with culling beside pictures without, of views and transfer functions at random.

#include <optional>
#include <random>

#include "common/base/workers.h"
#include "common/culling/settings.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "renderer/culling/culler.h"
#include "renderer/shear/render.h"

namespace shearwater::bench {

// A camera at random: far, near or inside; perspective or parallel.
view::Camera camera_at_random(std::mt19937& random, const view::Lattice& lattice);
// A ramp, and perhaps a hat, a floor and a blank.
view::TransferFunction function_at_random(std::mt19937& random);
// Hats with edges as sharp as a step, and perhaps a narrow blank.
view::TransferFunction top_hats_at_random(std::mt19937& random);
// One view in five finer, one in four coarser; one in three with levels of detail; every other one
// pre-integrated.
view::Sampling sampling_at_random(std::mt19937& random);

struct CulledPicture {
    double difference = 0;  // the greatest of any channel, premultiplied, before rounding
    shear::RenderStats with, without;
};

// One view of a whole cube, or of what it is cropped to, with and without. Functions that are missing are
// computed.
CulledPicture compare(const shear::BrickVolume& volume, culling::Culler& culler,
                      const culling::Settings& settings, const view::TransferFunction& tf,
                      const view::Camera& camera, const view::ImageSize& size, const view::Lattice& lattice,
                      const view::Sampling& sampling, base::Workers& workers,
                      const std::optional<volume::Box>& crop = {});

}  // namespace shearwater::bench
