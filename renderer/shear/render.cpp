#include "renderer/shear/render.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <numeric>

#include "renderer/shear/face_plan.h"
#include "renderer/shear/tile.h"

namespace shearwater::shear {

namespace {

using image::Window;
using view::Rect;

// What the threads of a frame share.
struct Frame {
    const BrickVolume& volume;
    const Classification& classification;
    BricksMet met;
    std::uint64_t samples = 0;
};

// Tiles that wait for a thread to need one again.
template <class Code>
class IdleTiles {
  public:
    template <class Make>
    std::unique_ptr<Tile<Code>> take(const Make& make) {
        const std::lock_guard lock(mutex_);
        if (tiles_.empty()) {
            return make();
        }
        auto tile = std::move(tiles_.back());
        tiles_.pop_back();
        return tile;
    }
    void give_back(std::unique_ptr<Tile<Code>> tile) {
        const std::lock_guard lock(mutex_);
        tiles_.push_back(std::move(tile));
    }
    std::uint64_t samples() const {
        return std::accumulate(tiles_.begin(), tiles_.end(), std::uint64_t{0},
                               [](std::uint64_t sum, const auto& tile) { return sum + tile->samples(); });
    }

  private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Tile<Code>>> tiles_;
};

template <class Code>
void render_window(Frame& frame, const FacePlan& plan, Window& window, base::Workers& workers,
                   const std::stop_token& stop) {
    const Rect& whole = plan.window();
    const int across = (whole.width() + Tile<Code>::width - 1) / Tile<Code>::width;
    const int down = (whole.height() + Tile<Code>::height - 1) / Tile<Code>::height;
    IdleTiles<Code> idle;
    const auto paint = [&](std::int64_t n) {
        const int x = whole.x0 + static_cast<int>(n % across) * Tile<Code>::width;
        const int y = whole.y0 + static_cast<int>(n / across) * Tile<Code>::height;
        auto tile = idle.take([&] {
            return std::make_unique<Tile<Code>>(frame.volume, frame.classification, plan, frame.met);
        });
        tile->render(intersection(whole, {x, y, x + Tile<Code>::width, y + Tile<Code>::height}));
        tile->store(window);
        idle.give_back(std::move(tile));
    };
    workers.for_each(std::int64_t{across} * down, paint, stop);
    frame.samples += idle.samples();
}

RenderStats count(const Frame& frame) {
    RenderStats stats{.samples = frame.samples, .bricks_total = frame.met.size()};
    for (std::size_t i = 0; i < frame.met.size(); ++i) {
        stats.bricks_empty += frame.classification.opaque[i] == 0 ? 1 : 0;
        stats.bricks_rendered += frame.met[i].load(std::memory_order_relaxed);
    }
    return stats;
}

}  // namespace

std::vector<Window> render(const BrickVolume& volume, const Classification& classification,
                           const view::Factorisation& factorisation, base::Workers& workers,
                           RenderStats* stats, const std::stop_token& stop) {
    base::check(factorisation.lattice.n == volume.cube(), "a factorisation is that of the volume's cube");
    base::check(factorisation.level() < volume.levels(), "a factorisation keeps to the cube's levels");
    base::check(
        classification.segments.has_value() == (factorisation.classify == view::Classify::pre_integrated),
        "a volume is classified as the factorisation has it");
    Frame frame{.volume = volume,
                .classification = classification,
                .met = BricksMet(volume.bricks().ranges().size())};
    std::vector<Window> windows;
    for (std::size_t face = 0; face < factorisation.faces.size() && !stop.stop_requested(); ++face) {
        const FacePlan plan(volume, factorisation, static_cast<int>(face));
        const Rect rect = plan.turn(plan.window());
        if (rect.empty()) {
            continue;
        }
        windows.push_back({.face = static_cast<int>(face),
                           .rect = rect,
                           .pixels = image::Image<image::RgbaF>(rect.width(), rect.height())});
        volume.mapping().bits == 8 ? render_window<std::uint8_t>(frame, plan, windows.back(), workers, stop)
                                   : render_window<std::uint16_t>(frame, plan, windows.back(), workers, stop);
    }
    if (stats != nullptr) {
        *stats = count(frame);
    }
    return windows;
}

std::vector<Window> render(const BrickVolume& volume, const view::Factorisation& factorisation,
                           const view::TransferFunction& tf, base::Workers& workers, RenderStats* stats,
                           const std::stop_token& stop) {
    return render(volume, classify(volume, tf, factorisation.classify, workers), factorisation, workers,
                  stats, stop);
}

}  // namespace shearwater::shear
