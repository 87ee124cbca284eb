#include "renderer/shear/render.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include "renderer/shear/face_plan.h"
#include "renderer/shear/ray_pixels.h"
#include "renderer/shear/seen.h"
#include "renderer/shear/tile.h"

namespace shearwater::shear {

namespace {

using image::Window;
using view::Rect;

// What the threads of a frame share.
struct Frame {
    const BrickVolume& volume;
    const Classification& classification;
    std::span<const Content> contents;
    BricksMet met;
    std::uint64_t samples = 0;
};

// One for each thread, which finds what it needs of it in its own cache.
template <class Code>
class TilesOfThreads {
  public:
    template <class Make>
    Tile<Code>& mine(const Make& make) {
        const std::lock_guard lock(mutex_);
        std::unique_ptr<Tile<Code>>& tile = tiles_[std::this_thread::get_id()];
        if (!tile) {
            tile = make();
        }
        return *tile;
    }
    std::uint64_t samples() const {
        return std::accumulate(tiles_.begin(), tiles_.end(), std::uint64_t{0},
                               [](std::uint64_t sum, const auto& of) { return sum + of.second->samples(); });
    }

  private:
    std::mutex mutex_;
    std::map<std::thread::id, std::unique_ptr<Tile<Code>>> tiles_;
};

// Tells of bands in their order, whichever thread it is that draws the last of one.
class InOrder {
  public:
    InOrder(std::size_t bands, const OnBands& on_bands) : windows_(bands), on_bands_(on_bands) {}

    void put(std::size_t band, Window window) {
        const std::lock_guard lock(mutex_);
        windows_[band] = std::move(window);
    }

    void tell() {
        std::unique_lock lock(mutex_);
        if (telling_) {
            return;  // that thread goes on to this one
        }
        telling_ = true;
        while (told_ < windows_.size() && windows_[told_]) {
            DrawnBands next = next_of();
            lock.unlock();
            on_bands_(std::move(next));
            lock.lock();
        }
        telling_ = false;
    }

  private:
    // Those without pixels go with the next that has some, if it is there.
    DrawnBands next_of() {
        DrawnBands next;
        while (told_ < windows_.size() && windows_[told_] && next.window.rect.empty()) {
            next.window = std::move(*windows_[told_++]);
        }
        next.bands = told_;
        return next;
    }

    std::vector<std::optional<Window>> windows_;
    const OnBands& on_bands_;
    std::size_t told_ = 0;
    bool telling_ = false;
    std::mutex mutex_;
};

// A band of a face, as far as the sub-volume reaches.
struct Part {
    std::size_t band;
    Rect rect;                // turned, as tiles are
    int across, rows;         // tiles beside one another; lines of each, but for the last
    std::int64_t first_tile;  // of the face's
    std::atomic<std::int64_t> tiles_left;
    std::once_flag begun;
    Window window;  // without pixels as long as no tile has any
    std::mutex mutex;
    std::vector<Rect> clear;  // tiles without, to be filled in if the window has pixels in the end
};

template <class Code>
class FaceRenderer {
  public:
    FaceRenderer(Frame& frame, const SparsePieces<Code>* pieces, const FacePlan& plan, InOrder& order)
        : frame_(frame),
          pieces_(pieces),
          plan_(plan),
          order_(order),
          tile_rows_(Tile<Code>::rows_of(frame.volume, plan, pieces != nullptr)) {}

    void add(std::size_t band, const view::Band& cut) {
        const Rect rect = intersection(plan_.window(), plan_.turn(cut.rect));
        if (rect.empty()) {
            order_.put(band, {});
            return;
        }
        Part& part = parts_.emplace_back();
        part.band = band;
        part.rect = rect;
        part.across = (rect.width() + Tile<Code>::width - 1) / Tile<Code>::width;
        constexpr int step = image::LitBlocks::block;
        const int wanted = std::max((rect.height() + tile_rows_ / 2) / tile_rows_, 1);
        part.rows =
            std::min((rect.height() + wanted - 1) / wanted + step - 1, Tile<Code>::height) / step * step;
        const int down = (rect.height() + part.rows - 1) / part.rows;
        part.first_tile = tiles_;
        part.tiles_left = std::int64_t{part.across} * down;
        part.window.face = cut.face;
        tiles_ += part.tiles_left;
    }

    void render(base::Workers& workers, const std::stop_token& stop) {
        order_.tell();  // where there is nothing
        workers.for_each(
            tiles_, [this](std::int64_t n) { paint(n); }, stop);
        frame_.samples += tiles_of_threads_.samples();
    }

  private:
    void paint(std::int64_t n) {
        const auto after = std::ranges::upper_bound(parts_, n, {}, &Part::first_tile);
        Part& part = *std::prev(after);
        const int x =
            part.rect.x0 + static_cast<int>((n - part.first_tile) % part.across) * Tile<Code>::width;
        const int y = part.rect.y0 + static_cast<int>((n - part.first_tile) / part.across) * part.rows;
        Tile<Code>& tile = tiles_of_threads_.mine([this] {
            return std::make_unique<Tile<Code>>(frame_.volume, frame_.classification, frame_.contents,
                                                pieces_, plan_, frame_.met);
        });
        const Rect rect = intersection(part.rect, {x, y, x + Tile<Code>::width, y + part.rows});
        if (tile.render(rect)) {
            std::call_once(part.begun, [&] {
                const Rect all = plan_.turn(part.rect);
                part.window.rect = all;
                part.window.pixels = image::Image<image::RgbaF>(all.width(), all.height(), image::Unfilled());
                part.window.lit = image::LitBlocks(all.width(), all.height());
            });
            tile.store(part.window);
        } else {
            const std::lock_guard lock(part.mutex);
            part.clear.push_back(plan_.turn(rect));
        }
        if (part.tiles_left.fetch_sub(1) == 1) {
            if (!part.window.rect.empty()) {
                for (const Rect& without : part.clear) {
                    clear(part.window, without);
                }
            }
            order_.put(part.band, std::move(part.window));
            order_.tell();
        }
    }

