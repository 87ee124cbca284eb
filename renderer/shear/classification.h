#pragma once
// A transfer function applied to a volume: what an edit changes. Made once for many views.

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/workers.h"
#include "common/view/transfer_function.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

// Of a micro-brick: what of it may have opacity, and whether one of its voxels is blank.
struct Content {
    std::uint8_t opaque_octants = 0;  // a bit each, counted as Octants are
    bool blanks = false;
};

struct Classification {
    OpacityTable table;
    std::vector<std::vector<Content>>
        micro_bricks;                  // of each level, as CodeVolume::micro_bricks() counts them
    std::vector<std::uint8_t> opaque;  // as BrickVolume::bricks() does: whether one in it is not transparent
};

Classification classify(const BrickVolume& volume, const view::TransferFunction& tf, base::Workers& workers);

// Keeps the last classification of one volume: only an edit of the transfer function makes a new one.
class Classifier {
  public:
    const Classification& classify(const BrickVolume& volume, const view::TransferFunction& tf,
                                   base::Workers& workers);

  private:
    struct Last {
        view::TransferFunction tf;
        Classification result;
    };
    std::optional<Last> last_;
};

}  // namespace shearwater::shear
