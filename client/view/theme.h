#pragma once
// How the window looks: colours, spacing and type, all scaled together.

#include <imgui.h>

namespace shearwater::ui::theme {

constexpr ImU32 backdrop = IM_COL32(11, 12, 15, 255);
constexpr ImU32 panel = IM_COL32(23, 25, 30, 255);
constexpr ImU32 well = IM_COL32(14, 15, 19, 255);  // plots and lists
constexpr ImU32 line = IM_COL32(48, 52, 61, 255);
constexpr ImU32 text = IM_COL32(224, 228, 235, 255);
constexpr ImU32 muted = IM_COL32(139, 147, 161, 255);
constexpr ImU32 accent = IM_COL32(86, 156, 255, 255);
constexpr ImU32 good = IM_COL32(88, 196, 128, 255);
constexpr ImU32 busy = IM_COL32(240, 180, 80, 255);
constexpr ImU32 bad = IM_COL32(238, 98, 92, 255);
constexpr ImU32 vacant = IM_COL32(84, 90, 102, 255);

struct Fonts {
    ImFont* text = nullptr;
    ImFont* bold = nullptr;
    ImFont* small = nullptr;
};

// Sets the style of the current ImGui context and loads its fonts: DejaVu where it is installed, else the
// one built in. `scale`: pixels per nominal pixel.
Fonts apply(float scale);

}  // namespace shearwater::ui::theme
