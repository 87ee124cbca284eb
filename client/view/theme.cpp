#include "client/view/theme.h"

#include <filesystem>
#include <string>

namespace shearwater::ui::theme {

namespace {

constexpr float text_size = 14, bold_size = 16, small_size = 11.5F;

// Latin, Greek, and what is set in text.
constexpr ImWchar glyphs[] = {0x0020, 0x00FF, 0x0370, 0x03FF, 0x2010, 0x2027, 0};

ImFont* load(const char* name, float size) {
    ImGuiIO& io = ImGui::GetIO();
    for (const char* folder : {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/dejavu-sans-fonts/",
                               "/usr/share/fonts/TTF/"}) {
        const std::string path = std::string(folder) + name;
        std::error_code none;
        if (std::filesystem::is_regular_file(path, none)) {
            return io.Fonts->AddFontFromFileTTF(path.c_str(), size, nullptr, glyphs);
        }
    }
    ImFontConfig config;
    config.SizePixels = size;
    return io.Fonts->AddFontDefault(&config);
}

void set_colours(ImGuiStyle& style) {
    const auto set = [&](ImGuiCol where, ImU32 colour) {
        style.Colors[where] = ImGui::ColorConvertU32ToFloat4(colour);
    };
    set(ImGuiCol_WindowBg, panel);
    set(ImGuiCol_ChildBg, IM_COL32(0, 0, 0, 0));
    set(ImGuiCol_PopupBg, IM_COL32(30, 33, 39, 250));
    set(ImGuiCol_Text, text);
    set(ImGuiCol_TextDisabled, muted);
    set(ImGuiCol_Border, line);
    set(ImGuiCol_Separator, line);
    set(ImGuiCol_FrameBg, IM_COL32(36, 39, 47, 255));
    set(ImGuiCol_FrameBgHovered, IM_COL32(46, 50, 60, 255));
    set(ImGuiCol_FrameBgActive, IM_COL32(52, 57, 69, 255));
    set(ImGuiCol_Button, IM_COL32(36, 39, 47, 255));
    set(ImGuiCol_ButtonHovered, IM_COL32(52, 57, 69, 255));
    set(ImGuiCol_ButtonActive, IM_COL32(62, 68, 82, 255));
    set(ImGuiCol_Header, IM_COL32(46, 58, 80, 255));
    set(ImGuiCol_HeaderHovered, IM_COL32(52, 66, 92, 255));
    set(ImGuiCol_HeaderActive, IM_COL32(58, 74, 104, 255));
    set(ImGuiCol_SliderGrab, accent);
    set(ImGuiCol_SliderGrabActive, IM_COL32(132, 184, 255, 255));
    set(ImGuiCol_CheckMark, accent);
    set(ImGuiCol_PlotHistogram, accent);
    set(ImGuiCol_ModalWindowDimBg, IM_COL32(8, 9, 12, 170));
    set(ImGuiCol_ScrollbarBg, IM_COL32(0, 0, 0, 0));
    set(ImGuiCol_ScrollbarGrab, IM_COL32(58, 63, 74, 255));
}

}  // namespace

Fonts apply(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 0;
    style.WindowBorderSize = 0;
    style.ChildRounding = 4;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.PopupRounding = 6;
    style.ScrollbarSize = 9;
    style.ScrollbarRounding = 4;
    style.WindowPadding = {16, 14};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.ScaleAllSizes(scale);
    set_colours(style);
    return {load("DejaVuSans.ttf", text_size * scale), load("DejaVuSans-Bold.ttf", bold_size * scale),
            load("DejaVuSans.ttf", small_size * scale)};
}

}  // namespace shearwater::ui::theme
