#pragma once
// A transfer function made ready for pre-integrated classification (Engel, Kraus & Ertl 2001, section 4):
// what lies along a ray between two samples, as if the value changed evenly from the one to the other.
//
//   tau    |    _            A segment of length ds from the value f to b has
//          |   | |             mean tau = (T(b) - T(f)) / (b - f),   alpha = 1 - exp(-mean tau * ds),
//          |   | |             colour   = (K(b) - K(f)) / (T(b) - T(f)),
//          +---+-+-----> s   T being the integral of tau over s and K that of tau times colour: all that the
//            f     b         segment passes through counts, by how much of it there is, and the order in
//                            which it does not (what it takes of its own light is ignored, their eq. 13).
//
// The integrals themselves are kept, not a table over pairs of ends: such a one over every pair of 8-bit
// codes takes 1 MiB, more than the caches have to spare, and 256 of them are still too few ends for a hat of
// two codes; for 16 bits it is out of the question. Differences of integrals lose digits where a faint haze
// meets an opaque hat, so each is kept as a sum of two floats, good for 48 bits: haze 10^-7 as dense as the
// hat keeps its opacity within 10^-3 even where a segment is as short as a node. Both ends and all channels
// of a segment are two loads of 32 bytes.
//
// Ends are rounded to nodes, sixteen to a code of 8 bits, or one to four codes of 16. Where both round to one
// node, tau and colour are the means over the stretch from the node before it to the node after it.

#include <cstdint>
#include <vector>

#include "common/view/transfer_function.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

class SegmentTable {
  public:
    // Integrals up to a node: each the sum of both its parts. Depth is in halvings of light per world unit of
    // length and node, as if s rose by one node; r, g and b are OpacityTable::channels().
    struct alignas(32) Node {
        float depth, r, g, b;
        float depth_rest, r_rest, g_rest, b_rest;
    };

    // `levels` as Mapping::levels(); `colours` is the table of the same function.
    SegmentTable(const view::TransferFunction& tf, int levels, const OpacityTable& colours);

    float nodes_per_code() const { return nodes_per_code_; }
    // The node of an interpolated code.
    int node_of(float code) const { return static_cast<int>(code * nodes_per_code_ + 0.5F); }
    // From -1 to one beyond that of the last code.
    const Node* nodes() const { return nodes_.data() + before_first; }

    // Whether some segment has opacity whose ends lie at codes from min to max, interpolated ones included;
    // none has if min > max.
    bool any_opacity(std::uint16_t min, std::uint16_t max) const;

  private:
    static constexpr int before_first = 1;

    float nodes_per_code_;
    std::vector<Node> nodes_;
};

}  // namespace shearwater::shear
