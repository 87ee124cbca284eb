#include "common/image/canvas.h"

#include "common/base/memory.h"
#include "common/image/over_windows.h"

namespace shearwater::image {

void Canvas::begin(const view::Factorisation& factorisation) {
    faces_.resize(factorisation.faces.size());
    for (std::size_t n = 0; n < faces_.size(); ++n) {
        const view::Face& face = factorisation.faces[n];
        faces_[n].face = static_cast<int>(n);
        faces_[n].rect = {0, 0, face.width, face.height};
        faces_[n].pixels.reshape(face.width, face.height);
        // The warp goes through it in any direction.
        base::prefer_huge_pages(std::as_writable_bytes(faces_[n].pixels.pixels()));
    }
}

void Canvas::lay(const view::Band& band, std::span<const SpanWindow> windows) {
    lay_front_to_back(windows, band.rect, faces_[static_cast<std::size_t>(band.face)]);
}

}  // namespace shearwater::image
