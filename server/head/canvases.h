#pragma once
// The intermediate images of the frames that a head is gathering: what Lay, Finish and GiveUp are carried out
// on.

#include <cstddef>
#include <cstdint>
#include <map>

#include "common/image/canvas.h"
#include "protocol/node/merge.h"

namespace shearwater::head {

class Canvases {
  public:
    // Merges bands into their frame's, which begins with the first of them.
    const image::Canvas& lay(node::MergeJob& job);
    // A frame has been seen or given up; false if none of it was laid. Its memory goes to the next.
    bool done_with(std::uint64_t frame);

    std::size_t size() const { return by_frame_.size(); }

  private:
    std::map<std::uint64_t, image::Canvas> by_frame_;
    image::Canvas spare_;
};

}  // namespace shearwater::head
