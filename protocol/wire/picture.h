#pragma once
// Finished pictures and the frames they travel to a client in.

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/view/camera.h"
#include "protocol/wire/header.h"
#include "protocol/wire/message.h"

namespace shearwater::wire {

// Puts the picture behind a frame, whose size and encoding it fills in: run lengths, and deflate where
// that was asked for and pays.
Message frame_message(pb::Frame frame, const image::Image<image::Rgba8>& picture, bool deflate,
                      base::Workers& workers);

// The picture of a Frame, which must be of the size that was asked for: memory goes by that size, not
// by the sender's word.
Parsed<image::Image<image::Rgba8>> picture_from(const Message& message, const view::ImageSize& asked);

}  // namespace shearwater::wire
