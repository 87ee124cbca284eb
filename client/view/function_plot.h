#pragma once
// The plot of a transfer function: the cube's histogram by the logarithm of counts, each pin's outline, what
// they make together, and the mouse on it.

#include "client/view/desk.h"

namespace shearwater::ui {

// Where the plot is on the screen, and the way between it and (s, opacity).
struct Plot {
    ImVec2 from, to;
    model::OpacityAxis axis;

    float width() const { return to.x - from.x; }
    float height() const { return to.y - from.y; }
    float x(double s) const { return from.x + width() * static_cast<float>(s); }
    float y(double opacity) const {
        return to.y - height() * static_cast<float>(model::height_share(axis, opacity));
    }
    double s_at(float px) const { return static_cast<double>((px - from.x) / width()); }
    double share_at(float py) const { return static_cast<double>((to.y - py) / height()); }
};

void function_plot(Desk& desk, const Plot& plot);
// What the mouse does on it (plot_mouse.cpp). Whether it is there.
bool plot_mouse(Desk& desk, const Plot& plot);
// Where a pin's handles are drawn: those that would cover another are moved aside, and none is out of sight.
std::vector<ImVec2> handle_places(const Desk& desk, const Plot& plot, const view::OpacityPin& pin);
// Round positions in the unit that is shown, under the plot.
void value_marks(const Desk& desk, const Plot& plot, float y);

// The chosen unit, or data values where the cube has no such.
view::Unit shown_unit(const Desk& desk);
view::ValueScale scale_of(const Desk& desk);
void add_pin(Desk& desk, model::Shape shape, double s, double opacity);

}  // namespace shearwater::ui
