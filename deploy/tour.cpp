// shearwater-tour CUBE.fits OUT.png: the whole pipeline in one process, to be read from top to bottom.
// The daemons do the very same steps; between them lie only links. Every header named here says more.

#include <cstdio>

#include "common/base/workers.h"
#include "common/fits/cube.h"
#include "common/image/over_windows.h"
#include "common/image/png.h"
#include "common/image/warp.h"
#include "common/tree/division.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "common/volume/statistics.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/render.h"

using namespace shearwater;

base::Status tour(const std::string& cube_path, const std::string& png_path) {
    base::Workers workers;

    // 1. Open the cube. Its header is judged before its numbers are believed.
    auto cube = fits::Cube::open(cube_path);
    if (!cube) {
        return cube.error();
    }
    const volume::Index3 n = cube->info().n;
    const volume::Box whole = volume::whole(n);

    // 2. One pass over the voxels counts their values: the limits leave out the rarest, faint and bright.
    const auto histogram = volume::count_values(*cube, whole, n, workers);
    if (!histogram) {
        return histogram.error();
    }
    const volume::Limits limits = volume::percentile_limits(*histogram, 99.5);
    const volume::Mapping mapping{.lo = limits.lo, .hi = limits.hi};

    // 3. Cut the cube in two, as the head of a tree cuts it for its children. The boxes share one plane.
    const auto boxes = tree::divide(whole, std::vector<double>{1, 1});
    if (!boxes) {
        return boxes.error();
    }

    // 4. A second pass loads each box into bricks of 8-bit codes: what a renderer holds.
    std::vector<shear::BrickVolume> leaves;
    for (const volume::Box& box : *boxes) {
        auto leaf = shear::BrickVolume::load(*cube, box, n, mapping, workers);
        if (!leaf) {
            return leaf.error();
        }
        leaves.push_back(*std::move(leaf));
    }

    // 5. The view: a camera on an orbit, and what each value shall look like.
    const view::Lattice lattice{.n = n};
    const view::ImageSize size{.width = 512, .height = 512};
    const view::Camera camera = view::camera_on({.azimuth = 30, .elevation = 20}, lattice);
    const view::TransferFunction tf = view::default_transfer_function();

    // 6. Factorise it once for all leaves. Rays then step from slice to slice along a principal axis, and
    //    all leaves agree on the pixels of the sheared, intermediate image, to the last bit.
    const view::Factorisation factorisation =
        view::factorise(camera, size, lattice, view::sampling(view::Quality::normal));

    // 7. Each leaf renders the window that its box projects to. The nearest box comes first.
    std::vector<image::Window> windows;
    for (const int nearest : view::visibility_order(factorisation, *boxes)) {
        const shear::BrickVolume& leaf = leaves[static_cast<std::size_t>(nearest)];
        for (image::Window& window : shear::render(leaf, factorisation, tf, workers).windows) {
            windows.push_back(std::move(window));
        }
    }

    // 8. A junction lays window over window, front to back. That is all that a compositor does.
    const std::vector<image::Window> merged = image::merge_front_to_back(windows);

    // 9. The head, and nobody below it, warps the intermediate image into the picture.
    const image::Image<image::Rgba8> picture =
        image::warp(factorisation, merged, camera, size, tf.background, workers);
    return image::write_png(png_path, picture);
}

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("usage: shearwater-tour CUBE.fits OUT.png\n", stderr);
        return 2;
    }
    if (const base::Status done = tour(argv[1], argv[2]); !done) {
        std::fprintf(stderr, "shearwater-tour: %s\n", done.error().message().c_str());
        return 2;
    }
    return 0;
}
