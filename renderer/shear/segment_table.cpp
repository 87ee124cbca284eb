#include "renderer/shear/segment_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/shear/extinction_means.h"

namespace shearwater::shear {

namespace {

constexpr float nodes_per_code_8 = 16;
constexpr float nodes_per_code_16 = 0.25F;

void split(double sum, float& whole, float& rest) {
    whole = static_cast<float>(sum);
    rest = static_cast<float>(sum - static_cast<double>(whole));
}

}  // namespace

SegmentTable::SegmentTable(const view::TransferFunction& tf, int levels, const OpacityTable& colours)
    : nodes_per_code_(levels == 255 ? nodes_per_code_8 : nodes_per_code_16) {
    const int last = node_of(static_cast<float>(levels));
    nodes_.resize(static_cast<std::size_t>(last + 2 + before_first));
    const ExtinctionMeans means(tf);
    const auto nodes_per_code = static_cast<double>(nodes_per_code_);
    const double half_width = 0.5 / nodes_per_code / (levels - 1);
    double depth = 0, r = 0, g = 0, b = 0;
    for (std::size_t n = 1; n < nodes_.size(); ++n) {
        // The stretch from the node before to this one.
        const double middle = (static_cast<double>(n) - before_first - 0.5) / nodes_per_code;
        const double s = std::clamp((middle - 1) / (levels - 1), 0.0, 1.0);
        const double extinction = means.about(s, half_width) * std::numbers::log2e;
        const view::Rgb colour = colours.channels(tf.colour(s));
        depth += extinction;
        r += extinction * colour.r;
        g += extinction * colour.g;
        b += extinction * colour.b;
        Node& node = nodes_[n];
        split(depth, node.depth, node.depth_rest);
        split(r, node.r, node.r_rest);
        split(g, node.g, node.g_rest);
        split(b, node.b, node.b_rest);
    }
}

bool SegmentTable::any_opacity(std::uint16_t min, std::uint16_t max) const {
    if (min > max) {
        return false;
    }
    // Rounding may take an interpolated code to the next node beyond the ends, and an end to its neighbour.
    const int last = static_cast<int>(nodes_.size()) - before_first - 1;
    const Node& from = nodes()[std::max(node_of(min) - 2, -before_first)];
    const Node& to = nodes()[std::min(node_of(max) + 2, last)];
    return to.depth != from.depth || to.depth_rest != from.depth_rest;
}

}  // namespace shearwater::shear
