#pragma once
// Families of transfer functions (POF 3.2): what of a block's opacity functions outlives an edit.
//
// A pin of height h over a shape x(s), 0 to 1, has the extinction e(h) = -ln(1 - h x). At the least height h0
// that is nearly h0 x; and e(h) = g(e(h0)) with
//
//     g(e) = -ln(1 - k (1 - exp(-e))),  k = h / h0 >= 1.
//
// g rises, and is convex: its derivative is k / (k - (k - 1) exp(e)). So the mean of e(h) along a line is at
// least g of the mean of e(h0) (Jensen), and what is least of all lines at h0 gives what no line falls below
// at h. One function of a basis does for all heights, and no edit of one needs another. It is exact where all
// is alike, and else at least h / h0 as much as at h0.
//
// Pins combine by their maximum, and blanks go before all. max(e_1, e_2, ...) is at least each of them, and
// at least the sum of any that are nowhere above 0 together, since of those at most one counts at any value.
// What holds for extinctions at every value holds for their sums along a line, and for the least of those
// over lines only the more: the least of a sum is no less than the sum of the leasts. So a block's rate is at
// least the greatest sum over pins with supports apart. Of all weighings w_i >= 0 of pins with sum w_i e_i <=
// max e_i at every value whatever the heights, that is the best: they have sum w_i <= 1 wherever supports
// overlap, and for intervals the vertices of those are 0 and 1.

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "common/view/transfer_function.h"

namespace shearwater::culling {

// What functions are computed for: a pin of height 1, and the blanks.
struct Basis {
    view::OpacityPin shape;  // not a blank
    std::vector<view::Blank> blanks;
    bool operator==(const Basis&) const = default;
};

// A transfer function as bases and heights.
struct Member {
    Basis basis;
    double height;
    bool operator==(const Member&) const = default;
};
std::vector<Member> members_of(const view::TransferFunction& tf);

// The height that functions are computed at; a pin that is lower is left out of account.
inline constexpr double least_height = 1.0 / 1024;
// The optical depth that a line has at the least along `distance` of the world, a basis being at a height, if
// its mean extinction at the least height is `rate` times that.
double lifted(double rate, double height, double distance);
// A basis at a height, as a transfer function of its own.
view::TransferFunction at_height(const Basis& basis, double height);

// Where the shape is above 0, or a little more.
struct Support {
    double lo = 0, hi = 1;
};
Support support_of(const Basis& basis);

// The greatest sum of rates of members whose supports are apart.
class Combination {
  public:
    explicit Combination(std::span<const Member> members);
    float operator()(std::span<const float> rates) const;

  private:
    std::vector<std::size_t> by_end_;  // members by the end of their support
    std::vector<std::size_t> before_;  // of each of those, how many of them end before it begins
    mutable std::vector<float> best_;
};

}  // namespace shearwater::culling
