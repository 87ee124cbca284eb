#pragma once
// Memory on its way into the caches before it is wanted.

#include <hwy/base.h>

#include "renderer/shear/kernel.h"

namespace shearwater::shear {

// Which cache: the second takes more lines at once than the first waits for, and keeps them longer.
enum class Into { first, second };

// Fetches memory a little at a time: line by line of a row, of all planes, then of the next rows. Rows of
// many planes in turn lie farther apart than those of one, so that more of the memory's parts are at work.
class Fetching {
  public:
    // All of it in about so many steps.
    Fetching(const Ahead& ahead, int steps)
        : at_(ahead.first),
          lines_(ahead.lines),
          planes_(ahead.planes),
          to_plane_(ahead.plane_stride - ahead.lines * cache_line),
          to_row_(ahead.row_stride - ahead.planes * ahead.plane_stride),
          each_(steps > 0 ? (ahead.count() + steps - 1) / steps : 0),
          left_(ahead.count()) {}

    template <Into cache = Into::first>
    HWY_INLINE void step() {
        for (int n = 0; n < each_ && left_ > 0; ++n, --left_) {
            constexpr int locality = cache == Into::first ? 3 : 2;
            __builtin_prefetch(at_, 0, locality);
            at_ += cache_line;
            if (++line_ == lines_) {
                line_ = 0;
                at_ += to_plane_;
                if (++plane_ == planes_) {
                    plane_ = 0;
                    at_ += to_row_;
                }
            }
        }
    }

  private:
    const char* at_;
    int lines_, planes_;
    std::ptrdiff_t to_plane_, to_row_;  // from behind a plane's lines, and from behind the last plane
    int each_, left_;
    int line_ = 0, plane_ = 0;
};

}  // namespace shearwater::shear
