#include "deploy/bench/culled_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/image/warp.h"

namespace shearwater::bench {

using image::RgbaF;

view::Camera camera_at_random(std::mt19937& random, const view::Lattice& lattice) {
    std::uniform_real_distribution<double> share(0, 1);
    const double diagonal = lattice.diagonal();
    const bool parallel = share(random) < 0.3;
    view::Orbit orbit{.azimuth = 360 * share(random), .elevation = 170 * share(random) - 85};
    const std::array distances{0.0, 0.7 * diagonal, 0.25 * diagonal};
    orbit.distance = distances[static_cast<std::size_t>(3 * share(random))];
    return view::camera_on(orbit, lattice,
                           parallel ? view::Projection::parallel : view::Projection::perspective,
                           25 + 70 * share(random), parallel ? diagonal * (0.3 + share(random)) : 0);
}

view::TransferFunction function_at_random(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    view::TransferFunction tf{
        .opacity_pins = {}, .colour_pins = {{0, {0.2, 0.3, 1}}, {1, {1, 0.8, 0.3}}}, .background = {}};
    const double height = std::pow(share(random), 2);
    tf.opacity_pins.push_back(view::Ramp{0.6 * share(random),
                                         share(random) < 0.4 ? 0.05 + 0.1 * share(random) : 0,
                                         0.7 + 0.3 * share(random), height + 0.01});
    if (share(random) < 0.5) {
        tf.opacity_pins.push_back(view::Hat{share(random), 0.1 * share(random), 0.1 + 0.3 * share(random),
                                            0.99 * share(random) + 0.01});
    }
    if (share(random) < 0.3) {
        tf.opacity_pins.push_back(view::Flat{0.1 * share(random) + 0.001});
    }
    if (share(random) < 0.3) {
        const double lo = share(random);
        tf.opacity_pins.push_back(view::Blank{lo, std::min(lo + 0.2 * share(random), 1.0)});
    }
    return tf;
}

view::TransferFunction top_hats_at_random(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    view::TransferFunction tf{
        .opacity_pins = {}, .colour_pins = {{0, {0.2, 0.3, 1}}, {1, {1, 0.8, 0.3}}}, .background = {}};
    const int hats = 1 + static_cast<int>(3 * share(random));
    for (int hat = 0; hat < hats; ++hat) {
        const double width = (hat == 0 ? 0.9 : 0.1) * std::pow(share(random), 0.5) + 0.002;
        tf.opacity_pins.push_back(view::Hat{share(random), width, width, 0.98 * share(random) + 0.01});
    }
    if (share(random) < 0.5) {
        const double lo = share(random);
        tf.opacity_pins.push_back(view::Blank{lo, lo + 0.01 * share(random)});
    }
    return tf;
}

view::Sampling sampling_at_random(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    const auto quality = share(random) < 0.2   ? view::Quality::high
                         : share(random) < 0.3 ? view::Quality::draft
                                               : view::Quality::normal;
    const bool level_of_detail = share(random) < 0.3;
    return view::sampling(quality, level_of_detail,
                          share(random) < 0.5 ? view::Classify::pre_integrated : view::Classify::post);
}

CulledPicture compare(const shear::BrickVolume& volume, culling::Culler& culler,
                      const culling::Settings& settings, const view::TransferFunction& tf,
                      const view::Camera& camera, const view::ImageSize& size, const view::Lattice& lattice,
                      const view::Sampling& sampling, base::Workers& workers,
                      const std::optional<volume::Box>& crop) {
    const view::Factorisation f = view::factorise(camera, size, lattice, sampling, crop);
    view::Factorisation culled = f;
    culled.opaque = settings.opaque();
    const auto classification = shear::classify(volume, tf, f.classify, workers);
    culler.prepare(tf, settings.kind, f.level(), workers);
    const culling::VisibleBlocks visible = culler.visible(f, tf, settings, workers);
    CulledPicture picture;
    const auto draw = [&](const view::Factorisation& by, const culling::VisibleBlocks* blocks,
                          shear::RenderStats& stats) {
        const auto drawn = shear::render(volume, classification, by, workers, {.visible = blocks});
        stats = drawn.stats;
        return image::warp_float(by, drawn.windows, camera, size, workers);
    };
    const auto with = draw(culled, &visible, picture.with), without = draw(f, nullptr, picture.without);
    for (std::size_t i = 0; i < with.pixels().size(); ++i) {
        const RgbaF& a = with.pixels()[i];
        const RgbaF& b = without.pixels()[i];
        for (const float d : {a.r - b.r, a.g - b.g, a.b - b.b, a.a - b.a}) {
            picture.difference = std::max(picture.difference, static_cast<double>(std::abs(d)));
        }
    }
    return picture;
}

}  // namespace shearwater::bench
