#pragma once
// From the intermediate images of a view to its picture: the last stage, done once, at the head.

#include <memory>
#include <vector>

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/view/bands.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"

namespace shearwater::image {

// `windows`: at most one per face of the factorisation. Each output pixel takes the face of its ray's
// principal axis, resamples it, is put over the background and rounded to 8 bits; alpha is 255.
Image<Rgba8> warp(const view::Factorisation& factorisation, std::span<const Window> windows,
                  const view::Camera& camera, const view::ImageSize& size, const view::Rgb& background,
                  base::Workers& workers);

// The same before background and rounding: premultiplied, with alpha.
Image<RgbaF> warp_float(const view::Factorisation& factorisation, std::span<const Window> windows,
                        const view::Camera& camera, const view::ImageSize& size, base::Workers& workers);

// The same picture from windows that are filled band by band: each tile of it is made once the bands are
// there that its rays go through.
//
//      face                       picture
//   +-----------+               +--+--+--+--+
//   |  band 0   |   filled      |##|##|##|##|   made
//   +-----------+               +--+--+--+--+
//   |  band 1   |   filled      |##|##|##|  |
//   +-----------+               +--+--+--+--+
//   |  band 2   |               |  |  |  |  |
//   +-----------+               +--+--+--+--+
class Warp {
  public:
    // Views its arguments. Windows are as large as their faces, or cover parts of the bands.
    Warp(const view::Factorisation& factorisation, std::span<const Window> windows,
         std::span<const view::Band> bands, const view::Camera& camera, const view::ImageSize& size,
         const view::Rgb& background);
    ~Warp();
    Warp(const Warp&) = delete;
    Warp& operator=(const Warp&) = delete;

    // So many rows of the picture are a stripe, or fewer in its last.
    static constexpr int stripe_rows = 128;

    // The first `filled` bands, at least as many as before, are filled and stay as they are. Gives the
    // stripes that are whole with this, each once.
    std::vector<std::size_t> advance(std::size_t filled, base::Workers& workers);
    // Of which the rows of whole stripes have their pixels.
    const Image<Rgba8>& picture() const;
    bool done() const;
    // Once it is done.
    Image<Rgba8> take();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace shearwater::image
