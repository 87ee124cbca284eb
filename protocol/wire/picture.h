#pragma once
// Finished pictures and the frames they travel to a client in.

#include <vector>

#include "common/base/buffer.h"
#include "common/image/image.h"
#include "common/view/camera.h"
#include "protocol/wire/header.h"
#include "protocol/wire/message.h"

namespace shearwater::wire {

// Puts a picture of so many pixels, coded in run lengths, behind a frame, whose size and encoding it fills
// in: deflated where that is asked for and pays. Of two eyes it is the left one's picture, of that size each,
// and below it the right one's.
Message frame_message(pb::Frame frame, const view::ImageSize& size, int eyes, base::Buffer coded,
                      bool deflate);

// The pictures of a Frame, of one eye or of two: as many and of the size that were asked for. Memory goes by
// that, not by the sender's word.
Parsed<std::vector<image::Image<image::Rgba8>>> pictures_from(const Message& message,
                                                              const view::ImageSize& asked, int eyes);
// The picture where one was asked for.
Parsed<image::Image<image::Rgba8>> picture_from(const Message& message, const view::ImageSize& asked);

}  // namespace shearwater::wire
