#include <fmt/core.h>

#include "client/model/limits.h"
#include "client/view/sections.h"
#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

// Scales the cube's values anew, for all who look at it. Its voxels are read once more.
void rescale(Desk& desk, const volume::Scaling& scaling) {
    if (const auto valid = model::validate(scaling); !valid) {
        desk.say(valid.error().detail, true);
        return;
    }
    if (desk.hold_values) {
        desk.wish.tf = model::held(desk.wish.tf, *desk.status.cube, scaling);
    }
    desk.wish.scaling = scaling;
}

void typed_limits(Desk& desk, volume::Scaling scaling) {
    const float gap = desk.px(4);
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    bool entered = false;
    for (double* const limit : {&scaling.lo, &scaling.hi}) {
        const bool is_low = limit == &scaling.lo;
        ImGui::SetNextItemWidth(width);
        entered |= ImGui::InputDouble(is_low ? "##low" : "##high", limit, 0, 0, "%.6g",
                                      ImGuiInputTextFlags_EnterReturnsTrue);
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", is_low ? "what is no more than this is drawn as the lowest value"
                                           : "what is no less than this is drawn as the highest value");
        }
        desk.controls.note(is_low ? "limits/low" : "limits/high");
        if (is_low) {
            ImGui::SameLine(0, gap);
        }
    }
    if (entered) {
        rescale(desk, scaling);
    }
}

void stretches(Desk& desk, volume::Scaling scaling) {
    const int held = static_cast<int>(scaling.stretch);
    const int holds = switch_among(desk, "limits", {"linear", "sqrt", "log", "asinh"}, held);
    if (holds != held) {
        scaling.stretch = static_cast<volume::Stretch>(holds);
        rescale(desk, scaling);
    }
}

void found_limits(Desk& desk) {
    const auto pressed = [&](int button, model::LimitsBy first) {
        if (button >= 0) {
            const auto by = static_cast<model::LimitsBy>(static_cast<int>(first) + button);
            if (const auto scaling = model::scaling_by(by, *desk.status.cube)) {
                rescale(desk, *scaling);
            }
        }
    };
    const auto& values = desk.status.cube->values;
    ImGui::BeginDisabled(!values || values->empty());
    pressed(button_row(desk, "limits", {"min/max", "99.9", "99.5", "99", "95", "zscale"}),
            model::LimitsBy::all);
    ImGui::EndDisabled();
}

}  // namespace

void limits_section(Desk& desk) {
    if (!section(desk, "LIMITS") || !desk.has_cube()) {
        return;
    }
    const volume::Scaling scaling = desk.status.cube->mapping.scaling();
    typed_limits(desk, scaling);
    found_limits(desk);
    stretches(desk, scaling);
    ImGui::Checkbox("pins keep their values", &desk.hold_values);
    desk.controls.note("limits/hold");
    if (desk.wish.scaling) {
        ImGui::SameLine();
        const char* const words = "As served";
        ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(words).x -
                             2 * ImGui::GetStyle().FramePadding.x);
        if (ImGui::Button(words)) {
            desk.wish.scaling.reset();
        }
        desk.controls.note("limits/served");
    }
}

}  // namespace shearwater::ui
