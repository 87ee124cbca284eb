#pragma once
// A rectangle of intermediate pixels that one thread renders through the whole sub-volume, front to back.
// Here all pixels are turned as FacePlan says: rows run along the fast axis.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/image/image.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"
#include "renderer/shear/face_plan.h"
#include "renderer/shear/kernel.h"
#include "renderer/shear/micro_layer.h"
#include "renderer/shear/tile_voxels.h"

namespace shearwater::shear {

// Which bricks some ray has met, as BrickVolume::bricks() counts them.
using BricksMet = std::vector<std::atomic<std::uint8_t>>;

// Voxels [lo, hi) along an axis, and what is on the sub-volume's side of an end of it where that is open.
struct OpenRun {
    double lo, hi;
    bool open_lo, open_hi;
};

template <class Code>
class Tile {
  public:
    static constexpr int width = widest_tile;
    static constexpr int height = tallest_tile;  // at most
    // How high tiles of a face had best be. Where lines of the cache are turned, which lie across many
    // slices, a tile needs more of them than its own as rays move on sideways: the fewer, the higher it is.
    // Where there is little to be seen, most of the work is done once for every tile and layer.
    static int rows_of(const BrickVolume& volume, const FacePlan& plan, bool sparse) {
        constexpr int usual = 32, turned = 64;
        // No two tiles light a block of pixels, whichever way they lie.
        constexpr int block = image::LitBlocks::block;
        static_assert(turned < height && width % block == 0 && height % block == 0 && turned % block == 0 &&
                      usual % block == 0);
        const int axis = plan.face().axis;
        const bool turns = TileVoxels<Code>::turns(volume.level(plan.level()).best_for(axis), axis);
        return sparse ? height : turns ? turned : usual;
    }

    // All have to outlive it. The contents are those of the level's micro-bricks that may be seen; the
    // pieces, if there are, hold all of it that is not transparent.
    Tile(const BrickVolume& volume, const Classification& classification, std::span<const Content> contents,
         const SparsePieces<Code>* pieces, const FacePlan& plan, BricksMet& met);

    // Renders the pixels of a rectangle of at most width x height, from nothing. False if they have met
    // nothing.
    bool render(const view::Rect& rect);
    // Copies what was rendered, something, to where it lies in the face's window, and notes what is lit; rays
    // that are done as opaque. No other tile may have a part of a block of 16 pixels of a row.
    void store(image::Window& window);
    std::uint64_t samples() const { return samples_; }  // of all rectangles

  private:
    static constexpr int stride = width + ray_padding;
    using Plane = std::array<float, static_cast<std::size_t>(height) * stride>;
    struct Planes {
        alignas(64) Plane r, g, b, a;
        alignas(64) Plane steps;  // the length of a whole step, in the table's units
        alignas(64) std::array<Plane, Slab<Code>::max_slices> lengths;  // of a slab's slices with other ones
        alignas(64) Plane entries, exits;  // of segments that end where a ray comes into the cube or goes out
    };
    using Slices = std::span<const Slice<Code>>;
    struct Part {  // of some slices
        std::array<Slice<Code>, Slab<Code>::max_slices> slices;
        std::array<std::int64_t, Slab<Code>::max_slices> numbers;
        std::size_t count = 0;
    };
    // Where voxels are turned, what lies in a few rows of them is drawn before the next rows are turned, so
    // that the second cache holds both: a run of voxels along the slow axis, of as many planes as lie in a
    // line of the cache. Samples beyond the first run and the last are those runs'.
    struct Strip {
        OpenRun voxels;
        std::int64_t first, last;  // nodes that its samples lie between
        double distance;           // as micro_layer.h has it
    };
    class Segments;

