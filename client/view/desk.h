#pragma once
// What the widgets draw from and change in one pass; the app turns the changes into wishes.

#include <string>

#include "client/model/session.h"
#include "client/view/controls.h"
#include "client/view/editor_state.h"
#include "client/view/preset_shelf.h"
#include "client/view/texture.h"
#include "client/view/theme.h"

namespace shearwater::ui {

struct Desk {
    Desk(theme::Fonts fonts_in, float scale_in, PresetShelf& presets_in)
        : fonts(fonts_in), scale(scale_in), presets(presets_in) {}

    const theme::Fonts fonts;
    const float scale;
    PresetShelf& presets;

    // From the network.
    model::Status status;
    Texture picture;
    std::uint64_t picture_revision = 0;
    view::Quality picture_quality = view::Quality::normal;

    // What the person sets.
    model::Wish wish;
    model::Effort effort;
    bool dragging = false;  // something is held down while it changes the wish
    bool retry = false;     // asked to dial now
    bool escape = false;    // the key was pressed in this pass
    bool panel = true;
    bool dock = true;
    int dock_tab = 0;
    Controls controls;
    EditorState editor;

    float px(float nominal) const { return nominal * scale; }
    bool has_cube() const { return status.cube.has_value(); }
    void reset_view() { wish.viewpoint = {.orbit = {}, .projection = wish.viewpoint.projection}; }
    view::Quality best_quality() const { return effort.fixed.value_or(view::Quality::high); }
    const view::Lattice& lattice() const { return status.cube->lattice; }
};

}  // namespace shearwater::ui
