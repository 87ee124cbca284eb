#include "renderer/shear/render.h"

#include <atomic>

#include "renderer/shear/face_plan.h"
#include "renderer/shear/opacity_table.h"
#include "renderer/shear/tile.h"

namespace shearwater::shear {

namespace {

using image::Window;
using view::Rect;

BrickState state_of(const BrickVolume& volume, const OpacityTable& table) {
    const auto count = volume.bricks().size();
    BrickState state{.visible = std::vector<std::uint8_t>(count),
                     .rendered = std::vector<std::atomic<std::uint8_t>>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const Brick& brick = volume.bricks()[i];
        state.visible[i] = table.any_opacity(brick.min, brick.max) ? 1 : 0;
    }
    return state;
}

template <class Code>
std::uint64_t render_window(const BrickVolume& volume, std::span<const Code> codes, const FacePlan& plan,
                            const OpacityTable& table, BrickState& state, Window& window,
                            base::Workers& workers, const std::stop_token& stop) {
    constexpr int side = Tile<Code>::side;
    const int across = (window.rect.width() + side - 1) / side;
    const int down = (window.rect.height() + side - 1) / side;
    std::atomic<std::uint64_t> samples{0};
    const auto paint = [&](std::int64_t n) {
        const int x = window.rect.x0 + static_cast<int>(n % across) * side;
        const int y = window.rect.y0 + static_cast<int>(n / across) * side;
        Tile<Code> tile(volume, codes, plan, table, state,
                        intersection(window.rect, {x, y, x + side, y + side}));
        tile.render();
        tile.store(window);
        samples.fetch_add(tile.samples(), std::memory_order_relaxed);
    };
    workers.for_each(std::int64_t{across} * down, paint, stop);
    return samples.load();
}

RenderStats count(const BrickVolume& volume, const BrickState& state, std::uint64_t samples) {
    RenderStats stats{.samples = samples, .bricks_total = volume.bricks().size()};
    for (std::size_t i = 0; i < volume.bricks().size(); ++i) {
        stats.bricks_empty += state.visible[i] == 0 ? 1 : 0;
        stats.bricks_rendered += state.rendered[i].load(std::memory_order_relaxed);
    }
    return stats;
}

}  // namespace

std::vector<Window> render(const BrickVolume& volume, const view::Factorisation& factorisation,
                           const view::TransferFunction& tf, base::Workers& workers, RenderStats* stats,
                           const std::stop_token& stop) {
    base::check(factorisation.lattice.n == volume.cube(), "a factorisation is that of the volume's cube");
    const OpacityTable table(tf, volume.mapping().levels());
    BrickState state = state_of(volume, table);
    std::vector<Window> windows;
    std::uint64_t samples = 0;
    for (std::size_t face = 0; face < factorisation.faces.size() && !stop.stop_requested(); ++face) {
        const FacePlan plan(volume, factorisation, static_cast<int>(face));
        const Rect& rect = plan.window();
        if (rect.empty()) {
            continue;
        }
        windows.push_back({.face = static_cast<int>(face),
                           .rect = rect,
                           .pixels = image::Image<image::RgbaF>(rect.width(), rect.height())});
        samples +=
            volume.mapping().bits == 8
                ? render_window(volume, volume.codes8(), plan, table, state, windows.back(), workers, stop)
                : render_window(volume, volume.codes16(), plan, table, state, windows.back(), workers, stop);
    }
    if (stats != nullptr) {
        *stats = count(volume, state, samples);
    }
    return windows;
}

}  // namespace shearwater::shear
