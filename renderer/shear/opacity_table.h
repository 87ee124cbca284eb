#pragma once
// A transfer function made ready for the kernel: colour and extinction at nodes along the codes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/view/transfer_function.h"

namespace shearwater::shear {

class OpacityTable {
  public:
    // Colour, not premultiplied, and extinction in depth_unit(). Of a table in one hue, r is the share of
    // hue() that the colour is, and g and b are 0.
    struct Node {
        float r, g, b, extinction;
    };
    // The same for 8-bit codes in the form that byte permutations look up: words, their high and low bytes
    // apart. Colours are of full_colour; an extinction is a float once shifted to the left, rounded.
    struct Bytes {
        static constexpr int full_colour = 32767;
        static constexpr int extinction_shift = 12;
        using Plane = std::array<std::uint8_t, 256>;
        struct Word {
            alignas(64) Plane high, low;
        };
        Word r, g, b, extinction;
    };
    // The greatest extinction in depth_unit(): what is left below it of the words spans nine decades.
    static constexpr float largest = 0x1p-96F;

    // `levels` as Mapping::levels(): codes 1 to levels stand for s from 0 to 1.
    OpacityTable(const view::TransferFunction& tf, int levels);

    // An interpolated code lies at node code * nodes_per_code(): every code is a node for 8 bits, every
    // sixteenth for 16. A sample's colour is that of the nearest node; its extinction is linear between
    // nodes, where a node has the mean over the stretch it is nearest to, so that no pin, however narrow,
    // falls between two.
    float nodes_per_code() const { return nodes_per_code_; }
    // Whether all colours are shares of one, as in a map from black to some colour: then one channel does.
    bool one_hue() const { return one_hue_; }
    const view::Rgb& hue() const { return hue_; }
    // A colour of the transfer function as rays gather it: where there is one hue, its share of that, as r.
    view::Rgb channels(const view::Rgb& colour) const;
    const Node* nodes() const { return nodes_.data(); }  // and one more after the last
    const Bytes& bytes() const { return bytes_; }        // for 8 bits only

    // Along a ray of world length L a sample of extinction e lets 2^(-e * L * depth_unit()) of light pass.
    float depth_unit() const { return depth_unit_; }

    // How much extinction changes at most from one node to the next, in depth_unit().
    float steepest() const { return steepest_; }
    // Nodes before the first and after the last of these have no extinction; first > last if none has any.
    int first_opaque() const { return first_opaque_; }
    int last_opaque() const { return last_opaque_; }
    // What lies between codes that are all less than the first of these, or all greater than the last, has no
    // opacity.
    struct Codes {
        std::int64_t first, last;
    };
    Codes opaque_codes() const;
    // Whether some code from min to max, interpolated ones included, has opacity; none has if min > max.
    bool any_opacity(std::uint16_t min, std::uint16_t max) const;

  private:
    void find_hue();
    void fill_bytes();

    float nodes_per_code_;
    bool one_hue_ = false;
    view::Rgb hue_;
    float depth_unit_;
    float steepest_ = 0;
    int first_opaque_ = 0, last_opaque_ = -1;
    std::vector<Node> nodes_;
    std::vector<int> opaque_before_;  // nodes with opacity before each
    Bytes bytes_{};
};

}  // namespace shearwater::shear
