#pragma once
// Memory on its way into the caches before it is wanted.

#include <hwy/base.h>

#include "renderer/shear/kernel.h"

namespace shearwater::shear {

// Which cache: the second takes more lines at once than the first waits for, and keeps them longer.
enum class Into { first, second };

// Fetches memory a little at a time, line by line.
class Fetching {
  public:
    // All of it in about so many steps.
    Fetching(const Ahead& ahead, int steps)
        : ahead_(ahead), each_(steps > 0 ? (ahead.count() + steps - 1) / steps : 0), left_(ahead.count()) {}

    template <Into cache = Into::first>
    HWY_INLINE void step() {
        for (int n = 0; n < each_ && left_ > 0; ++n, --left_) {
            constexpr int locality = cache == Into::first ? 3 : 2;
            __builtin_prefetch(
                ahead_.first + plane_ * ahead_.plane_stride + row_ * ahead_.row_stride + line_ * cache_line,
                0, locality);
            if (++line_ == ahead_.lines) {
                line_ = 0;
                if (++row_ == ahead_.rows) {
                    row_ = 0;
                    ++plane_;
                }
            }
        }
    }

  private:
    Ahead ahead_;
    int each_, left_;
    int line_ = 0, row_ = 0, plane_ = 0;
};

}  // namespace shearwater::shear
