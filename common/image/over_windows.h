#pragma once
// Over for whole windows: those of a frame, given front to back, become at most one a face, each with the
// bounding rectangle of its parts. Windows of different faces never mix.

#include <span>
#include <vector>

#include "common/base/buffer.h"
#include "common/image/image.h"
#include "common/image/window_spans.h"

namespace shearwater::image {

std::vector<Window> merge_front_to_back(std::span<const Window> windows);
std::vector<Window> merge_front_to_back(std::span<const SpanWindow> windows);

// Into a part of a window of the same face: every pixel of the part is written, those that nothing covers as
// transparent. The windows lie in the part.
void lay_front_to_back(std::span<const SpanWindow> windows, const Rect& part, Window& onto);

// The same straight into the form that windows travel in: `windows` view parts of `bytes`, one behind the
// other. Stretches that one window alone covers are passed on as they came.
struct CodedWindows {
    std::vector<SpanWindow> windows;
    base::Buffer bytes;
};
CodedWindows merge_coded(std::span<const SpanWindow> windows);
CodedWindows encode(std::span<const Window> windows);

}  // namespace shearwater::image
