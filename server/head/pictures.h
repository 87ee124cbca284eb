#pragma once
// The pictures that a head is making, each out of its intermediate images as far as their bands have come:
// what Lay, Finish and GiveUp are carried out on.

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/base/buffer.h"
#include "common/base/workers.h"
#include "common/image/canvas.h"
#include "common/image/rle.h"
#include "common/image/warp.h"
#include "protocol/node/merge.h"
#include "protocol/wire/convert.h"

namespace shearwater::head {

class Pictures {
  public:
    // Merges bands into their frame's images, which begin with the first of them, and warps and codes what
    // they make possible. The view and the camera, that of the eye, are the same for all of a frame.
    void lay(node::MergeJob& job, const wire::View& view, const view::Camera& camera, base::Workers& workers);
    // The pictures of so many frames in a row, whose last bands are laid, in run lengths, one below the
    // other; with what they lack and what they cost together.
    struct Picture {
        base::Buffer coded;
        node::Account account;
        double warp_seconds = 0;
        double encode_seconds = 0;
    };
    Picture take(std::uint64_t first, std::size_t frames = 1);
    // A frame that was begun comes to nothing; false if it was not.
    bool give_up(std::uint64_t frame);

    std::size_t size() const { return by_frame_.size(); }

  private:
    struct Making {
        std::shared_ptr<const node::MergedFrame> frame;
        image::Canvas canvas;
        std::optional<image::Warp> warp;         // of the canvas
        std::optional<image::RlePieces> pieces;  // stripes of its picture
        node::Account account;                   // once the last band is laid
        double warp_seconds = 0;
        double encode_seconds = 0;
    };

    std::map<std::uint64_t, Making> by_frame_;
    static constexpr std::size_t most_spare = 2;
    std::vector<image::Canvas> spare_;  // frames' memory goes to the next
};

}  // namespace shearwater::head
