#include "common/image/warp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/image/finish.h"
#include "common/image/layer.h"
#include "common/image/resample_span.h"

namespace shearwater::image {

namespace {

using view::Face;
using view::Factorisation;
using view::Projection;
using view::Vec3;

// The faces' images, and which of them a point of the picture is in. Faces are numbered as the sides of the
// cube around the eye that the rays go through.
class Finder {
  public:
    Finder(const Factorisation& factorisation, std::span<const Window> windows, const view::Camera& camera,
           const view::ImageSize& size)
        : factorisation_(factorisation),
          rays_(in_voxel_space(view::rays_of(camera, size), factorisation.lattice)) {
        for (const Window& window : windows) {
            layers_[side_of(window.face)].emplace(factorisation, window);
        }
    }

    void take(const view::Band& band, base::Workers& workers) {
        if (auto& layer = layers_[side_of(band.face)]) {
            layer->take(band.rect, workers);
        }
    }

    std::size_t side_at(double px, double py) const {
        const Vec3 direction = perspective() ? rays_.direction_at(px, py) : factorisation_.direction;
        const int axis = principal_axis(direction);
        return side(axis, direction[axis] > 0);
    }

    // The end of the pixels [x, x1) of row y that are in the side of x. A side's rays are a convex cone, so
    // that a row goes through each in one stretch.
    int end_of_side(int x, int x1, int y) const {
        const std::size_t here = side_at(x + 0.5, y + 0.5);
        int last = x, end = x1;
        for (int at = end - 1; last + 1 < end; at = last + (end - last) / 2) {
            (side_at(at + 0.5, y + 0.5) == here ? last : end) = at;
            if (last == x1 - 1) {
                return x1;
            }
        }
        return end;
    }

    // Null where there is none, or nothing in it.
    const Layer* layer(std::size_t side) const {
        return layers_[side] && !layers_[side]->lit().empty() ? &*layers_[side] : nullptr;
    }

    // The part of a face that the picture's tile is resampled from, where that is one face: no rect, and face
    // -1, where none is there, and nothing at all where there may be several.
    std::optional<view::Band> source(const Rect& tile) const {
        const std::array<double, 2> px{tile.x0 + 0.5, tile.x1 - 0.5}, py{tile.y0 + 0.5, tile.y1 - 0.5};
        const std::size_t side = side_at(px[0], py[0]);
        for (const double y : py) {
            if (side_at(px[0], y) != side || side_at(px[1], y) != side) {
                return std::nullopt;
            }
        }
        const auto& layer = layers_[side];
        if (!layer) {
            return view::Band{-1, {}};
        }
        // A convex tile stays convex: it lies between its corners.
        const Face& face = layer->face();
        const auto pixel = [](double at, int size) {
            return static_cast<int>(std::clamp(at, -8.0, size + 8.0));
        };
        Rect cells;
        for (const double y : py) {
            for (const double x : px) {
                const Place at = track(*layer, y).at(x);
                const int i = pixel(std::floor(at.i), face.width), j = pixel(std::floor(at.j), face.height);
                cells = view::bounding(cells, {i, j, i + 1, j + 1});
            }
        }
        // The pixels about the cells, and one for the rounding.
        const Rect pixels{cells.x0 - 2, cells.y0 - 2, cells.x1 + 3, cells.y1 + 3};
        return view::Band{layer->window().face, view::intersection(pixels, {0, 0, face.width, face.height})};
    }

    // Of a row of points whose rays go through the layer's face.
    Track track(const Layer& layer, double py) const {
        const Face& face = layer.face();
        const int u = face.u_axis(), v = face.v_axis(), w = face.axis;
        if (perspective()) {
            const Vec3 start = rays_.direction_at(0, py);
            const Vec3& step = rays_.dir_x;
            return {(start[u] - face.origin.x * start[w]) / face.pitch.x,
                    (step[u] - face.origin.x * step[w]) / face.pitch.x,
                    (start[v] - face.origin.y * start[w]) / face.pitch.y,
                    (step[v] - face.origin.y * step[w]) / face.pitch.y,
                    start[w],
                    step[w]};
        }
        const Vec3 slope = factorisation_.direction / factorisation_.direction[w];
        const Vec3 start = rays_.origin_at(0, py) - slope * rays_.origin_at(0, py)[w];
        const Vec3 step = rays_.origin_x - slope * rays_.origin_x[w];
        return {(start[u] - face.origin.x) / face.pitch.x, step[u] / face.pitch.x,
                (start[v] - face.origin.y) / face.pitch.y, step[v] / face.pitch.y};
    }

