#include "deploy/script.h"

namespace shearwater::deploy {

Script script_of(const ViewOptions& view, const view::TransferFunction& tf, int pictures, double turn,
                 int in_flight) {
    const auto shot = [=](int index, const view::Lattice& lattice) -> base::Result<flight::Shot> {
        ViewOptions turned = view;
        turned.orbit.azimuth += index * turn;
        const auto camera = turned.camera(lattice);
        if (!camera) {
            return camera.error();
        }
        return flight::Shot{*camera, tf};
    };
    return {.pictures = pictures, .in_flight = in_flight, .shot = shot, .keep = {}};
}

}  // namespace shearwater::deploy
