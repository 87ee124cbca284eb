#pragma once
// How fast the link carries pictures, and what follows from it: how to code them, and how large they may be
// while the view moves.
//
// A link's speed is read from single pictures: the bytes of one, over the time from its first to its last.
// That is the slowest hop's speed, whatever else goes on; a picture of a few packets says nothing. What a
// picture costs by either coding is its bytes at that speed and the server's time for coding it.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "common/view/camera.h"

namespace shearwater::model {

class LinkGauge {
  public:
    using Seconds = std::chrono::duration<double>;

    // Pictures of fewer bytes say nothing of the speed.
    static constexpr std::size_t enough_to_tell = std::size_t{1} << 15;
    // A picture that takes no longer than this on the link need not be made smaller by coding.
    static constexpr Seconds quick{0.006};
    // The link's part of the time from one frame to the next, while the view moves.
    static constexpr double share = 0.8;
    // Pictures are never less than this share of the size, each way.
    static constexpr double least_scale = 1.0 / 8;

    struct Carried {
        std::size_t bytes = 0;
        view::ImageSize size;
        bool deflated = false;
        Seconds coding{};    // at the server
        Seconds arriving{};  // from the first byte to the last
    };
    void count(const Carried& picture);

    // Bytes a second, if anything is known.
    std::optional<double> speed() const;
    // Whether to ask for deflated pictures of this size.
    bool wants_deflate(const view::ImageSize& size);
    // The size to ask for, in proportion and at most `full`, so that frames come so often.
    view::ImageSize size_at_rate(const view::ImageSize& full, double frames_per_second);

  private:
    // A coding's bytes and seconds a pixel, lately.
    struct Coding {
        double bytes = 0, seconds = 0;
    };
    struct Passage {
        std::size_t bytes;
        Seconds arriving;
    };

    const std::optional<Coding>& coding(bool deflated) const { return codings_[deflated ? 1 : 0]; }
    Seconds cost(const Coding& coding, double pixels) const;

    std::deque<Passage> passages_;
    std::array<std::optional<Coding>, 2> codings_;
    bool deflate_ = false;
    double scale_ = 1;
};

}  // namespace shearwater::model
