#pragma once
// zlib's inflating stream for gzip, ended when it goes.

#include <zlib.h>

namespace shearwater::fits {

class Inflater {
  public:
    Inflater() {
        constexpr int window_of_gzip = 15 + 16;
        ready_ = inflateInit2(&stream, window_of_gzip) == Z_OK;
    }
    ~Inflater() {
        if (ready_) {
            inflateEnd(&stream);
        }
    }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    bool ready() const { return ready_; }

    z_stream stream{};

  private:
    bool ready_ = false;
};

}  // namespace shearwater::fits
