#include <fmt/core.h>

#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

void cube_section(Desk& desk) {
    if (!section(desk, "CUBE")) {
        return;
    }
    if (!desk.has_cube()) {
        text(theme::muted, "not known yet");
        return;
    }
    const model::Cube& cube = *desk.status.cube;
    const auto& n = cube.lattice.n;
    text(theme::text, cube.object.empty() ? cube.name : cube.object);
    if (!cube.object.empty()) {
        small_text(desk, theme::muted, cube.name);
    }
    small_text(desk, theme::muted,
               fmt::format("{} \u00d7 {} \u00d7 {} voxels, {} bits", n[0], n[1], n[2], cube.mapping.bits));
    small_text(desk, theme::muted,
               fmt::format("{}{} to {}{}{}, {}", cube.provisional ? "about " : "",
                           value_text(cube.mapping.lo), value_text(cube.mapping.hi),
                           cube.unit.empty() ? "" : " ", cube.unit, volume::name(cube.mapping.stretch)));
}

}  // namespace shearwater::ui
