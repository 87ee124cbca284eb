#include "renderer/shear/opacity_table.h"

#include <algorithm>

namespace shearwater::shear {

OpacityTable::OpacityTable(const view::TransferFunction& tf, int levels)
    : scale_(static_cast<float>(entries - 1) / static_cast<float>(levels - 1)), bias_(0.5F - scale_) {
    entries_.reserve(entries);
    opaque_before_.push_back(0);
    for (int i = 0; i < entries; ++i) {
        const double s = static_cast<double>(i) / (entries - 1);
        const view::Rgb colour = tf.colour(s);
        entries_.push_back({static_cast<float>(colour.r), static_cast<float>(colour.g),
                            static_cast<float>(colour.b), static_cast<float>(tf.extinction(s))});
        opaque_before_.push_back(opaque_before_.back() + (entries_.back().extinction > 0 ? 1 : 0));
    }
}

bool OpacityTable::any_opacity(std::uint16_t min, std::uint16_t max) const {
    if (min > max) {
        return false;
    }
    // One entry more on either side: interpolation may round beyond its corners.
    const int first = std::max(static_cast<int>(static_cast<float>(min) * scale_ + bias_) - 1, 0);
    const int last = std::min(static_cast<int>(static_cast<float>(max) * scale_ + bias_) + 1, entries - 1);
    return opaque_before_[static_cast<std::size_t>(last) + 1] >
           opaque_before_[static_cast<std::size_t>(first)];
}

}  // namespace shearwater::shear
