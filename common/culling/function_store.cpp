#include "common/culling/function_store.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/culling/rates.h"

namespace shearwater::culling {

FunctionStore::FunctionStore(const BlockGrid& grid, const DirectionGrid& directions)
    : grid_(grid), directions_(directions) {}

void FunctionStore::put(const FunctionKey& key, std::shared_ptr<const FunctionTable> table) {
    base::check(table->side == directions_.side() && table->block_count() == grid_.size() &&
                    table->codes.size() == grid_.size() * static_cast<std::size_t>(directions_.cells()),
                "a table is of the whole grid and all directions");
    combined_.reset();
    for (auto& [there, old] : tables_) {
        if (there == key) {
            old = std::move(table);
            return;
        }
    }
    tables_.emplace_back(key, std::move(table));
}

void FunctionStore::erase(const FunctionKey& key) {
    combined_.reset();
    std::erase_if(tables_, [&](const auto& table) { return table.first == key; });
}

std::shared_ptr<const FunctionTable> FunctionStore::find(const FunctionKey& key) const {
    for (const auto& [there, table] : tables_) {
        if (there == key) {
            return table;
        }
    }
    return nullptr;
}

BlockRates FunctionStore::rates(const view::TransferFunction& tf, Footprint footprint, int level) {
    if (!combined_ || combined_->tf != tf || combined_->footprint != footprint || combined_->level != level) {
        std::vector<Member> members;
        std::vector<Scaled> scaled;
        for (const Member& member : members_of(tf)) {
            for (int rung = rung_below(member.height).value_or(-1); rung >= 0; --rung) {
                if (const auto table = find({footprint, member.basis, rung, level})) {
                    Scaled& of = scaled.emplace_back();
                    of.table = table.get();
                    for (int code = 0; code < 256; ++code) {
                        of.rate[static_cast<std::size_t>(code)] =
                            static_cast<float>(rate_of(code) * member.height);
                    }
                    members.push_back(member);
                    break;
                }
            }
        }
        combined_ = std::make_unique<Combined>(
            Combined{tf, footprint, level, std::move(scaled), Combination(members), {}});
    }
    return {directions_, [this](int cell) { return combine(cell); }};
}

std::span<const float> FunctionStore::combine(int cell) {
    std::vector<float>& of = combined_->of[cell];
    if (!of.empty()) {
        return of;
    }
    of.resize(grid_.size());
    const std::size_t first = static_cast<std::size_t>(cell) * grid_.size();
    std::vector<float> rates(combined_->scaled.size());
    for (std::size_t block = 0; block < of.size(); ++block) {
        for (std::size_t n = 0; n < rates.size(); ++n) {
            const Scaled& scaled = combined_->scaled[n];
            rates[n] = scaled.rate[scaled.table->codes[first + block]];
        }
        of[block] = rates.size() == 1 ? rates[0] : combined_->combination(rates);
    }
    return of;
}

}  // namespace shearwater::culling