  private:
    bool perspective() const { return factorisation_.projection == Projection::perspective; }

    std::size_t side_of(int face) const {
        const Face& of = factorisation_.faces[static_cast<std::size_t>(face)];
        return side(of.axis, of.sign > 0);
    }
    static std::size_t side(int axis, bool rising) {
        return static_cast<std::size_t>(2 * axis + (rising ? 1 : 0));
    }

    static int principal_axis(const Vec3& direction) {
        const Vec3 size = glm::abs(direction);
        return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    }

    const Factorisation& factorisation_;
    view::Rays rays_;
    std::array<std::optional<Layer>, Factorisation::max_faces> layers_;
};

// The picture's pixels from (x0, y) on into `row`, transparent before. `left` is room for a row's numbers.
void warp_row(const Finder& finder, int x0, int y, std::span<RgbaF> row, std::span<int> left) {
    const int x1 = x0 + static_cast<int>(row.size());
    for (int x = x0, end = x0; x < x1; x = end) {
        end = finder.end_of_side(x, x1, y);
        const Layer* const layer = finder.layer(finder.side_at(x + 0.5, y + 0.5));
        if (layer == nullptr) {
            continue;
        }
        const auto part = row.subspan(static_cast<std::size_t>(x - x0), static_cast<std::size_t>(end - x));
        const Track track = finder.track(*layer, y + 0.5);
        const std::size_t count = resample_span(*layer, track, x, part, left);
        for (const int n : left.first(count)) {
            part[static_cast<std::size_t>(n)] = resample(*layer, track.at(x + n + 0.5));
        }
    }
}

// What is made at a time: wide, for faces are read fastest along their rows.
std::vector<Rect> tiles_of(const view::ImageSize& size, int width) {
    constexpr int height = 4;
    static_assert(Warp::stripe_rows % height == 0);
    std::vector<Rect> tiles;
    for (int y = 0; y < size.height; y += height) {
        for (int x = 0; x < size.width; x += width) {
            tiles.push_back({x, y, std::min(x + width, size.width), std::min(y + height, size.height)});
        }
    }
    return tiles;
}

template <class Pixel>
std::span<Pixel> row_of(Image<Pixel>& picture, const Rect& tile, int y) {
    return picture.row(y).subspan(static_cast<std::size_t>(tile.x0), static_cast<std::size_t>(tile.width()));
}

std::vector<view::Band> all_of(std::span<const Window> windows) {
    std::vector<view::Band> bands;
    for (const Window& window : windows) {
        bands.push_back({window.face, window.rect});
    }
    return bands;
}

}  // namespace

struct Warp::State {
    struct Tile {
        std::size_t needs;  // so many bands
        Rect rect;
    };

    Finder finder;
    std::span<const view::Band> bands;
    view::Rgb background;
    Image<Rgba8> picture;
    std::vector<Tile> tiles = {};   // those that are made soonest first
    std::size_t made = 0;           // of them
    std::size_t filled = 0;         // bands
    std::vector<int> to_make = {};  // tiles of each stripe

    std::size_t needs(const Rect& tile) const {
        const auto source = finder.source(tile);
        std::size_t count = bands.size();
        const auto touches = [&](const view::Band& band) {
            return !source ||
                   (band.face == source->face && !view::intersection(band.rect, source->rect).empty());
        };
        while (count > 0 && !touches(bands[count - 1])) {
            --count;
        }
        return count;
    }

