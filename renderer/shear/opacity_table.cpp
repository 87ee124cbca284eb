#include "renderer/shear/opacity_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/shear/extinction_means.h"

namespace shearwater::shear {

namespace {

constexpr int codes_per_node_16 = 16;

// The word that becomes the float x, 0 <= x <= largest, once shifted; 0 where x is too small for one that is
// normal.
std::uint16_t word_of_extinction(float x) {
    constexpr int shift = OpacityTable::Bytes::extinction_shift;
    if (x < std::numeric_limits<float>::min()) {
        return 0;
    }
    return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(x) + (1U << (shift - 1))) >> shift);
}

}  // namespace

OpacityTable::OpacityTable(const view::TransferFunction& tf, int levels) {
    const int codes_per_node = levels == 255 ? 1 : codes_per_node_16;
    const int count = (levels + 1) / codes_per_node + 1;
    nodes_per_code_ = 1.0F / static_cast<float>(codes_per_node);
    const ExtinctionMeans means(tf);
    std::vector<double> extinctions;
    for (int i = 0; i < count; ++i) {
        const double s = std::clamp((i * codes_per_node - 1.0) / (levels - 1), 0.0, 1.0);
        const view::Rgb colour = tf.colour(s);
        nodes_.push_back(
            {static_cast<float>(colour.r), static_cast<float>(colour.g), static_cast<float>(colour.b), 0});
        extinctions.push_back(means.about(s, 0.5 * codes_per_node / (levels - 1)));
    }
    const double unit = *std::max_element(extinctions.begin(), extinctions.end()) / double{largest};
    depth_unit_ = static_cast<float>(unit * std::numbers::log2e);
    opaque_before_.push_back(0);
    for (int i = 0; i < count; ++i) {
        Node& node = nodes_[static_cast<std::size_t>(i)];
        node.extinction = unit > 0 ? static_cast<float>(extinctions[static_cast<std::size_t>(i)] / unit) : 0;
        steepest_ = i > 0 ? std::max(steepest_, std::abs(node.extinction - (&node)[-1].extinction)) : 0;
        opaque_before_.push_back(opaque_before_.back() + (node.extinction > 0 ? 1 : 0));
    }
    const auto opaque = [](const Node& node) { return node.extinction > 0; };
    const auto first = std::find_if(nodes_.begin(), nodes_.end(), opaque);
    const auto last = std::find_if(nodes_.rbegin(), nodes_.rend(), opaque);
    first_opaque_ = static_cast<int>(first - nodes_.begin());
    last_opaque_ = static_cast<int>(nodes_.rend() - last) - 1;
    find_hue();
    nodes_.push_back(nodes_.back());
    if (codes_per_node == 1) {
        fill_bytes();
    }
}

void OpacityTable::find_hue() {
    const auto brightest = std::max_element(nodes_.begin(), nodes_.end(), [](const Node& a, const Node& b) {
        return a.r + a.g + a.b < b.r + b.g + b.b;
    });
    const Node full = *brightest;
    const float square = full.r * full.r + full.g * full.g + full.b * full.b;
    const auto share = [&](const Node& node) {
        return square > 0 ? (node.r * full.r + node.g * full.g + node.b * full.b) / square : 0;
    };
    // As near as a quarter of a level of 255.
    constexpr float tolerance = 1.0F / 1024;
    one_hue_ = std::all_of(nodes_.begin(), nodes_.end(), [&](const Node& node) {
        const float s = share(node);
        return s <= 1 && std::abs(node.r - s * full.r) <= tolerance &&
               std::abs(node.g - s * full.g) <= tolerance && std::abs(node.b - s * full.b) <= tolerance;
    });
    if (one_hue_) {
        hue_ = {full.r, full.g, full.b};
        for (Node& node : nodes_) {
            node = {share(node), 0, 0, node.extinction};
        }
    }
}

view::Rgb OpacityTable::channels(const view::Rgb& colour) const {
    if (!one_hue_) {
        return colour;
    }
    const double square = hue_.r * hue_.r + hue_.g * hue_.g + hue_.b * hue_.b;
    const double along = colour.r * hue_.r + colour.g * hue_.g + colour.b * hue_.b;
    return {square > 0 ? along / square : 0, 0, 0};
}

void OpacityTable::fill_bytes() {
    for (std::size_t code = 0; code < 256; ++code) {
        const auto put = [code](std::uint16_t word, Bytes::Word& table) {
            table.high[code] = static_cast<std::uint8_t>(word >> 8);
            table.low[code] = static_cast<std::uint8_t>(word & 255);
        };
        const auto colour = [](float x) {
            return static_cast<std::uint16_t>(std::lround(x * static_cast<float>(Bytes::full_colour)));
        };
        const Node& node = nodes_[code];
        put(colour(node.r), bytes_.r);
        put(colour(node.g), bytes_.g);
        put(colour(node.b), bytes_.b);
        put(word_of_extinction(node.extinction), bytes_.extinction);
    }
}

OpacityTable::Codes OpacityTable::opaque_codes() const {
    const auto codes = static_cast<std::int64_t>(1 / nodes_per_code_);  // from one node to the next
    return {(first_opaque_ - 1) * codes + 1, (last_opaque_ + 1) * codes - 1};
}

bool OpacityTable::any_opacity(std::uint16_t min, std::uint16_t max) const {
    if (min > max) {
        return false;
    }
    const auto first = static_cast<std::size_t>(static_cast<float>(min) * nodes_per_code_);
    const auto last = static_cast<std::size_t>(std::ceil(static_cast<float>(max) * nodes_per_code_));
    return opaque_before_[last + 1] > opaque_before_[first];
}

}  // namespace shearwater::shear
