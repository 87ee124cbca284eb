#pragma once
// A square of intermediate pixels that one thread renders through the whole sub-volume, front to back.

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/image.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/face_plan.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/opacity_table.h"

namespace shearwater::shear {

// What a frame knows of every brick, by its place in BrickVolume::bricks().
struct BrickState {
    std::vector<std::uint8_t> visible;                // has opacity under the transfer function
    std::vector<std::atomic<std::uint8_t>> rendered;  // some ray has met it
};

template <class Code>
class Tile {
  public:
    static constexpr int side = 32;

    // `rect` is at most side x side pixels of the face.
    Tile(const BrickVolume& volume, std::span<const Code> codes, const FacePlan& plan,
         const OpacityTable& table, BrickState& state, const view::Rect& rect);

    void render();
    // Copies what was rendered to where it lies in the face's window.
    void store(image::Window& window) const;
    std::uint64_t samples() const { return samples_; }

  private:
    struct Slab;  // one slice of one brick
    void render_layer(std::int64_t layer);
    void render_brick(const volume::Index3& place, const view::SliceRange& slices, std::int64_t column,
                      std::int64_t row);
    void render_slice(const Brick& brick, std::int64_t k, const view::Rect& pixels);
    void render_row(const Slab& slab, int j, int i0, int i1);
    bool opaque() const;
    std::vector<std::int64_t> met(const std::vector<std::int64_t>& places, const view::SliceRange& slices,
                                  int lo, int hi,
                                  const view::PixelRange& (FacePlan::*pixels)(std::int64_t, std::int64_t)
                                      const) const;
    std::size_t slot(int i, int j) const {
        return static_cast<std::size_t>((j - rect_.y0) * side + i - rect_.x0);
    }

    const BrickVolume& volume_;
    std::span<const Code> codes_;
    const FacePlan& plan_;
    const OpacityTable& table_;
    BrickState& state_;
    view::Rect rect_;
    std::uint64_t samples_ = 0;
    using Plane = std::array<float, static_cast<std::size_t>(side) * side>;
    Plane r_{}, g_{}, b_{}, a_{};
    Plane steps_;  // world length between two slices
};

extern template class Tile<std::uint8_t>;
extern template class Tile<std::uint16_t>;

}  // namespace shearwater::shear
