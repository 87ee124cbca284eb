#include "tests/support/reference_views.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/image/warp.h"
#include "tests/support/reference_raycaster.h"

namespace shearwater::test {

using view::Projection;

std::vector<NamedView> views_from(const view::Lattice& lattice, double azimuth, double elevation) {
    const std::string where = " from " + std::to_string(static_cast<int>(azimuth)) + ", " +
                              std::to_string(static_cast<int>(elevation));
    // Distance in diagonals of the cube; off the axis of sight, so that nothing lies on a plane by luck.
    const auto view = [&](const std::string& name, double distance, double fov, Projection projection) {
        const view::Orbit orbit{azimuth, elevation, distance * lattice.diagonal()};
        return NamedView{name + where, view::camera_on(orbit, lattice, projection, fov)};
    };
    return {view("default", 0, 30, Projection::perspective),
            view("parallel", 0, 30, Projection::parallel),
            view("very far", 60, 1, Projection::perspective),
            view("near", 0.75, 75, Projection::perspective),
            view("inside", 0.15, 60, Projection::perspective),
            view("inside, wide", 0.1, 130, Projection::perspective)};
}

std::vector<NamedView> all_views(const view::Lattice& lattice, std::size_t every) {
    std::vector<NamedView> all;
    for (const auto& [azimuth, elevation] : {std::pair{30.0, 20.0},
                                             {0.0, 0.0},
                                             {90.0, 0.0},
                                             {200.0, -50.0},
                                             {45.0, 35.3},
                                             {135.0, 89.0},
                                             {10.0, -90.0}}) {
        for (NamedView& view : views_from(lattice, azimuth, elevation)) {
            all.push_back(std::move(view));
        }
    }
    std::vector<NamedView> chosen;
    for (std::size_t i = 0; i < all.size(); i += every) {
        chosen.push_back(std::move(all[i]));
    }
    return chosen;
}

image::Image<image::RgbaF> picture_of(const shear::BrickVolume& volume, const view::Lattice& lattice,
                                      const view::TransferFunction& tf, const view::Camera& camera,
                                      const view::ImageSize& size, base::Workers& workers,
                                      const view::Sampling& sampling) {
    const auto factorisation = view::factorise(camera, size, lattice, sampling);
    const auto windows = shear::render(volume, factorisation, tf, workers).windows;
    return image::warp_float(factorisation, windows, camera, size, workers);
}

image::Image<image::Rgba8> in_8_bits(const image::Image<image::RgbaF>& picture) {
    const auto level = [](float x) {
        return static_cast<std::uint8_t>(std::clamp(x, 0.0F, 1.0F) * 255 + 0.5F);
    };
    image::Image<image::Rgba8> result(picture.width(), picture.height());
    std::transform(picture.pixels().begin(), picture.pixels().end(), result.pixels().begin(),
                   [&](const image::RgbaF& p) {
                       return image::Rgba8{level(p.r), level(p.g), level(p.b), 255};
                   });
    return result;
}

view::TransferFunction ramp_to(double opacity) {
    const auto inferno = view::colour_map("inferno");
    base::check(inferno.has_value(), "inferno is a colour map");
    return {.opacity_pins = {view::Ramp{0.1, 0, 1, opacity}}, .colour_pins = *inferno};
}

Match match(Scene& scene, const view::Camera& camera, const view::ImageSize& size) {
    base::Workers workers;
    const auto volume = bricks_of(scene.cube, workers, scene.mapping);
    const auto truth =
        in_8_bits(cast_rays(scene.cube, scene.spacing, scene.mapping, scene.tf, camera, size, workers));
    const auto at = [&](view::Quality quality) {
        return psnr(in_8_bits(picture_of(volume, scene.lattice(), scene.tf, camera, size, workers,
                                         view::sampling(quality))),
                    truth);
    };
    return {at(view::Quality::normal), at(view::Quality::high)};
}

}  // namespace shearwater::test
