#pragma once
// A rectangle of intermediate pixels that one thread renders through the whole sub-volume, front to back.
// Here all pixels are turned as FacePlan says: rows run along the fast axis.

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/image/image.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"
#include "renderer/shear/face_plan.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/oriented_brick.h"

namespace shearwater::shear {

// Which bricks some ray has met, by their place in BrickVolume::bricks().
using BricksMet = std::vector<std::atomic<std::uint8_t>>;

template <class Code>
class Tile {
  public:
    static constexpr int width = widest_tile;
    static constexpr int height = tallest_tile;

    Tile(const BrickVolume& volume, std::span<const Code> codes, const Classification& classification,
         const FacePlan& plan, BricksMet& met);

    // Renders the pixels of a rectangle of at most width x height, from nothing.
    void render(const view::Rect& rect);
    // Copies what was rendered to where it lies in the face's window.
    void store(image::Window& window) const;
    std::uint64_t samples() const { return samples_; }  // of all rectangles

  private:
    static constexpr int stride = width + ray_padding;
    using Plane = std::array<float, static_cast<std::size_t>(height) * stride>;
    struct Planes {
        alignas(64) Plane r, g, b, a;
        alignas(64) Plane steps;  // the length of a whole step, in OpacityTable::depth_unit()
        alignas(64) std::array<Plane, Slab<Code>::max_slices> lengths;  // of slices with shorter ones
    };
    // A slice, and the pixels of the tile whose samples on it a brick owns.
    struct SlicePixels {
        std::int64_t k;
        view::Rect pixels;
    };

    void render_layer(std::int64_t layer);
    VoxelRanges needed_of(const Brick& brick, std::uint64_t opaque, const view::SliceRange& slices) const;
    void render_brick(const Brick& brick, const view::SliceRange& slices, std::int64_t column,
                      std::int64_t row);
    void render_slices(const OrientedBrick<Code>& brick, std::span<const SlicePixels> slices);
    Slice<Code> slice_of(const OrientedBrick<Code>& brick, const SlicePixels& slice) const;
    void composite(Slab<Code>& slab, std::span<const SlicePixels> slices);
    Rays rays();
    const float* lengths_on(std::int64_t k, const view::Rect& pixels, Plane& spare);
    bool opaque() const;
    std::vector<std::int64_t> met_by(const std::vector<std::int64_t>& places, const view::SliceRange& slices,
                                     int lo, int hi,
                                     const view::PixelRange& (FacePlan::*pixels)(std::int64_t, std::int64_t)
                                         const) const;
    std::size_t slot(int i, int j) const {
        return static_cast<std::size_t>((j - rect_.y0) * stride + i - rect_.x0);
    }

    const BrickVolume& volume_;
    std::span<const Code> codes_;
    const Classification& classification_;
    const FacePlan& plan_;
    BricksMet& met_;
    view::Rect rect_;
    bool between_nodes_ = true;
    std::uint64_t samples_ = 0;
    std::unique_ptr<Planes> planes_;
    std::vector<Code> scratch_;  // a turned brick
};

extern template class Tile<std::uint8_t>;
extern template class Tile<std::uint16_t>;

}  // namespace shearwater::shear
