#include "protocol/node/lookout.h"

#include <algorithm>
#include <cstring>

namespace shearwater::node {

using culling::BlockGrid;
using culling::DirectionGrid;

Lookout::Known& Lookout::known(const culling::FunctionKey& key) {
    const auto found = std::ranges::find(known_, key, &Known::key);
    return found != known_.end() ? *found : known_.emplace_back(Known{key, {}, {}, {}});
}

void Lookout::learn(const Learn& learn) {
    const wire::FunctionPart& part = learn.part;
    const BlockGrid grid(learn.n);
    const DirectionGrid directions(part.side);
    if (part.blocks != grid.blocks_of(learn.box)) {
        return;  // of another division
    }
    Known& of = known(learn.key);
    Incoming& incoming = (part.coarse ? of.coarse : of.fine)[part.place];
    if (part.first_direction == 0) {
        incoming = {.table = {.blocks = part.blocks, .side = part.side, .codes = {}}};
        incoming.table.codes.resize(incoming.table.block_count() *
                                    static_cast<std::size_t>(directions.cells()));
    }
    if (part.first_direction != incoming.directions) {
        return;  // what came before it is lost, and will come again
    }
    std::memcpy(
        &incoming.table.codes[static_cast<std::size_t>(part.first_direction) * incoming.table.block_count()],
        part.codes.data(), part.codes.size());
    incoming.directions += part.directions;
    if (incoming.directions < directions.cells()) {
        return;
    }
    const std::int64_t cell = part.coarse ? 4 : std::int64_t{1} << learn.key.level;
    of.parts[part.place] = {learn.box,
                            std::make_shared<const culling::FunctionTable>(std::move(incoming.table)), cell};
    (part.coarse ? of.coarse : of.fine).erase(part.place);
    std::vector<culling::SubVolume> parts;
    for (const auto& [place, sub_volume] : of.parts) {
        parts.push_back(sub_volume);
    }
    auto whole = parts.size() == 1 && parts[0].box == volume::whole(learn.n)
                     ? parts[0].table
                     : std::make_shared<const culling::FunctionTable>(
                           culling::merged(grid, directions, learn.key.footprint, parts));
    const std::lock_guard lock(mutex_);
    if (!store_ || store_->grid() != grid) {
        store_.emplace(grid, directions);
    }
    store_->put(learn.key, std::move(whole));
}

void Lookout::forget(const Forget& forget) {
    std::erase_if(known_, [&](const Known& known) { return known.key == forget.key; });
    const std::lock_guard lock(mutex_);
    if (store_) {
        store_->erase(forget.key);
    }
}

std::optional<wire::Message> Lookout::give(std::uint64_t request, const culling::FunctionKey& key,
                                           std::uint64_t number, int first_direction) {
    const std::lock_guard lock(mutex_);
    const culling::FunctionTable* const table = store_ ? store_->find(key) : nullptr;
    return table != nullptr
               ? std::optional(wire::give_functions(request, key, number, *table, first_direction))
               : std::nullopt;
}

Looked Lookout::look(const Look& look, base::Workers& workers) {
    const std::lock_guard lock(mutex_);
    const BlockGrid grid(look.factorisation.lattice.n);
    if (!store_ || store_->grid() != grid) {
        return {look.number, {grid, culling::BlockSet(grid.size(), true)}};
    }
    const view::Vec3& spacing = look.factorisation.lattice.spacing;
    const std::vector<culling::BlockRates> rates = store_->rates(
        look.tf, look.settings.kind, look.factorisation.level(), std::min({spacing.x, spacing.y, spacing.z}));
    return {look.number,
            {grid, visible_blocks(look.factorisation, grid, rates, look.settings, workers, look.part)}};
}

}  // namespace shearwater::node
