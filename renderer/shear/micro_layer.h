#pragma once
// A layer of micro-bricks across a face's principal axis: which of its octants to visit, in what order.

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/shear/classification.h"
#include "renderer/shear/face_plan.h"
#include "renderer/shear/octant_runs.h"

namespace shearwater::shear {

class MicroLayer {
  public:
    // The part of a layer between micro-bricks with these contents; `layer` counts along the principal axis
    // from the sub-volume's first.
    MicroLayer(const CodeVolume& codes, std::span<const Content> contents, const FacePlan& plan,
               std::int64_t layer, const MicroRun& fast, const MicroRun& slow);

    Visit visit() const { return visit_; }
    // Whether the octants to visit are the same in both halves, as where whole blocks are hidden.
    bool halves_alike() const { return halves_alike_; }

    // Those of a row of octants in the part, front to back; `half` is 0 for those nearer to the cube's first
    // plane.
    void runs(const MicroRun& fast, std::int64_t slow, int half, std::vector<OctantRun>& out) const;

  private:
    const Content& at(std::int64_t fast, std::int64_t slow) const {
        return first_[fast * fast_stride_ + slow * slow_stride_];
    }

    const Content* first_;
    std::ptrdiff_t fast_stride_, slow_stride_;
    const FacePlan& plan_;
    const CodeGrid& grid_;
    Visit visit_ = Visit::none;
    bool halves_alike_ = true;
    std::int64_t first_row_;
    struct Row {
        std::uint8_t opaque_octants = 0;  // that any micro-brick of it has
        std::int64_t first = 0, end = 0;  // micro-bricks that have some
    };
    std::vector<Row> rows_;
};

// How far a run of octants lies along the rays' way: in perspective all go away from the eye, so runs on one
// side of it are in order of distance, and those on different sides are never on one ray.
double distance(const FacePlan& plan, const CodeGrid& grid, int axis, const MicroRun& run);

// Octants [first, end) along an in-plane axis in an order that is front to back along every ray.
void front_to_back(const FacePlan& plan, const CodeGrid& grid, int axis, const MicroRun& range,
                   std::vector<std::int64_t>& order);

}  // namespace shearwater::shear
