#include "common/image/layer.h"

#include <algorithm>
#include <cmath>

namespace shearwater::image {

namespace {

Range common(const Range& a, const Range& b) {
    return {std::max(a.first, b.first), std::min(a.end, b.end)};
}

Range bounding(const Range& a, const Range& b) {
    if (a.empty() || b.empty()) {
        return a.empty() ? b : a;
    }
    return {std::min(a.first, b.first), std::max(a.end, b.end)};
}

}  // namespace

Layer::Layer(const view::Factorisation& factorisation, const Window& window)
    : window_(&window),
      face_(&factorisation.faces[static_cast<std::size_t>(window.face)]),
      silhouette_(factorisation, *face_),
      own_lit_blocks_(std::max(window.rect.width(), 0), std::max(window.rect.height(), 0)),
      lit_pixels_(static_cast<std::size_t>(std::max(window.rect.height(), 0))),
      rows_(static_cast<std::size_t>(face_->height) + 3) {}

void Layer::take(const Rect& part, base::Workers& workers) {
    constexpr int rows_at_a_time = 16;
    const Rect& rect = window_->rect;
    const Rect filled = view::intersection(part, rect);
    if (filled.empty()) {
        return;
    }
    workers.for_each((filled.height() + rows_at_a_time - 1) / rows_at_a_time, [&](std::int64_t n) {
        const int begin = filled.y0 + static_cast<int>(n) * rows_at_a_time;
        for (int j = begin; j < std::min(begin + rows_at_a_time, filled.y1); ++j) {
            const Range range = lit_of_row(j - rect.y0, {filled.x0 - rect.x0, filled.x1 - rect.x0});
            Range& lit = lit_pixels_[static_cast<std::size_t>(j - rect.y0)];
            lit = bounding(lit, {range.first + rect.x0, range.end + rect.x0});
        }
    });
    for (int j = std::max(filled.y0 - 2, -1); j < std::min(filled.y1 + 1, face_->height); ++j) {
        CellRow& row = rows_[static_cast<std::size_t>(j + rows_above)];
        row = row_of_cells(j);
        lit_ = view::bounding(lit_, {row.lit.first, j, row.lit.end, j + 1});
    }
}

// Of the window's pixels.
Range Layer::lit_of_row(int y, const Range& filled) {
    if (!window_->lit.empty()) {
        return window_->lit.lit_of(y, filled);
    }
    return own_lit_blocks_.note(
        filled.first, y,
        window_->pixels.row(y).subspan(static_cast<std::size_t>(filled.first),
                                       static_cast<std::size_t>(filled.end - filled.first)));
}

CellRow Layer::row_of_cells(int j) const {
    const Rect& rect = window_->rect;
    Range lit;
    for (int y = std::max(j - 1, rect.y0); y < std::min(j + 3, rect.y1); ++y) {
        lit = bounding(lit, lit_pixels_[static_cast<std::size_t>(y - rect.y0)]);
    }
    if (lit.empty()) {
        return {};
    }
    lit = common({lit.first - 2, lit.end + 1}, {-1, face_->width});
    if (j - 1 < rect.y0 || j + 3 > rect.y1) {
        return {lit, {}};
    }
    // The outline is convex: it holds the 16 pixels if it holds their corners.
    const Stretch& top = silhouette_.pixel_row(j - 1);
    const Stretch& bottom = silhouette_.pixel_row(j + 2);
    const auto to_pixel = [&](double i) { return static_cast<int>(std::clamp(i, -4.0, face_->width + 4.0)); };
    const int first = to_pixel(std::ceil(std::max(top.lo, bottom.lo)));
    const int last = to_pixel(std::floor(std::min(top.hi, bottom.hi)));
    const Range pixels = common({first, last + 1}, {rect.x0, rect.x1});
    return {lit, common({pixels.first + 1, pixels.end - 2}, lit)};
}

}  // namespace shearwater::image