    // Cuts the picture into tiles: into whole rows where no band is to be waited for.
    void cut(bool at_once) {
        constexpr int narrow = 128;
        const view::ImageSize size{picture.width(), picture.height()};
        for (const Rect& rect : tiles_of(size, at_once ? size.width : narrow)) {
            const std::size_t count = at_once ? bands.size() : needs(rect);
            if (rect.x0 > 0 && tiles.back().needs == count) {
                tiles.back().rect.x1 = rect.x1;
            } else {
                tiles.push_back({count, rect});
            }
        }
        to_make.resize(static_cast<std::size_t>((size.height + stripe_rows - 1) / stripe_rows));
        for (const Tile& tile : tiles) {
            ++to_make[stripe_of(tile)];
        }
        std::ranges::stable_sort(tiles, {}, &Tile::needs);
    }

    static std::size_t stripe_of(const Tile& tile) {
        return static_cast<std::size_t>(tile.rect.y0 / stripe_rows);
    }

    void make(const Rect& tile) {
        const auto width = static_cast<std::size_t>(tile.width());
        std::vector<RgbaF> row(width);
        std::vector<int> left(width);
        for (int y = tile.y0; y < tile.y1; ++y) {
            std::ranges::fill(row, RgbaF{});
            warp_row(finder, tile.x0, y, row, left);
            finish(row, background, row_of(picture, tile, y));
        }
    }
};

Warp::Warp(const Factorisation& factorisation, std::span<const Window> windows,
           std::span<const view::Band> bands, const view::Camera& camera, const view::ImageSize& size,
           const view::Rgb& background)
    : state_(new State{.finder = Finder(factorisation, windows, camera, size),
                       .bands = bands,
                       .background = background,
                       .picture = Image<Rgba8>(size.width, size.height, Unfilled())}) {}

Warp::~Warp() = default;

std::vector<std::size_t> Warp::advance(std::size_t filled, base::Workers& workers) {
    State& state = *state_;
    if (state.tiles.empty()) {
        state.cut(filled == state.bands.size());
    }
    for (; state.filled < filled; ++state.filled) {
        state.finder.take(state.bands[state.filled], workers);
    }
    const auto ready = std::span(state.tiles).subspan(state.made);
    const auto later = std::ranges::upper_bound(ready, filled, {}, &State::Tile::needs);
    const auto count = later - ready.begin();
    workers.for_each(count, [&](std::int64_t n) { state.make(ready[static_cast<std::size_t>(n)].rect); });
    state.made += static_cast<std::size_t>(count);
    std::vector<std::size_t> whole;
    for (const State::Tile& tile : ready.first(static_cast<std::size_t>(count))) {
        if (--state.to_make[State::stripe_of(tile)] == 0) {
            whole.push_back(State::stripe_of(tile));
        }
    }
    return whole;
}

const Image<Rgba8>& Warp::picture() const {
    return state_->picture;
}

bool Warp::done() const {
    return !state_->tiles.empty() && state_->made == state_->tiles.size();
}

Image<Rgba8> Warp::take() {
    base::check(done(), "a picture is taken when all bands are there");
    return std::move(state_->picture);
}

Image<Rgba8> warp(const Factorisation& factorisation, std::span<const Window> windows,
                  const view::Camera& camera, const view::ImageSize& size, const view::Rgb& background,
                  base::Workers& workers) {
    const std::vector<view::Band> bands = all_of(windows);
    Warp warp(factorisation, windows, bands, camera, size, background);
    warp.advance(bands.size(), workers);
    return warp.take();
}

Image<RgbaF> warp_float(const Factorisation& factorisation, std::span<const Window> windows,
                        const view::Camera& camera, const view::ImageSize& size, base::Workers& workers) {
    Image<RgbaF> picture(size.width, size.height);
    Finder finder(factorisation, windows, camera, size);
    for (const view::Band& window : all_of(windows)) {
        finder.take(window, workers);
    }
    const std::vector<Rect> tiles = tiles_of(size, size.width);
    workers.for_each(static_cast<std::int64_t>(tiles.size()), [&](std::int64_t n) {
        const Rect& tile = tiles[static_cast<std::size_t>(n)];
        std::vector<int> left(static_cast<std::size_t>(size.width));
        for (int y = tile.y0; y < tile.y1; ++y) {
            warp_row(finder, tile.x0, y, row_of(picture, tile, y), left);
        }
    });
    return picture;
}

}  // namespace shearwater::image
