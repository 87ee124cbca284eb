#include "renderer/culling/culler.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "renderer/culling/columns.h"
#include "renderer/culling/function_builder.h"

namespace shearwater::culling {

FunctionTable functions_of(const shear::BrickVolume& volume, const FunctionKey& key, const BlockGrid& grid,
                           const DirectionGrid& directions, bool from_octants, base::Workers& workers,
                           const std::stop_token& stop) {
    const LeastExtinctions extinctions(key.basis, volume.mapping());
    const Cells cells =
        from_octants ? cells_of_octants(volume, extinctions) : cells_of_nodes(volume, key.level, extinctions);
    // Octants are too coarse for narrow directions to say more than wide ones.
    constexpr int wider = 3;
    const bool wide = from_octants && directions.side() % (4 * wider) == 0;
    const DirectionGrid grid_of_them = wide ? DirectionGrid(directions.side() / wider) : directions;
    FunctionTable table_of_them =
        key.footprint == Footprint::column
            ? column_functions(cells, grid, volume.box(), grid_of_them, workers, stop)
            : block_functions(cells, grid, volume.box(), grid_of_them, workers, stop);
    return wide ? finer(table_of_them, wider) : table_of_them;
}

Culler::Culler(const shear::BrickVolume& volume, const view::Vec3& spacing, std::int64_t block_edge, int side)
    : volume_(volume),
      spacing_(spacing),
      directions_(side),
      store_(BlockGrid(volume.cube(), block_edge), directions_) {
    base::check(volume.box() == volume::whole(volume.cube()), "the volume is the whole cube");
}

std::int64_t Culler::prepare(const view::TransferFunction& tf, Kind kind, int level, base::Workers& workers) {
    std::int64_t computed = 0;
    for (const Member& member : members_of(tf)) {
        for (const Footprint footprint : footprints_of(kind)) {
            const FunctionKey key{footprint, member.basis, level};
            if (store_.find(key) == nullptr) {
                store_.put(key, std::make_shared<FunctionTable>(
                                    functions_of(volume_, key, store_.grid(), directions_, false, workers)));
                computed += static_cast<std::int64_t>(store_.grid().size());
            }
        }
    }
    return computed;
}

VisibleBlocks Culler::visible(const view::Factorisation& factorisation, const view::TransferFunction& tf,
                              const Settings& settings, base::Workers& workers) {
    const std::vector<BlockRates> rates = store_.rates(tf, settings.kind, factorisation.level(),
                                                       std::min({spacing_.x, spacing_.y, spacing_.z}));
    return {store_.grid(), visible_blocks(factorisation, store_.grid(), rates, settings, workers)};
}

}  // namespace shearwater::culling
