#include "client/view/function_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

constexpr ImU32 grid_line = IM_COL32(36, 40, 48, 255);
constexpr ImU32 mark_text = IM_COL32(150, 158, 172, 255);
constexpr ImU32 counts_colour = IM_COL32(62, 72, 92, 255);
constexpr ImU32 first_counts_colour = IM_COL32(46, 52, 64, 255);
constexpr ImU32 outline = IM_COL32(196, 202, 212, 200);
constexpr ImU32 outline_fill = IM_COL32(196, 202, 212, 22);
constexpr ImU32 selected_outline = IM_COL32(255, 196, 92, 255);
constexpr ImU32 selected_fill = IM_COL32(255, 196, 92, 40);

void draw_grid(ImDrawList& list, const Plot& plot) {
    for (const double opacity : model::opacity_marks(plot.axis)) {
        const float y = std::round(plot.y(opacity));
        list.AddLine({plot.from.x, y}, {plot.to.x, y}, grid_line);
    }
}

void draw_opacities(const Desk& desk, ImDrawList& list, const Plot& plot) {
    for (const double opacity : model::opacity_marks(plot.axis)) {
        const float y = std::round(plot.y(opacity));
        list.AddText(desk.fonts.small, desk.fonts.small->FontSize * 0.92F,
                     {plot.from.x + desk.px(4), y - desk.fonts.small->FontSize - desk.px(1)}, theme::text,
                     fmt::format("{:g}", opacity).c_str());
    }
}

// Counts as columns, the fullest as high as the plot.
void draw_counts(const Desk& desk, ImDrawList& list, const Plot& plot) {
    if (!desk.has_cube() || desk.status.cube->values == nullptr || desk.status.cube->values->empty()) {
        const char* words = "the histogram is not known yet";
        list.AddText(desk.fonts.small, desk.fonts.small->FontSize,
                     {plot.from.x + desk.px(60), plot.from.y + desk.px(4)}, mark_text, words);
        return;
    }
    const std::vector<std::uint64_t>& counts = desk.status.cube->values->counts;
    const double most = std::log1p(static_cast<double>(*std::max_element(counts.begin(), counts.end())));
    const double bins = static_cast<double>(counts.size());
    const bool first = desk.status.cube->provisional_values;
    for (std::size_t i = 0; i < counts.size() && most > 0; ++i) {
        const double share = std::log1p(static_cast<double>(counts[i])) / most;
        const float top = plot.to.y - plot.height() * static_cast<float>(0.94 * share);
        if (counts[i] > 0) {
            list.AddRectFilled({plot.x(static_cast<double>(i) / bins), std::min(top, plot.to.y - 1)},
                               {plot.x(static_cast<double>(i + 1) / bins), plot.to.y},
                               first ? first_counts_colour : counts_colour);
        }
    }
    if (first) {
        list.AddText(desk.fonts.small, desk.fonts.small->FontSize,
                     {plot.from.x + desk.px(60), plot.from.y + desk.px(4)}, theme::busy, "of a first look");
    }
}

void draw_blank(const Desk& desk, ImDrawList& list, const Plot& plot, const view::Blank& blank,
                bool selected) {
    const float from = plot.x(std::clamp(blank.lo, 0.0, 1.0)), to = plot.x(std::clamp(blank.hi, 0.0, 1.0));
    const ImU32 colour = selected ? selected_outline : outline;
    list.AddRectFilled({from, plot.from.y}, {to, plot.to.y}, selected ? selected_fill : outline_fill);
    list.PushClipRect({from, plot.from.y}, {to, plot.to.y}, true);
    const float step = desk.px(9);
    for (float x = from - plot.height(); x < to; x += step) {
        list.AddLine({x, plot.to.y}, {x + plot.height(), plot.from.y},
                     selected ? selected_fill : IM_COL32(196, 202, 212, 36));
    }
    list.PopClipRect();
    list.AddLine({from, plot.from.y}, {from, plot.to.y}, colour, desk.px(selected ? 1.5F : 1));
    list.AddLine({to, plot.from.y}, {to, plot.to.y}, colour, desk.px(selected ? 1.5F : 1));
}

