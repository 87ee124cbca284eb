#include "client/view/widgets.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace shearwater::ui {

std::string bytes_text(double bytes) {
    for (const char* unit : {"B", "kB", "MB", "GB"}) {
        if (bytes < 999.5) {
            return fmt::format("{:.{}f} {}", bytes, bytes < 9.95 && *unit != 'B' ? 1 : 0, unit);
        }
        bytes /= 1000;
    }
    return fmt::format("{:.1f} TB", bytes);
}

std::string value_text(double value) {
    return fmt::format("{:.3g}", value);
}

void text(ImU32 colour, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    ImGui::PopStyleColor();
}

void small_text(const Desk& desk, ImU32 colour, const std::string& words) {
    ImGui::PushFont(desk.fonts.small);
    text(colour, words);
    ImGui::PopFont();
}

bool section(Desk& desk, const char* title, bool unfolded_at_first) {
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID(title);
    bool unfolded = kept.GetBool(id, unfolded_at_first);
    ImGui::Dummy({0, desk.px(3)});
    ImGui::PushFont(desk.fonts.small);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() + desk.px(2)};
    if (ImGui::InvisibleButton(title, size)) {
        unfolded = !unfolded;
        kept.SetBool(id, unfolded);
    }
    desk.controls.note(std::string("section/") + title);
    const ImU32 colour = ImGui::IsItemHovered() ? theme::text : theme::muted;
    const float mark = desk.px(8);
    const float y = from.y + ImGui::GetTextLineHeight() / 2;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 middle{from.x + mark / 2, y};
    const float r = mark / 2;
    if (unfolded) {
        list.AddTriangleFilled({middle.x - r, middle.y - r / 2}, {middle.x + r, middle.y - r / 2},
                               {middle.x, middle.y + r * 0.7F}, colour);
    } else {
        list.AddTriangleFilled({middle.x - r / 2, middle.y - r}, {middle.x - r / 2, middle.y + r},
                               {middle.x + r * 0.7F, middle.y}, colour);
    }
    const float title_x = from.x + mark + desk.px(6);
    list.AddText({title_x, from.y}, colour, title);
    const float after = title_x + ImGui::CalcTextSize(title).x + desk.px(8);
    list.AddLine({after, y}, {from.x + size.x, y}, theme::line);
    ImGui::PopFont();
    return unfolded;
}

void dot(const Desk& desk, ImU32 colour) {
    const float height = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float radius = desk.px(4);
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + radius, at.y + height * 0.55F}, radius, colour, 16);
    ImGui::Dummy({2 * radius, height});
    ImGui::SameLine();
}

namespace {

// Of labels' buttons in a row: all alike, unless one would not hold its label.
std::vector<float> button_widths(std::initializer_list<const char*> labels, float room) {
    std::vector<float> widths;
    float texts = 0, longest = 0;
    for (const char* const label : labels) {
        widths.push_back(ImGui::CalcTextSize(label).x);
        texts += widths.back();
        longest = std::max(longest, widths.back());
    }
    const float count = static_cast<float>(labels.size());
    const bool alike = longest + ImGui::GetStyle().FramePadding.x <= room / count;
    for (float& width : widths) {
        width = alike ? room / count : width + (room - texts) / count;
    }
    return widths;
}

}  // namespace

int switch_among(Desk& desk, const std::string& name, std::initializer_list<const char*> labels, int holds) {
    const float count = static_cast<float>(labels.size());
    const float gap = desk.px(4);
    const auto widths = button_widths(labels, ImGui::GetContentRegionAvail().x - gap * (count - 1));
    int holds_now = holds;
    int i = 0;
    for (const char* label : labels) {
        if (i > 0) {
            ImGui::SameLine(0, gap);
        }
        if (i == holds) {
            ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(50, 84, 132, 255));
            ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(50, 84, 132, 255));
        }
        holds_now = ImGui::Button(label, {widths[static_cast<std::size_t>(i)], 0}) ? i : holds_now;
        desk.controls.note(name + "/" + label);
        if (i == holds) {
            ImGui::PopStyleColor(2);
        }
        ++i;
    }
    return holds_now;
}

int button_row(Desk& desk, const std::string& name, std::initializer_list<const char*> labels) {
    return switch_among(desk, name, labels, -1);
}

bool begin_choice(Desk& desk, const char* id, const std::string& shown, const std::string& control,
                  const char* tip) {
    if (ImGui::BeginCombo(id, shown.c_str(), ImGuiComboFlags_HeightLargest)) {
        if (desk.escape) {
            ImGui::CloseCurrentPopup();
        }
        return true;
    }
    desk.controls.note(control);
    if (tip != nullptr && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", tip);
    }
    return false;
}

bool number_field(Desk& desk, const std::string& id, double& value) {
    EditorState& editor = desk.editor;
    const ImGuiID own = ImGui::GetID(id.c_str());
    std::array<char, 40> text{};
    if (editor.typing == own) {
        text = editor.typed;
    } else {
        fmt::format_to_n(text.data(), text.size() - 1, "{:.4g}", value == 0 ? 0.0 : value);
    }
    ImGui::InputText(id.c_str(), text.data(), text.size(),
                     ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_CharsNoBlank);
    if (ImGui::IsItemActive()) {
        editor.typing = own;
        editor.typed = text;
        return false;
    }
    if (editor.typing != own) {
        return false;
    }
    editor.typing = 0;
    const bool edited = ImGui::IsItemDeactivatedAfterEdit();
    char* end = nullptr;
    const double number = std::strtod(text.data(), &end);
    if (!edited || end == text.data() || *end != 0 || !std::isfinite(number)) {
        return false;
    }
    value = number;
    return true;
}

void progress_line(const Desk& desk, double fraction, ImU32 colour, float width) {
    const float height = desk.px(4);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float done = width * static_cast<float>(std::clamp(fraction, 0.0, 1.0));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, theme::line, height / 2);
    if (done >= height) {
        list.AddRectFilled(at, {at.x + done, at.y + height}, colour, height / 2);
    }
    ImGui::Dummy({width, height});
}

void draw_gradient(ImDrawList& list, const std::vector<view::ColourPin>& pins, ImVec2 from, ImVec2 to,
                   float rounding) {
    view::TransferFunction tf;
    tf.colour_pins = pins;
    constexpr int steps = 48;
    const auto x = [&](int i) {
        return std::round(from.x + (to.x - from.x) * static_cast<float>(i) / steps);
    };
    for (int i = 0; i < steps; ++i) {
        const ImU32 left = colour_of(tf.colour(static_cast<double>(i) / steps));
        const ImU32 right = colour_of(tf.colour(static_cast<double>(i + 1) / steps));
        list.AddRectFilledMultiColor({x(i), from.y}, {x(i + 1), to.y}, left, right, right, left);
    }
    list.AddRect(from, to, theme::line, rounding);
}

ImU32 colour_of(const view::Rgb& rgb, double alpha) {
    return ImGui::ColorConvertFloat4ToU32({static_cast<float>(rgb.r), static_cast<float>(rgb.g),
                                           static_cast<float>(rgb.b), static_cast<float>(alpha)});
}

}  // namespace shearwater::ui
