#pragma once
// A face's intermediate image as the warp reads it. A cell is the square between four pixels, named by the
// first of them, (floor(i), floor(j)); what lies in it is resampled from the 4 x 4 pixels about it:
//
//     i-1   i   i+1  i+2
//   j-1  .   .   .   .
//   j    .   +---+   .        cell (i, j)
//   j+1  .   +---+   .
//   j+2  .   .   .   .

#include <algorithm>
#include <cstddef>
#include <vector>

#include "common/base/workers.h"
#include "common/image/image.h"
#include "common/image/lit_blocks.h"
#include "common/image/silhouette.h"

namespace shearwater::image {

// What a row of cells needs: nothing outside `lit`, where all 16 pixels are transparent; in `whole`, a part
// of it, plain interpolation, as the window has all 16 and the cube's outline holds them.
struct CellRow {
    Range lit, whole;
};

class Layer {
  public:
    // Of a window that is yet to be filled: so far nothing of it is lit.
    Layer(const view::Factorisation& factorisation, const Window& window);
    Layer(const view::Factorisation& factorisation, const Window& window, base::Workers& workers)
        : Layer(factorisation, window) {
        take(window.rect, workers);
    }

    // A part of the window, in the face's pixels, has been filled, and stays as it is. From then on a cell is
    // as it will be when all of the window is, if its 16 pixels, as far as the window has them, are in such
    // parts.
    void take(const Rect& part, base::Workers& workers);

    const view::Face& face() const { return *face_; }
    const Window& window() const { return *window_; }
    const Silhouette& silhouette() const { return silhouette_; }

    // The cells that any place in the face is in are from -1 to the face's size less 1. There is one more row
    // of them, empty, above and below.
    const CellRow& cell_row(int j) const { return rows_[static_cast<std::size_t>(j + rows_above)]; }
    // Holds all lit cells.
    const Rect& lit() const { return lit_; }
    // False only if the cells from one corner to another, inclusive, have nothing.
    bool any_lit(int i0, int j0, int i1, int j1) const {
        const Rect& rect = window_->rect;
        return lit_blocks().any({std::min(i0, i1) - 1 - rect.x0, std::min(j0, j1) - 1 - rect.y0,
                                 std::max(i0, i1) + 3 - rect.x0, std::max(j0, j1) + 3 - rect.y0});
    }
    static constexpr int rows_above = 2;

  private:
    Range lit_of_row(int y, const Range& filled);
    CellRow row_of_cells(int j) const;
    const LitBlocks& lit_blocks() const { return window_->lit.empty() ? own_lit_blocks_ : window_->lit; }

    const Window* window_;
    const view::Face* face_;
    Silhouette silhouette_;
    LitBlocks own_lit_blocks_;       // where the window has none
    std::vector<Range> lit_pixels_;  // of each of the window's rows, in the face's pixels
    std::vector<CellRow> rows_;
    Rect lit_;
};

}  // namespace shearwater::image