// One pin alone. Where pins overlap their areas add up.
void draw_pin(const Desk& desk, ImDrawList& list, const Plot& plot, const view::OpacityPin& pin,
              bool selected) {
    if (const auto* blank = std::get_if<view::Blank>(&pin)) {
        return draw_blank(desk, list, plot, *blank, selected);
    }
    view::TransferFunction alone;
    alone.opacity_pins = {pin};
    std::vector<ImVec2> line;
    const int columns = std::max(1, static_cast<int>(plot.width()));
    for (int i = 0; i <= columns; ++i) {
        const ImVec2 at{plot.from.x + static_cast<float>(i),
                        plot.y(alone.height(static_cast<double>(i) / columns))};
        if (i < columns && at.y < plot.to.y) {
            list.AddRectFilled(at, {at.x + 1, plot.to.y}, selected ? selected_fill : outline_fill);
        }
        line.push_back(at);
    }
    list.AddPolyline(line.data(), static_cast<int>(line.size()), selected ? selected_outline : outline, 0,
                     desk.px(selected ? 2 : 1));
}

// The effective opacity, as in the paper's Fig. 6 a thick blue line, over the colours it is for.
void draw_effect(const Desk& desk, ImDrawList& list, const Plot& plot) {
    const view::TransferFunction& tf = desk.wish.tf;
    std::vector<ImVec2> line;
    const int columns = std::max(1, static_cast<int>(plot.width()));
    for (int i = 0; i <= columns; ++i) {
        const double s = static_cast<double>(i) / columns;
        const ImVec2 at{plot.from.x + static_cast<float>(i), plot.y(tf.opacity(s))};
        if (i < columns && at.y < plot.to.y) {
            list.AddRectFilled(at, {at.x + 1, plot.to.y}, colour_of(tf.colour(s), 0.28));
        }
        line.push_back(at);
    }
    list.AddPolyline(line.data(), static_cast<int>(line.size()), IM_COL32(10, 12, 16, 200), 0, desk.px(6));
    list.AddPolyline(line.data(), static_cast<int>(line.size()), theme::accent, 0, desk.px(4));
}

// What is under the mouse, in all units that there are.
void read_out(const Desk& desk, ImDrawList& list, const Plot& plot) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double s = std::clamp(plot.s_at(mouse.x), 0.0, 1.0);
    const view::ValueScale scale = scale_of(desk);
    std::string words;
    for (const view::Unit unit : {view::Unit::value, view::Unit::percentile, view::Unit::sigma}) {
        if (desk.has_cube() && scale.has(unit)) {
            const std::string behind = model::unit_text(unit, desk.status.cube->unit);
            words +=
                model::position_text(scale.from_s(unit, s)) + (behind.empty() ? "" : " ") + behind + "   ";
        }
    }
    words += fmt::format("opacity {}", model::position_text(desk.wish.tf.opacity(s)));
    ImFont* font = desk.fonts.small;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, words.c_str());
    const ImVec2 at{plot.to.x - size.x - desk.px(8), plot.from.y + desk.px(4)};
    list.AddRectFilled({at.x - desk.px(5), at.y - desk.px(2)},
                       {at.x + size.x + desk.px(5), at.y + size.y + desk.px(2)}, IM_COL32(14, 15, 19, 215),
                       desk.px(3));
    list.AddText(font, font->FontSize, at, theme::text, words.c_str());
}

void draw_handles(Desk& desk, ImDrawList& list, const Plot& plot) {
    const EditorState& editor = desk.editor;
    const view::OpacityPin& pin = desk.wish.tf.opacity_pins[*editor.pin];
    const auto handles = model::handles_of(pin);
    const auto places = handle_places(desk, plot, pin);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool lit = editor.held && editor.held->handle == i;
        list.AddCircleFilled(places[i], desk.px(lit ? 6.5F : 5), selected_outline, 20);
        list.AddCircle(places[i], desk.px(lit ? 6.5F : 5), theme::well, 20, desk.px(1.5F));
        desk.controls.note("editor/handle/" + std::string(handles[i].name), places[i]);
    }
}

}  // namespace

