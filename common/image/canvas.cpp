#include "common/image/canvas.h"

#include "common/image/over_windows.h"

namespace shearwater::image {

Canvas::Canvas(const view::Factorisation& factorisation) {
    for (const view::Face& face : factorisation.faces) {
        faces_.push_back({.face = static_cast<int>(faces_.size()),
                          .rect = {0, 0, face.width, face.height},
                          .pixels = Image<RgbaF>(face.width, face.height, Unfilled())});
    }
}

void Canvas::lay(const view::Band& band, std::span<const SpanWindow> windows) {
    lay_front_to_back(windows, band.rect, faces_[static_cast<std::size_t>(band.face)]);
}

}  // namespace shearwater::image
