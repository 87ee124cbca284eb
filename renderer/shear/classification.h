#pragma once
// A transfer function applied to a volume: what an edit changes. Made once for many views.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/workers.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/opacity_table.h"
#include "renderer/shear/segment_table.h"

namespace shearwater::shear {

// Of a micro-brick: what of it may have opacity, samples in it or segments that begin in it, and whether one
// of the voxels between which they lie is blank.
struct Content {
    std::uint8_t opaque_octants = 0;  // a bit each, counted as Octants are
    bool blanks = false;
};

struct Classification {
    OpacityTable table;
    std::optional<SegmentTable> segments;  // where classification is pre-integrated
    std::vector<std::vector<Content>>
        micro_bricks;                  // of each level, as CodeVolume::micro_bricks() counts them
    std::vector<std::uint8_t> opaque;  // as BrickVolume::bricks() does: whether one in it is not transparent
};

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, view::Classify how,
                        base::Workers& workers);

// Keeps the last classification of one volume: only an edit of the transfer function, or
// another way to apply it, makes a new one.
class Classifier {
  public:
    const Classification& classify(const BrickVolume& volume, const view::TransferFunction& tf,
                                   view::Classify how, base::Workers& workers);

  private:
    struct Last {
        view::TransferFunction tf;
        view::Classify how;
        Classification result;
    };
    std::optional<Last> last_;
};

}  // namespace shearwater::shear