    static void clear(Window& window, const Rect& rect) {
        for (int y = rect.y0; y < rect.y1; ++y) {
            const auto row = window.pixels.row(y - window.rect.y0)
                                 .subspan(static_cast<std::size_t>(rect.x0 - window.rect.x0),
                                          static_cast<std::size_t>(rect.width()));
            clear_pixels(row);
        }
        flush_cleared();
    }

    Frame& frame_;
    const SparsePieces<Code>* const pieces_;
    const FacePlan& plan_;
    InOrder& order_;
    const int tile_rows_;
    TilesOfThreads<Code> tiles_of_threads_;
    std::deque<Part> parts_;
    std::int64_t tiles_ = 0;
};

RenderStats count(const Frame& frame) {
    RenderStats stats{.samples = frame.samples, .bricks_total = frame.met.size()};
    for (std::size_t i = 0; i < frame.met.size(); ++i) {
        stats.bricks_empty += frame.classification.opaque[i] == 0 ? 1 : 0;
        stats.bricks_rendered += frame.met[i].load(std::memory_order_relaxed);
    }
    return stats;
}

// Where there is little to be seen by the classification.
template <class Code>
const SparsePieces<Code>* pieces_of(const Frame& frame, const FacePlan& plan, base::Workers& workers) {
    const auto level = static_cast<std::size_t>(plan.level());
    const Classification& by = frame.classification;
    return by.is_sparse[level]
               ? &by.sparse->pieces<Code>(frame.volume.level(plan.level()), plan.level(), by.table,
                                          by.micro_bricks[level], plan.face().axis, workers)
               : nullptr;
}

template <class Code>
void render_faces(Frame& frame, const view::Factorisation& factorisation, std::span<const view::Band> bands,
                  base::Workers& workers, const OnBands& on_bands, const std::stop_token& stop) {
    InOrder order(bands.size(), on_bands);
    for (std::size_t band = 0; band < bands.size() && !stop.stop_requested();) {
        const int face = bands[band].face;
        const FacePlan plan(frame.volume, factorisation, face);
        FaceRenderer<Code> renderer(frame, pieces_of<Code>(frame, plan, workers), plan, order);
        for (; band < bands.size() && bands[band].face == face; ++band) {
            renderer.add(band, bands[band]);
        }
        renderer.render(workers, stop);
    }
}

}  // namespace

RenderStats render_bands(const BrickVolume& volume, const Classification& classification,
                         const view::Factorisation& factorisation, std::span<const view::Band> bands,
                         base::Workers& workers, const OnBands& on_bands, const RenderOptions& options) {
    base::check(factorisation.lattice.n == volume.cube(), "a factorisation is that of the volume's cube");
    base::check(factorisation.level() < volume.levels(), "a factorisation keeps to the cube's levels");
    base::check(
        classification.segments.has_value() == (factorisation.classify == view::Classify::pre_integrated),
        "a volume is classified as the factorisation has it");
    const culling::VisibleBlocks* const visible = options.visible;
    const std::vector<Content>& all =
        classification.micro_bricks[static_cast<std::size_t>(factorisation.level())];
    const bool any = visible == nullptr || sees_any(volume.box(), *visible);
    const std::vector<Content> seen = visible != nullptr && any
                                          ? seen_contents(volume.level(factorisation.level()),
                                                          factorisation.level(), all, *visible, workers)
                                          : std::vector<Content>();
    Frame frame{.volume = volume,
                .classification = classification,
                .contents = visible != nullptr ? seen : all,
                .met = BricksMet(volume.bricks().ranges().size())};
    if (!any) {
        on_bands({bands.size(), {}});
    } else if (volume.mapping().bits == 8) {
        render_faces<std::uint8_t>(frame, factorisation, bands, workers, on_bands, options.stop);
    } else {
        render_faces<std::uint16_t>(frame, factorisation, bands, workers, on_bands, options.stop);
    }
    RenderStats stats = count(frame);
    if (visible != nullptr) {
        stats.bricks_culled = hidden_bricks(volume, classification.opaque, *visible);
    }
    return stats;
}

Rendered render(const BrickVolume& volume, const Classification& classification,
                const view::Factorisation& factorisation, base::Workers& workers,
                const RenderOptions& options) {
    std::vector<view::Band> whole;
    for (const view::Face& face : factorisation.faces) {
        whole.push_back({static_cast<int>(whole.size()), {0, 0, face.width, face.height}});
    }
    Rendered rendered;
    const auto keep = [&](DrawnBands drawn) {
        if (!drawn.window.rect.empty()) {
            rendered.windows.push_back(std::move(drawn.window));
        }
    };
    rendered.stats = render_bands(volume, classification, factorisation, whole, workers, keep, options);
    return rendered;
}

Rendered render(const BrickVolume& volume, const view::Factorisation& factorisation,
                const view::TransferFunction& tf, base::Workers& workers, const RenderOptions& options) {
    return render(volume, classify(volume, tf, factorisation.classify, workers), factorisation, workers,
                  options);
}

}  // namespace shearwater::shear
