#pragma once
// Finished pictures and the frames they travel to a client in.

#include "common/base/buffer.h"
#include "common/image/image.h"
#include "common/view/camera.h"
#include "protocol/wire/header.h"
#include "protocol/wire/message.h"

namespace shearwater::wire {

// Puts a picture of so many pixels, coded in run lengths, behind a frame, whose size and encoding it fills
// in: deflated where that is asked for and pays.
Message frame_message(pb::Frame frame, const view::ImageSize& size, base::Buffer coded, bool deflate);

// The picture of a Frame, which must be of the size that was asked for: memory goes by that size, not
// by the sender's word.
Parsed<image::Image<image::Rgba8>> picture_from(const Message& message, const view::ImageSize& asked);

}  // namespace shearwater::wire