    void render_slices_between(std::int64_t first, std::int64_t end);
    void render_by_strips();
    void find_strips(std::int64_t first, std::int64_t end);
    void begin_rays();
    std::int64_t cell_of(std::int64_t k) const;
    template <std::int64_t edge>
    std::int64_t layer_of(std::int64_t k) const;
    Slice<Code> slice_of(std::int64_t k) const;
    std::array<MicroRun, 2> runs_of(const VoxelRegion& region, std::int64_t edge) const;
    void render_slices(Slices slices, std::span<const std::int64_t> numbers);
    void render_octants(Slices slices, std::span<const std::int64_t> numbers, const MicroLayer& layer,
                        int half, const MicroRun& fast, const MicroRun& slow);
    Part part_of(Slices slices, std::span<const std::int64_t> numbers, const Piece& piece,
                 const MicroRun& fast, const MicroRun& slow) const;
    Part part_of(Slices slices, std::span<const std::int64_t> numbers,
                 const typename SparsePieces<Code>::Copied& copied, const VoxelRegion& nodes) const;
    view::PixelRange rows_within(const Slice<Code>& slice, const OpenRun& voxels) const;
    void add_within(const OpenRun& fast, const OpenRun& slow, const Slice<Code>& slice, std::int64_t number,
                    Part& part) const;
    void render_sparse(Slices slices, std::span<const std::int64_t> numbers);
    bool is_seen(const Piece& piece, std::int64_t half_layer) const;
    void find_seen(std::int64_t half_layer, const std::array<MicroRun, 2>& octants);
    void fetch(const typename SparsePieces<Code>::Copied& copied, const VoxelRegion& nodes) const;
    bool is_in_one_brick(const VoxelRegion& region) const;
    bool composite(Slices slices, std::span<const std::int64_t> numbers, Slab<Code>& slab);
    void render_part(Slices slices, std::span<const std::int64_t> numbers, Visit visit, bool whole);
    void render_segments(Slices slices, std::span<const std::int64_t> numbers, Visit visit, bool whole);
    Slab<Code> slab_of(Slices slices, std::span<const std::int64_t> numbers, const VoxelRegion& region,
                       Visit visit, bool whole);
    Slab<Code> slab_at(Slices slices, std::span<const std::int64_t> numbers, const VoxelRegion& region,
                       Visit visit, const VoxelPlace<Code>& place) const;
    VoxelRegion nodes_of(const volume::Box& box) const;
    VoxelRegion region_of(Slices slices, std::span<const std::int64_t> numbers,
                          const VoxelRegion& within) const;
    VoxelRegion region_of(const MicroRun& fast, const MicroRun& slow,
                          std::span<const std::int64_t> numbers) const;
    VoxelRegion between_planes(std::int64_t lo, std::int64_t hi) const;
    std::span<const VoxelRegion> turned_with(const VoxelRegion& region);
    VoxelRegion behind(const VoxelRegion& region) const;
    void note_met(const VoxelRegion& region);
    const float* lengths_on(std::int64_t k, const view::Rect& pixels, std::size_t n);
    void copy_steps(const view::Rect& pixels, Plane& to) const;
    view::Rect in_face(const view::Rect& pixels) const {
        return {pixels.x0 + rect_.x0, pixels.y0 + rect_.y0, pixels.x1 + rect_.x0, pixels.y1 + rect_.y0};
    }
    RayLengths lengths_in(Plane& plane) const {
        return {.steps = planes_->steps.data(),
                .lengths = plane.data(),
                .stride = stride,
                .x0 = rect_.x0,
                .y0 = rect_.y0};
    }
    void store_row(int j, const view::Rgb* one_hue, image::Window& window, int x0, int y);
    void narrow_live();
    bool any_live(Slices slices) const;
    Rays rays();
    std::size_t slot(int i, int j) const {
        return static_cast<std::size_t>((j - rect_.y0) * stride + i - rect_.x0);
    }

    const CodeGrid& bricks_;
    const CodeVolume& codes_;  // of the level that is drawn
    const Classification& classification_;
    std::span<const Content> contents_;
    const SparsePieces<Code>* const pieces_;
    const bool some_hidden_;    // of what the pieces have
    const volume::Box& nodes_;  // of the codes, that samples may lie between
    const FacePlan& plan_;
    BricksMet& met_;
    TileVoxels<Code> voxels_;
    view::Rect rect_;
    bool begun_ = false;               // whether some ray may have met something
    view::Rect live_;                  // about the rays that are not done, counted from the tile's first
    std::vector<Strip> strips_;        // of the planes that are drawn, front to back
    const Strip* strip_ = nullptr;     // that is drawn, if there are
    std::vector<VoxelRegion> turned_;  // of it, kept for its memory
    bool between_nodes_ = true, faint_ = false;
    std::uint64_t samples_ = 0;
    std::unique_ptr<Planes> planes_;
    // Where a plane of lengths has others than whole steps: all else of it is as long as they are, if it is
    // used.
    using Rims = std::array<view::Rect, 4>;
    std::array<std::optional<Rims>, Slab<Code>::max_slices> rims_;
    // Kept from layer to layer for their memory.
    std::vector<std::int64_t> octant_rows_;
    std::vector<OctantRun> runs_, next_runs_;
    std::vector<Piece> octant_pieces_;
    struct Seen {
        std::array<double, 3> distance;  // of its column, its rows and itself
        const typename SparsePieces<Code>::Copied* copied;
        VoxelRegion nodes;  // that it has
    };
    std::vector<Seen> seen_;
};

extern template class Tile<std::uint8_t>;
extern template class Tile<std::uint16_t>;

}  // namespace shearwater::shear
