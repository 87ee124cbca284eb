#pragma once
// What the widgets draw from and change in one pass; the app turns the changes into wishes.

#include <string>

#include "client/model/crop.h"
#include "client/model/session.h"
#include "client/view/controls.h"
#include "client/view/eye_areas.h"
#include "client/view/texture.h"
#include "client/view/theme.h"

namespace shearwater::ui {

struct Desk {
    Desk(theme::Fonts fonts_in, float scale_in) : fonts(fonts_in), scale(scale_in) {}

    const theme::Fonts fonts;
    const float scale;

    // From the network.
    model::Status status;
    Texture picture;
    model::Picture seen;  // that the picture is made from
    std::uint64_t picture_revision = 0;
    view::Quality picture_quality = view::Quality::normal;

    // What the person sets.
    model::Wish wish;
    model::Effort effort;
    Shown shown;                // how a pair of pictures is shown; none: one picture is wanted
    view::StereoSettings eyes;  // of the pair
    bool reshown = false;       // the picture is to be made anew
    bool cropping = false;      // the box's edges and handles are over the picture
    struct CropDrag {
        model::BoxFace face;
        double plane;
    };
    std::optional<CropDrag> crop_drag;  // the face that is held
    bool dragging = false;              // something is held down while it changes the wish
    bool retry = false;                 // asked to dial now
    bool escape = false;                // the key was pressed in this pass
    bool panel = true;
    Controls controls;
    int ramp_end = -1;  // the ramp's end being dragged: 0, 1, or none

    void show(const Shown& how) {
        shown = how;
        reshown = true;
    }
    float px(float nominal) const { return nominal * scale; }
    bool has_cube() const { return status.cube.has_value(); }
    void reset_view() { wish.viewpoint = {.orbit = {}, .projection = wish.viewpoint.projection}; }
    view::Quality best_quality() const { return effort.fixed.value_or(view::Quality::high); }
    const view::Lattice& lattice() const { return status.cube->lattice; }
};

}  // namespace shearwater::ui
