#pragma once
// A transfer function applied to a volume: what an edit changes. Made once for many views.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/workers.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/octant_runs.h"
#include "renderer/shear/opacity_table.h"
#include "renderer/shear/segment_table.h"
#include "renderer/shear/sparse_pieces.h"

namespace shearwater::shear {

struct Classification {
    OpacityTable table;
    std::optional<SegmentTable> segments;  // where classification is pre-integrated
    std::vector<std::vector<Content>>
        micro_bricks;                  // of each level, as CodeVolume::micro_bricks() counts them
    std::vector<std::uint8_t> opaque;  // as BrickVolume::bricks() does: whether one in it is not transparent
    // Of each level, where pieces of what may be seen pay.
    std::vector<bool> is_sparse;
    std::unique_ptr<SparseFaces> sparse = std::make_unique<SparseFaces>();
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
