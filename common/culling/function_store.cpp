#include "common/culling/function_store.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <utility>

#include "common/base/check.h"
#include "common/culling/rates.h"

namespace shearwater::culling {

namespace {

template <class Of>
std::array<float, 256> rates_by_code(const Of& of) {
    std::array<float, 256> rates{};
    for (int code = 0; code < 256; ++code) {
        rates[static_cast<std::size_t>(code)] = static_cast<float>(of(rate_of(code)));
    }
    return rates;
}

// The greatest code of a rate that is no more, for many. Rates alike in their leading bits, fewer than codes
// are apart, begin at one code and go on to the next at most.
class CodesBelow {
  public:
    explicit CodesBelow(const std::array<float, 256>& rates) : rates_(rates) {
        for (std::uint32_t n = 0; n < first_.size(); ++n) {
            const float rate = std::bit_cast<float>((n + least) << dropped);
            const auto above = std::upper_bound(rates_.begin(), rates_.end(), rate);
            first_[n] = static_cast<std::uint8_t>(above - rates_.begin() - 1);
        }
    }

    std::uint8_t operator()(float rate) const {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(rate) >> dropped;
        if (bits < least) {
            return 0;
        }
        std::uint8_t code = first_[std::min<std::size_t>(bits - least, first_.size() - 1)];
        while (code < most_code && rates_[code + 1U] <= rate) {
            ++code;
        }
        return code;
    }

  private:
    static constexpr int dropped = 23 - 5;
    static constexpr std::uint32_t least = (127 - 13) << 5;  // 2^-13, below all codes
    std::array<float, 256> rates_;
    std::array<std::uint8_t, 13 * 32> first_{};  // up to 1
};

// The code of what members' rates combine to, as a share of the most; by one thread at a time.
class Combining {
  public:
    Combining(Combination combination, float most)
        : combination_(std::move(combination)),
          // Rounded so that no code says more than it would times `most`.
          scale_(most > 0 ? (1 - 1e-6F) / most : 0) {}

    std::uint8_t operator()(std::span<const float> rates) const {
        return codes_below_(combination_(rates) * scale_);
    }

