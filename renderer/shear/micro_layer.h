#pragma once
// A layer of micro-bricks across a face's principal axis, and in what order to visit it.

#include <cstdint>
#include <vector>

#include "renderer/shear/classification.h"
#include "renderer/shear/face_plan.h"

namespace shearwater::shear {

// Micro-bricks [first, end) along an axis.
struct MicroRun {
    std::int64_t first, end;
};

class MicroLayer {
  public:
    // `layer` counts along the principal axis from the sub-volume's first.
    MicroLayer(const CodeVolume& codes, const Classification& classification, const FacePlan& plan,
               std::int64_t layer);

    Content at(std::int64_t fast, std::int64_t slow) const {
        return first_[fast * fast_stride_ + slow * slow_stride_];
    }
    // Whether all micro-bricks of a rectangle have one content, namely that of its first.
    bool uniform(const MicroRun& fast, const MicroRun& slow) const;
    // The runs of one content, not transparent, of a row of it, front to back.
    struct Run {
        MicroRun along;
        Content content;
    };
    void runs(const MicroRun& fast, std::int64_t slow, std::vector<Run>& out) const;

  private:
    const Content* first_;
    std::ptrdiff_t fast_stride_, slow_stride_;
    const FacePlan& plan_;
    const CodeGrid& grid_;
};

// Micro-bricks [first, end) along an in-plane axis in an order that is front to back along every ray.
std::vector<std::int64_t> front_to_back(const FacePlan& plan, const CodeGrid& grid, int axis,
                                        const MicroRun& range);

}  // namespace shearwater::shear
