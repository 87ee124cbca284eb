#pragma once
// The intermediate images of a frame as its head gathers them, band by band.

#include <span>
#include <vector>

#include "common/image/image.h"
#include "common/image/window_spans.h"
#include "common/view/bands.h"

namespace shearwater::image {

class Canvas {
  public:
    // Begins a frame: a window for every face, each as large as its face. Memory stays from frame to frame,
    // and is taken up as bands are laid.
    void begin(const view::Factorisation& factorisation);

    // A band's windows, front to back, in its place.
    void lay(const view::Band& band, std::span<const SpanWindow> windows);

    // To be warped once all bands are laid: what is not yet has any colour.
    std::span<const Window> windows() const { return faces_; }

  private:
    std::vector<Window> faces_;
};

}  // namespace shearwater::image
