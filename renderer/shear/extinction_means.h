#pragma once
// The mean of a transfer function's extinction over a stretch of values: what a table holds of it, so that no
// pin, however narrow, falls between two entries.

#include <vector>

#include "common/view/transfer_function.h"

namespace shearwater::shear {

class ExtinctionMeans {
  public:
    // `tf` has to outlive it.
    explicit ExtinctionMeans(const view::TransferFunction& tf);

    // About s, as far as `half_width` to both sides within [0, 1]; s is in [0, 1]. Where no pin begins, ends
    // or bends there, that is the extinction at s.
    double about(double s, double half_width) const;

  private:
    const view::TransferFunction& tf_;
    std::vector<double> bends_;  // where its pins do, rising
};

}  // namespace shearwater::shear
