#pragma once
// A layer of micro-bricks across a face's principal axis: which of its octants to visit, in what order.

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/shear/classification.h"
#include "renderer/shear/face_plan.h"

namespace shearwater::shear {

// Micro-bricks or octants [first, end) along an axis, counted from where the sub-volume's first micro-brick
// begins.
struct MicroRun {
    std::int64_t first, end;
    bool operator==(const MicroRun&) const = default;
};

// What to do with the samples in a part of a layer.
enum class Visit {
    none,         // nothing: none has opacity
    full,         // all of them, or most, may have some, and no voxel is blank
    with_blanks,  // so, but voxels may be blank
    parts,        // it differs
};

class MicroLayer {
  public:
    // The part of a layer between micro-bricks with these contents; `layer` counts along the principal axis
    // from the sub-volume's first.
    MicroLayer(const CodeVolume& codes, std::span<const Content> contents, const FacePlan& plan,
               std::int64_t layer, const MicroRun& fast, const MicroRun& slow);

    Visit visit() const { return visit_; }

    // Octants of a row to visit alike. What is between two such and a little more work than going round it
    // is visited with them.
    struct Run {
        MicroRun along;
        Visit visit;
        bool operator==(const Run&) const = default;
    };
    // Those of a row of octants in the part, front to back; `half` is 0 for those nearer to the cube's first
    // plane.
    void runs(const MicroRun& fast, std::int64_t slow, int half, std::vector<Run>& out) const;

  private:
    const Content& at(std::int64_t fast, std::int64_t slow) const {
        return first_[fast * fast_stride_ + slow * slow_stride_];
    }

    const Content* first_;
    std::ptrdiff_t fast_stride_, slow_stride_;
    const FacePlan& plan_;
    const CodeGrid& grid_;
    Visit visit_ = Visit::none;
    std::int64_t first_row_;
    struct Row {
        std::uint8_t opaque_octants = 0;  // that any micro-brick of it has
        std::int64_t first = 0, end = 0;  // micro-bricks that have some
    };
    std::vector<Row> rows_;
};

// Octants [first, end) along an in-plane axis in an order that is front to back along every ray.
void front_to_back(const FacePlan& plan, const CodeGrid& grid, int axis, const MicroRun& range,
                   std::vector<std::int64_t>& order);

}  // namespace shearwater::shear