  private:
    const CodesBelow codes_below_{rates_by_code([](double rate) { return rate; })};
    Combination combination_;
    float scale_;
};

}  // namespace

FunctionStore::FunctionStore(const BlockGrid& grid, const DirectionGrid& directions)
    : grid_(grid), directions_(directions) {}

void FunctionStore::put(const FunctionKey& key, std::shared_ptr<const FunctionTable> table) {
    base::check(table->side == directions_.side() && table->block_count() == grid_.size() &&
                    table->codes.size() == grid_.size() * static_cast<std::size_t>(directions_.cells()),
                "a table is of the whole grid and all directions");
    erase(key);
    const std::uint8_t greatest = table->codes.empty() ? std::uint8_t{0} : std::ranges::max(table->codes);
    tables_.push_back({key, std::move(table), greatest});
}

void FunctionStore::erase(const FunctionKey& key) {
    asked_.reset();
    std::erase_if(tables_, [&](const Kept& kept) { return kept.key == key; });
}

const FunctionStore::Kept* FunctionStore::kept(const FunctionKey& key) const {
    const auto found = std::ranges::find(tables_, key, &Kept::key);
    return found != tables_.end() ? &*found : nullptr;
}

const FunctionTable* FunctionStore::find(const FunctionKey& key) const {
    const Kept* const found = kept(key);
    return found != nullptr ? found->table.get() : nullptr;
}

FunctionStore::Combined FunctionStore::combined(Footprint footprint) const {
    std::vector<Member> members;
    std::vector<Scaled> scaled;
    float most = 0, greatest = 0;
    for (const Member& member : members_of(asked_->tf)) {
        if (const Kept* const found = kept({footprint, member.basis, asked_->level})) {
            // A density multiplies all extinctions alike.
            scaled.push_back({found->table.get(), rates_by_code([&](double rate) {
                                  return asked_->tf.density * lifted(rate, member.height, asked_->distance);
                              })});
            most = std::max(most, scaled.back().rate[most_code]);
            greatest += scaled.back().rate[found->greatest];
            members.push_back(member);
        }
    }
    return {footprint, most, greatest, std::move(scaled), Combination(members)};
}

std::vector<BlockRates> FunctionStore::rates(const view::TransferFunction& tf, Kind kind, int level,
                                             double distance) {
    if (const Asked asked{tf, kind, level, distance}; asked_ != asked) {
        asked_ = asked;
        combined_.clear();
        for (const Footprint footprint : footprints_of(kind)) {
            combined_.push_back(combined(footprint));
        }
    }
    std::vector<BlockRates> rates;
    for (Combined& each : combined_) {
        rates.push_back({each.footprint, directions_,
                         [this, &each](std::span<const int> cells, base::Workers& workers) {
                             return codes_of(each, cells, workers);
                         },
                         each.scaled.size() == 1 ? each.scaled[0].rate : rates_by_code([&](double rate) {
                             return rate * static_cast<double>(each.most);
                         }),
                         each.greatest});
    }
    return rates;
}

std::vector<BlockCodes> FunctionStore::codes_of(Combined& combined, std::span<const int> cells,
                                                base::Workers& workers) const {
    const auto of_cell = [&](std::size_t table, int cell) {
        return std::span(combined.scaled[table].table->codes)
            .subspan(static_cast<std::size_t>(cell) * grid_.size(), grid_.size());
    };
    std::vector<BlockCodes> codes;
    if (combined.scaled.size() == 1) {
        std::ranges::transform(cells, std::back_inserter(codes),
                               [&](int cell) { return BlockCodes(of_cell(0, cell)); });
        return codes;
    }
    if (combined.scaled.size() == 2) {
        if (combined.of_pairs.empty()) {
            combine_pairs(combined, workers);
        }
        std::ranges::transform(cells, std::back_inserter(codes), [&](int cell) {
            return BlockCodes(of_cell(0, cell), of_cell(1, cell), combined.of_pairs);
        });
        return codes;
    }
    std::vector<std::pair<int, std::vector<std::uint8_t>*>> missing;
    for (const int cell : cells) {
        std::vector<std::uint8_t>& of = combined.of[cell];
        if (of.empty()) {
            of.resize(grid_.size());
            missing.emplace_back(cell, &of);
        }
        codes.emplace_back(of);
    }
    workers.for_each(static_cast<std::int64_t>(missing.size()), [&](std::int64_t n) {
        const auto& [cell, of] = missing[static_cast<std::size_t>(n)];
        combine(combined, cell, *of);
    });
    return codes;
}

// Of 65536 pairs, where a cell may have as many blocks, and a view dozens of cells: what two codes combine to
// is then looked up where a beam comes to a block.
void FunctionStore::combine_pairs(Combined& combined, base::Workers& workers) {
    constexpr std::size_t codes = 256;
    combined.of_pairs.resize(codes * codes);
    workers.for_each(static_cast<std::int64_t>(codes), [&](std::int64_t first) {
        Combining combining(combined.combination, combined.most);
        const auto n = static_cast<std::size_t>(first);
        for (std::size_t second = 0; second < codes; ++second) {
            const std::array<float, 2> rates{combined.scaled[0].rate[n], combined.scaled[1].rate[second]};
            combined.of_pairs[n * codes + second] = combining(rates);
        }
    });
}

void FunctionStore::combine(const Combined& combined, int cell, std::span<std::uint8_t> codes) const {
    const std::size_t first = static_cast<std::size_t>(cell) * grid_.size();
    Combining combining(combined.combination, combined.most);
    std::vector<float> rates(combined.scaled.size());
    for (std::size_t block = 0; block < codes.size(); ++block) {
        for (std::size_t n = 0; n < rates.size(); ++n) {
            const Scaled& scaled = combined.scaled[n];
            rates[n] = scaled.rate[scaled.table->codes[first + block]];
        }
        codes[block] = combining(rates);
    }
}

}  // namespace shearwater::culling
