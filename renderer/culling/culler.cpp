#include "renderer/culling/culler.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "renderer/culling/columns.h"

namespace shearwater::culling {

FunctionTable functions_of(const shear::BrickVolume& volume, const FunctionKey& key, const BlockGrid& grid,
                           const DirectionGrid& directions, bool from_octants, const view::Vec3& spacing,
                           base::Workers& workers, const std::stop_token& stop) {
    const double height = ladder[static_cast<std::size_t>(key.rung)];
    const shear::OpacityTable table(at_height(key.basis, height), volume.mapping().levels());
    // Of a basis of height 1: what the pin's height is multiplied with.
    const double length = std::min({spacing.x, spacing.y, spacing.z}) / height;
    const LeastExtinctions extinctions(table, volume.mapping().bits, length);
    const shear::CodeVolume& nodes = volume.level(key.level);
    const Cells cells = from_octants
                            ? cells_of_octants(nodes, volume.box(), volume.cube(), extinctions)
                            : cells_of_nodes(nodes, key.level, volume.box(), volume.cube(), extinctions);
    return column_functions(cells, grid, volume.box(), directions, workers, stop);
}

Culler::Culler(const shear::BrickVolume& volume, const view::Vec3& spacing, const Settings& settings)
    : volume_(volume),
      spacing_(spacing),
      settings_(settings),
      directions_(settings.side),
      store_(BlockGrid(volume.cube(), settings.block_edge), directions_) {
    base::check(volume.box() == volume::whole(volume.cube()), "the volume is the whole cube");
}

std::int64_t Culler::prepare(const view::TransferFunction& tf, int level, base::Workers& workers) {
    std::int64_t computed = 0;
    for (const Member& member : members_of(tf)) {
        const auto rung = rung_below(member.height);
        if (rung && !store_.has({member.basis, *rung, level})) {
            const FunctionKey key{member.basis, *rung, level};
            store_.put(key, std::make_shared<FunctionTable>(functions_of(
                                volume_, key, store_.grid(), directions_, false, spacing_, workers)));
            computed += static_cast<std::int64_t>(store_.grid().size());
        }
    }
    return computed;
}

VisibleBlocks Culler::visible(const view::Factorisation& factorisation, const view::TransferFunction& tf,
                              base::Workers& workers) {
    const BlockRates rates = store_.rates(tf, factorisation.level());
    return {store_.grid(),
            visible_blocks(factorisation, store_.grid(), rates, -std::log1p(-settings_.threshold), workers)};
}

}  // namespace shearwater::culling
