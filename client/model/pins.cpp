#include "client/model/pins.h"

#include <algorithm>
#include <cmath>

namespace shearwater::model {

namespace {

using view::Blank;
using view::Flat;
using view::Hat;
using view::OpacityPin;
using view::Ramp;

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

constexpr double usual_width = 0.2;

double share(double a) {
    return std::clamp(a, 0.0, 1.0);
}
double position(double x) {
    constexpr double far = view::TransferFunction::farthest / 4;  // so that widths keep within it too
    return std::clamp(x, -far, far);
}

// Feet and shoulders, rising.
using Corners = std::array<double, 4>;

Corners corners_of(const Hat& hat) {
    const double middle = hat.centre + hat.lean;
    return {hat.centre - hat.base / 2, middle - hat.top / 2, middle + hat.top / 2, hat.centre + hat.base / 2};
}

// With its top within its base, and all of it within reach.
Hat kept(Hat hat) {
    hat.centre = position(hat.centre);
    hat.base = std::clamp(hat.base, 0.0, view::TransferFunction::farthest / 2);
    hat.top = std::clamp(hat.top, 0.0, hat.base);
    const double room = (hat.base - hat.top) / 2;
    // An upright hat stays so, whatever the roundings.
    hat.lean = std::abs(hat.lean) < 1e-12 ? 0 : std::clamp(hat.lean, -room, room);
    return hat;
}

Hat hat_of(const Corners& c, double height) {
    const double centre = (c[0] + c[3]) / 2;
    return kept({.centre = centre,
                 .top = c[2] - c[1],
                 .base = c[3] - c[0],
                 .height = height,
                 .lean = (c[1] + c[2]) / 2 - centre});
}

struct Extent {
    double lo = 0, hi = 1, height = 0.1;
};

Extent extent_of(const OpacityPin& pin) {
    return std::visit(
        Overloaded{[](const Ramp& ramp) {
                       return Extent{ramp.x0, ramp.x1, std::max(ramp.a0, ramp.a1)};
                   },
                   [](const Hat& hat) {
                       return Extent{hat.centre - hat.base / 2, hat.centre + hat.base / 2, hat.height};
                   },
                   [](const Flat& flat) { return Extent{.height = flat.height}; },
                   [](const Blank& blank) { return Extent{.lo = blank.lo, .hi = blank.hi}; }},
        pin);
}

OpacityPin made(Shape shape, const Extent& extent) {
    const double width = extent.hi - extent.lo, centre = (extent.lo + extent.hi) / 2;
    switch (shape) {
        case Shape::ramp:
            return Ramp{extent.lo, 0, std::max(extent.hi, extent.lo + least_width), extent.height};
        case Shape::hat:
            return kept({.centre = centre, .top = width / 2, .base = width, .height = extent.height});
        case Shape::top_hat:
            return kept({.centre = centre, .top = width, .base = width, .height = extent.height});
        case Shape::triangle:
            return kept({.centre = centre, .top = 0, .base = width, .height = extent.height});
        case Shape::flat:
            return Flat{extent.height};
        case Shape::blank:
            return Blank{extent.lo, extent.hi};
    }
    return Flat{};
}

Hat with_edge(const Hat& hat, std::size_t handle, double s) {
    Hat moved = hat;
    if (handle <= 2) {  // a shoulder
        moved.top = 2 * std::abs(s - hat.centre - hat.lean);
        moved.base = std::max(hat.base, moved.top + 2 * std::abs(hat.lean));
    } else {
        moved.base = 2 * std::abs(s - hat.centre);
    }
    return kept(moved);
}

}  // namespace

std::string_view name(Shape shape) {
    constexpr std::array<std::string_view, 6> names{"ramp", "hat", "top-hat", "triangle", "flat", "blank"};
    return names.at(static_cast<std::size_t>(shape));
}

Shape shape_of(const OpacityPin& pin) {
    return std::visit(
        Overloaded{[](const Ramp&) { return Shape::ramp; },
                   [](const Hat& hat) {
                       return hat.top >= hat.base ? Shape::top_hat
                              : hat.top > 0       ? Shape::hat
                                                  : Shape::triangle;
                   },
                   [](const Flat&) { return Shape::flat; }, [](const Blank&) { return Shape::blank; }},
        pin);
}

OpacityPin new_pin(Shape shape, double s, double height) {
    const double half = shape == Shape::blank ? usual_width / 4 : usual_width / 2;
    const double centre = std::clamp(s, half, 1 - half);
    return made(shape, {centre - half, centre + half, share(height)});
}

OpacityPin retyped(const OpacityPin& pin, Shape shape) {
    return shape_of(pin) == shape ? pin : made(shape, extent_of(pin));
}

std::vector<Handle> handles_of(const OpacityPin& pin) {
    return std::visit(Overloaded{[](const Ramp& ramp) -> std::vector<Handle> {
                                     return {{"low", ramp.x0, ramp.a0}, {"high", ramp.x1, ramp.a1}};
                                 },
                                 [](const Hat& hat) -> std::vector<Handle> {
                                     const Corners c = corners_of(hat);
                                     return {{"top", hat.centre + hat.lean, hat.height},
                                             {"top-low", c[1], hat.height},
                                             {"top-high", c[2], hat.height},
                                             {"base-low", c[0], 0},
                                             {"base-high", c[3], 0}};
                                 },
                                 [](const Flat& flat) -> std::vector<Handle> {
                                     return {{"height", 0.5, flat.height}};
                                 },
                                 [](const Blank& blank) -> std::vector<Handle> {
                                     return {{"lo", blank.lo, std::nullopt}, {"hi", blank.hi, std::nullopt}};
                                 }},
                      pin);
}

OpacityPin dragged(const OpacityPin& pin, std::size_t handle, double s, double height) {
    if (!std::isfinite(s) || !std::isfinite(height)) {
        return pin;
    }
    s = position(s);
    const double a = share(height);
    return std::visit(Overloaded{[&](Ramp ramp) -> OpacityPin {
                                     if (handle == 0) {
                                         ramp.x0 = std::min(s, ramp.x1 - least_width);
                                         ramp.a0 = a;
                                     } else {
                                         ramp.x1 = std::max(s, ramp.x0 + least_width);
                                         ramp.a1 = a;
                                     }
                                     return ramp;
                                 },
                                 [&](Hat hat) -> OpacityPin {
                                     if (handle > 0) {
                                         return with_edge(hat, handle, s);
                                     }
                                     hat.centre = s - hat.lean;
                                     hat.height = a;
                                     return kept(hat);
                                 },
                                 [&](Flat) -> OpacityPin { return Flat{a}; },
                                 [&](Blank blank) -> OpacityPin {
                                     (handle == 0 ? blank.lo : blank.hi) = s;
                                     blank.lo = handle == 0 ? std::min(s, blank.hi) : blank.lo;
                                     blank.hi = handle == 0 ? blank.hi : std::max(s, blank.lo);
                                     return blank;
                                 }},
                      pin);
}

OpacityPin shifted(const OpacityPin& pin, double by) {
    if (!std::isfinite(by)) {
        return pin;
    }
    return std::visit(Overloaded{[&](Ramp ramp) -> OpacityPin {
                                     const double width = ramp.x1 - ramp.x0;
                                     ramp.x0 = position(ramp.x0 + by);
                                     ramp.x1 = std::min(ramp.x0 + width, view::TransferFunction::farthest);
                                     return ramp;
                                 },
                                 [&](Hat hat) -> OpacityPin {
                                     hat.centre += by;
                                     return kept(hat);
                                 },
                                 [](Flat flat) -> OpacityPin { return flat; },
                                 [&](Blank blank) -> OpacityPin {
                                     const double width = blank.hi - blank.lo;
                                     blank.lo = position(blank.lo + by);
                                     blank.hi = std::min(blank.lo + width, view::TransferFunction::farthest);
                                     return blank;
                                 }},
                      pin);
}

std::vector<double> edges_of(const OpacityPin& pin) {
    return std::visit(Overloaded{[](const Ramp& ramp) {
                                     return std::vector{ramp.x0, ramp.x1};
                                 },
                                 [](const Hat& hat) {
                                     const Corners c = corners_of(hat);
                                     return std::vector(c.begin(), c.end());
                                 },
                                 [](const Flat&) { return std::vector<double>(); },
                                 [](const Blank& blank) {
                                     return std::vector{blank.lo, blank.hi};
                                 }},
                      pin);
}

double height_at(const OpacityPin& pin, double s) {
    view::TransferFunction alone;
    alone.opacity_pins = {pin};
    return alone.height(s);
}

std::vector<Field> fields_of(const OpacityPin& pin) {
    return std::visit(Overloaded{[](const Ramp&) -> std::vector<Field> {
                                     return {{"x0", false}, {"a0", true}, {"x1", false}, {"a1", true}};
                                 },
                                 [](const Hat&) -> std::vector<Field> {
                                     return {{"from", false},
                                             {"top from", false},
                                             {"top to", false},
                                             {"to", false},
                                             {"height", true}};
                                 },
                                 [](const Flat&) -> std::vector<Field> {
                                     return {{"height", true}};
                                 },
                                 [](const Blank&) -> std::vector<Field> {
                                     return {{"lo", false}, {"hi", false}};
                                 }},
                      pin);
}

double field(const OpacityPin& pin, std::size_t number) {
    return std::visit(
        Overloaded{[&](const Ramp& r) {
                       return std::array{r.x0, r.a0, r.x1, r.a1}.at(number);
                   },
                   [&](const Hat& hat) { return number < 4 ? corners_of(hat).at(number) : hat.height; },
                   [](const Flat& flat) { return flat.height; },
                   [&](const Blank& blank) { return number == 0 ? blank.lo : blank.hi; }},
        pin);
}

OpacityPin with_field(const OpacityPin& pin, std::size_t number, double value) {
    if (!std::isfinite(value)) {
        return pin;
    }
    return std::visit(
        Overloaded{[&](const Ramp& r) -> OpacityPin {
                       const bool low = number < 2;
                       const bool is_height = number % 2 == 1;
                       const double s = is_height ? (low ? r.x0 : r.x1) : value;
                       const double a = is_height ? value : (low ? r.a0 : r.a1);
                       return dragged(r, low ? 0 : 1, s, a);
                   },
                   [&](const Hat& hat) -> OpacityPin {
                       if (number >= 4) {
                           Hat higher = hat;
                           higher.height = share(value);
                           return higher;
                       }
                       // Those before and behind keep their order.
                       Corners c = corners_of(hat);
                       c[number] = position(value);
                       for (std::size_t i = 0; i < number; ++i) {
                           c[i] = std::min(c[i], c[number]);
                       }
                       for (std::size_t i = number + 1; i < c.size(); ++i) {
                           c[i] = std::max(c[i], c[number]);
                       }
                       return hat_of(c, hat.height);
                   },
                   [&](const Flat&) -> OpacityPin { return Flat{share(value)}; },
                   [&](const Blank& blank) -> OpacityPin { return dragged(blank, number, value, 0); }},
        pin);
}

}  // namespace shearwater::model
