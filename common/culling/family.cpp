#include "common/culling/family.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace shearwater::culling {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

double height_of(const view::OpacityPin& pin) {
    return std::visit(Overloaded{[](const view::Ramp& ramp) { return std::max(ramp.a0, ramp.a1); },
                                 [](const view::Hat& hat) { return hat.height; },
                                 [](const view::Flat& flat) { return flat.height; },
                                 [](const view::Blank&) { return 0.0; }},
                      pin);
}

view::OpacityPin scaled(view::OpacityPin pin, double factor) {
    std::visit(Overloaded{[&](view::Ramp& ramp) {
                              ramp.a0 *= factor;
                              ramp.a1 *= factor;
                          },
                          [&](view::Hat& hat) { hat.height *= factor; },
                          [&](view::Flat& flat) { flat.height *= factor; }, [](view::Blank&) {}},
               pin);
    return pin;
}

}  // namespace

std::vector<Member> members_of(const view::TransferFunction& tf) {
    std::vector<view::Blank> blanks;
    for (const view::OpacityPin& pin : tf.opacity_pins) {
        if (const auto* const blank = std::get_if<view::Blank>(&pin)) {
            blanks.push_back(*blank);
        }
    }
    std::vector<Member> members;
    for (const view::OpacityPin& pin : tf.opacity_pins) {
        const double height = height_of(pin);
        if (height >= least_height) {
            members.push_back({{scaled(pin, 1 / height), blanks}, height});
        }
    }
    return members;
}

double lifted(double rate, double height, double distance) {
    // The shape's value, were it the same all along.
    const double value = std::min(-std::expm1(-rate * least_height) / least_height, 1.0);
    return std::min(-std::log1p(-height * value), view::TransferFunction::opaque) * distance;
}

view::TransferFunction at_height(const Basis& basis, double height) {
    view::TransferFunction tf{
        .opacity_pins = {scaled(basis.shape, height)}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}};
    tf.opacity_pins.insert(tf.opacity_pins.end(), basis.blanks.begin(), basis.blanks.end());
    return tf;
}

Support support_of(const Basis& basis) {
    return std::visit(Overloaded{[](const view::Ramp& ramp) {
                                     return Support{ramp.a0 > 0 ? 0 : ramp.x0, ramp.a1 > 0 ? 1 : ramp.x1};
                                 },
                                 [](const view::Hat& hat) {
                                     const double half = std::max(hat.base, hat.top) / 2;
                                     return Support{hat.centre - half, hat.centre + half};
                                 },
                                 [](const auto&) { return Support{}; }},
                      basis.shape);
}

// Intervals in the order of their ends: the best of those up to one is the best without it, or with it and
// the best of those that end before it begins.
Combination::Combination(std::span<const Member> members)
    : by_end_(members.size()), best_(members.size() + 1) {
    std::vector<Support> supports;
    for (const Member& member : members) {
        supports.push_back(support_of(member.basis));
    }
    std::iota(by_end_.begin(), by_end_.end(), std::size_t{0});
    std::sort(by_end_.begin(), by_end_.end(),
              [&](std::size_t a, std::size_t b) { return supports[a].hi < supports[b].hi; });
    for (const std::size_t member : by_end_) {
        const auto apart = std::partition_point(by_end_.begin(), by_end_.end(), [&](std::size_t other) {
            return supports[other].hi <= supports[member].lo;
        });
        before_.push_back(static_cast<std::size_t>(apart - by_end_.begin()));
    }
}

float Combination::operator()(std::span<const float> rates) const {
    for (std::size_t n = 0; n < by_end_.size(); ++n) {
        best_[n + 1] = std::max(best_[n], best_[before_[n]] + rates[by_end_[n]]);
    }
    return best_[by_end_.size()];
}

}  // namespace shearwater::culling
