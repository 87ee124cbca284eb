#include "renderer/shear/extinction_means.h"

#include <algorithm>
#include <variant>

namespace shearwater::shear {

ExtinctionMeans::ExtinctionMeans(const view::TransferFunction& tf) : tf_(tf) {
    for (const view::OpacityPin& pin : tf.opacity_pins) {
        if (const auto* ramp = std::get_if<view::Ramp>(&pin)) {
            bends_.insert(bends_.end(), {ramp->x0, ramp->x1});
        } else if (const auto* hat = std::get_if<view::Hat>(&pin)) {
            const double top = hat->centre + hat->lean;
            bends_.insert(bends_.end(), {hat->centre - hat->base / 2, top - hat->top / 2, top + hat->top / 2,
                                         hat->centre + hat->base / 2});
        } else if (const auto* blank = std::get_if<view::Blank>(&pin)) {
            bends_.insert(bends_.end(), {blank->lo, blank->hi});
        }
    }
    std::sort(bends_.begin(), bends_.end());
}

double ExtinctionMeans::about(double s, double half_width) const {
    const double end = std::min(s + half_width, 1.0);
    double from = std::max(s - half_width, 0.0);
    auto bend = std::upper_bound(bends_.begin(), bends_.end(), from);
    if (bend == bends_.end() || *bend >= end) {
        return tf_.extinction(s);
    }
    const double width = end - from;
    double sum = 0;
    while (from < end) {
        const double to = bend == bends_.end() ? end : std::min(*bend++, end);
        constexpr int parts = 4;
        for (int i = 0; i < parts; ++i) {
            sum += tf_.extinction(from + (i + 0.5) / parts * (to - from)) * (to - from) / parts;
        }
        from = to;
    }
    return sum / width;
}

}  // namespace shearwater::shear
