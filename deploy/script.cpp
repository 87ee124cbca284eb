#include "deploy/script.h"

namespace shearwater::deploy {

Script script_of(const ViewOptions& view, const view::AnchoredFunction& function, int pictures, double turn,
                 int in_flight) {
    const auto shot = [=](int index, const KnownCube& cube) -> base::Result<flight::Shot> {
        ViewOptions turned = view;
        turned.orbit.azimuth += index * turn;
        const auto camera = turned.camera(cube.lattice);
        if (!camera) {
            return camera.error();
        }
        auto tf = view::on_scale(function, cube.scale ? &*cube.scale : nullptr);
        if (!tf) {
            return tf.error();
        }
        return flight::Shot{*camera, *std::move(tf), view.scaling};
    };
    return {.pictures = pictures, .in_flight = in_flight, .unit = function.unit, .shot = shot, .keep = {}};
}

}  // namespace shearwater::deploy
