#include "deploy/bench/culling_optimal.h"

#include <algorithm>

namespace shearwater::bench {

namespace {

using culling::BlockGrid;
using culling::BlockSet;
using view::Face;
using view::Factorisation;
using volume::Box;

// Narrows [t0, t1], of a segment from `from` to `to`, to where it is from lo to hi.
void clip(double from, double to, double lo, double hi, double& t0, double& t1) {
    if (from == to) {
        if (from < lo || from > hi) {
            t1 = t0 - 1;
        }
        return;
    }
    const auto [enter, leave] = std::minmax({(lo - from) / (to - from), (hi - from) / (to - from)});
    t0 = std::max(t0, enter);
    t1 = std::min(t1, leave);
}

// The rays of a face between two planes.
class Between {
  public:
    Between(const Factorisation& f, const Face& face, double near, double far)
        : u_(static_cast<std::size_t>(face.u_axis())),
          v_(static_cast<std::size_t>(face.v_axis())),
          near_(f.slice_map(face, near)),
          far_(f.slice_map(face, far)) {}

    bool meets(int i, int j, const Box& box) const {
        double t0 = 0, t1 = 1;
        clip(near_.u_offset + near_.u_scale * i, far_.u_offset + far_.u_scale * i,
             static_cast<double>(box.lo[u_]), static_cast<double>(box.hi[u_]), t0, t1);
        clip(near_.v_offset + near_.v_scale * j, far_.v_offset + far_.v_scale * j,
             static_cast<double>(box.lo[v_]), static_cast<double>(box.hi[v_]), t0, t1);
        return t0 <= t1;
    }

  private:
    std::size_t u_, v_;
    view::SliceMap near_, far_;
};

// One face's image, laid slab by slab.
class Sequential {
  public:
    Sequential(const shear::BrickVolume& volume, const shear::Classification& classification,
               const Factorisation& factorisation, int face, const BlockGrid& grid, const BlockSet& blocks,
               double threshold, base::Workers& workers)
        : volume_(volume),
          classification_(classification),
          f_(factorisation),
          grid_(grid),
          blocks_(blocks),
          threshold_(static_cast<float>(threshold)),
          workers_(workers) {
        f_.faces = {factorisation.faces[static_cast<std::size_t>(face)]};
        opacity_ = image::Image<float>(this->face().width, this->face().height);
    }

    void run(BlockSet& visible) {
        const auto w = static_cast<std::size_t>(face().axis);
        const std::int64_t count = grid_.counts()[w];
        for (std::int64_t n = 0; n < count; ++n) {
            Box slab{{}, grid_.counts()};
            slab.lo[w] = face().sign > 0 ? n : count - 1 - n;
            slab.hi[w] = slab.lo[w] + 1;
            lay(slab, visible);
        }
    }

  private:
    const Face& face() const { return f_.faces[0]; }

    void lay(const Box& slab, BlockSet& visible) {
        culling::VisibleBlocks here{grid_, BlockSet(grid_.size())};
        std::vector<std::size_t> blocks;
        volume::Index3 at;
        for (at[2] = slab.lo[2]; at[2] < slab.hi[2]; ++at[2]) {
            for (at[1] = slab.lo[1]; at[1] < slab.hi[1]; ++at[1]) {
                for (at[0] = slab.lo[0]; at[0] < slab.hi[0]; ++at[0]) {
                    if (const std::size_t block = grid_.index(at); blocks_.contains(block)) {
                        here.blocks.bytes()[block] = 1;
                        blocks.push_back(block);
                    }
                }
            }
        }
        workers_.for_each(static_cast<std::int64_t>(blocks.size()), [&](std::int64_t n) {
            const std::size_t block = blocks[static_cast<std::size_t>(n)];
            if (visible.bytes()[block] == 0 && seen(grid_.box(grid_.at(block)))) {
                visible.bytes()[block] = 1;
            }
        });
        const auto drawn = shear::render(volume_, classification_, f_, workers_, {.visible = &here});
        for (const image::Window& window : drawn.windows) {
            for (int y = 0; y < window.rect.height(); ++y) {
                const auto front = opacity_.row(window.rect.y0 + y)
                                       .subspan(static_cast<std::size_t>(window.rect.x0),
                                                static_cast<std::size_t>(window.rect.width()));
                const auto back = window.pixels.row(y);
                for (std::size_t x = 0; x < front.size(); ++x) {
                    front[x] += (1 - front[x]) * back[x].a;
                }
            }
        }
    }

    // Whether a ray through a box has light left.
    bool seen(const Box& box) const {
        const auto w = static_cast<std::size_t>(face().axis);
        double near = static_cast<double>(face().sign > 0 ? box.lo[w] : box.hi[w]);
        const double far = static_cast<double>(face().sign > 0 ? box.hi[w] : box.lo[w]);
        if (f_.projection == view::Projection::perspective) {
            const double eye = f_.eye[face().axis];
            if ((far - eye) * face().sign <= 0) {
                return false;  // behind the eye
            }
            near = face().sign > 0 ? std::max(near, eye) : std::min(near, eye);
        }
        const Between rays(f_, face(), near, far);
        const view::Rect window =
            view::intersection(view::window_of(f_, face(), box), {0, 0, face().width, face().height});
        for (int j = window.y0; j < window.y1; ++j) {
            for (int i = window.x0; i < window.x1; ++i) {
                if (opacity_.at(i, j) < threshold_ && rays.meets(i, j, box)) {
                    return true;
                }
            }
        }
        return false;
    }

    const shear::BrickVolume& volume_;
    const shear::Classification& classification_;
    Factorisation f_;  // of the face alone
    const BlockGrid& grid_;
    const BlockSet& blocks_;
    float threshold_;
    base::Workers& workers_;
    image::Image<float> opacity_;
};

}  // namespace

BlockSet optimal_blocks(const shear::BrickVolume& volume, const shear::Classification& classification,
                        const Factorisation& factorisation, const BlockGrid& grid, const BlockSet& blocks,
                        double threshold, base::Workers& workers) {
    BlockSet visible(grid.size());
    for (std::size_t face = 0; face < factorisation.faces.size(); ++face) {
        Sequential(volume, classification, factorisation, static_cast<int>(face), grid, blocks, threshold,
                   workers)
            .run(visible);
    }
    return visible;
}

}  // namespace shearwater::bench