view::ValueScale scale_of(const Desk& desk) {
    return desk.has_cube() ? desk.status.cube->scale() : view::ValueScale({});
}

view::Unit shown_unit(const Desk& desk) {
    return scale_of(desk).has(desk.editor.unit) ? desk.editor.unit : view::Unit::value;
}

void add_pin(Desk& desk, model::Shape shape, double s, double opacity) {
    auto& pins = desk.wish.tf.opacity_pins;
    if (pins.size() < view::TransferFunction::max_pins) {
        pins.push_back(model::new_pin(shape, s, opacity));
        desk.editor.pin = pins.size() - 1;
        desk.editor.colour.reset();
    }
}

std::vector<ImVec2> handle_places(const Desk& desk, const Plot& plot, const view::OpacityPin& pin) {
    std::vector<ImVec2> places;
    const float aside = desk.px(13);
    for (const model::Handle& handle : model::handles_of(pin)) {
        ImVec2 at{plot.x(std::clamp(handle.s, 0.0, 1.0)),
                  handle.height ? plot.y(*handle.height) : (plot.from.y + plot.to.y) / 2};
        if (handle.name.starts_with("top")) {
            at.y = std::min(at.y, plot.to.y - aside);
        }
        if (handle.name == "top-low") {
            at.x = std::min(at.x, places[0].x - aside);
        } else if (handle.name == "top-high") {
            at.x = std::max(at.x, places[0].x + aside);
        }
        places.push_back(at);
    }
    return places;
}

void value_marks(const Desk& desk, const Plot& plot, float y) {
    const int wanted = std::max(2, static_cast<int>(plot.width() / desk.px(90)));
    const view::Unit unit = shown_unit(desk);
    ImFont* font = desk.fonts.small;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    float clear = plot.from.x - desk.px(6);  // of what is written already
    const std::string behind = desk.has_cube() ? model::unit_text(unit, desk.status.cube->unit) : "";
    const float behind_width = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, behind.c_str()).x;
    const float end = plot.to.x + desk.px(6) - (behind.empty() ? 0 : behind_width + desk.px(10));
    for (const model::Tick& tick : model::ticks(scale_of(desk), unit, wanted)) {
        const float width = font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, tick.label.c_str()).x;
        const float x = plot.x(tick.s);
        const float from =
            std::clamp(x - width / 2, plot.from.x - desk.px(4), plot.to.x + desk.px(4) - width);
        if (from >= clear && from + width <= end) {
            list.AddText(font, font->FontSize, {std::round(from), y}, mark_text, tick.label.c_str());
            list.AddLine({x, plot.to.y}, {x, plot.to.y + desk.px(4)}, mark_text);
            clear = from + width + desk.px(10);
        }
    }
    list.AddText(font, font->FontSize, {plot.to.x + desk.px(6) - behind_width, y}, theme::text,
                 behind.c_str());
}

void function_plot(Desk& desk, const Plot& plot) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({plot.from.x - desk.px(6), plot.from.y - desk.px(6)},
                       {plot.to.x + desk.px(6), plot.to.y}, theme::well, desk.px(3));
    list.PushClipRect({plot.from.x - desk.px(7), plot.from.y - desk.px(7)},
                      {plot.to.x + desk.px(7), plot.to.y + desk.px(7)}, true);
    draw_counts(desk, list, plot);
    draw_grid(list, plot);
    const auto& pins = desk.wish.tf.opacity_pins;
    for (std::size_t i = 0; i < pins.size(); ++i) {
        if (desk.editor.pin != i) {
            draw_pin(desk, list, plot, pins[i], false);
        }
    }
    if (desk.editor.pin) {
        draw_pin(desk, list, plot, pins[*desk.editor.pin], true);
    }
    draw_effect(desk, list, plot);
    draw_opacities(desk, list, plot);
    const bool is_over = plot_mouse(desk, plot);
    if (desk.editor.pin) {
        draw_handles(desk, list, plot);
    }
    if (is_over || desk.editor.held) {
        read_out(desk, list, plot);
    }
    list.PopClipRect();
}

}  // namespace shearwater::ui
