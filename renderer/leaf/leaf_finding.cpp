// The leaf's part in leaving out what is hidden: it finds its blocks' opacity functions, one key after the
// other.

#include <algorithm>
#include <utility>

#include "common/volume/levels.h"
#include "protocol/wire/convert_culling.h"
#include "renderer/leaf/leaf.h"

namespace shearwater::leaf {

namespace pb = wire::pb;

void Leaf::on_want_functions(wire::LinkId link, const pb::WantFunctions& want, Effects& effects) {
    constexpr std::uint32_t most_side = 360;
    std::vector<WantedFunctions> functions;
    std::vector<std::uint64_t> numbers;
    for (const pb::FunctionWant& wanted : want.wants()) {
        auto key = wire::function_key_from(wanted.key());
        if (!key) {
            effects.net.emplace_back(wire::CloseLink{link, key.error().reason, key.error().text});
            return;
        }
        numbers.push_back(wanted.number());
        if (share_ && std::ranges::find(wanted.known(), share_->place) == wanted.known().end()) {
            functions.push_back({wanted.number(), *std::move(key)});
        }
    }
    if ((want.block_edge() != 16 && want.block_edge() != 32) || want.side() == 0 || want.side() % 4 != 0 ||
        want.side() > most_side) {
        effects.net.emplace_back(wire::CloseLink{link, pb::REASON_INVALID, "want_functions: no such grid"});
        return;
    }
    if (want.renewal() != renewal_ || want.block_edge() != block_edge_ ||
        std::cmp_not_equal(want.side(), side_)) {
        stop_finding(effects);
        told_.clear();
        renewal_ = want.renewal();
        block_edge_ = want.block_edge();
        side_ = static_cast<int>(want.side());
    }
    functions_ = std::move(functions);
    keep_given(numbers, effects);
    if (find_job_ != 0 &&
        std::ranges::find(functions_, finding_, &WantedFunctions::number) == functions_.end()) {
        stop_finding(effects);
    }
    find_next(effects);
}

void Leaf::find_next(Effects& effects) {
    if (find_job_ != 0 || phase_ != pb::PHASE_READY) {
        return;
    }
    for (const WantedFunctions& wanted : functions_) {
        const bool there = std::cmp_less_equal(wanted.key.level, volume::coarsest_level(share_->lattice.n));
        if (there && !told_.contains(wanted.number)) {
            find_job_ = ++last_job_;
            finding_ = wanted.number;
            effects.jobs.emplace_back(Find{find_job_, wanted.key, block_edge_, side_});
            return;
        }
    }
}

void Leaf::on_found(const Found& found, Effects& effects) {
    if (found.job != find_job_) {
        return;
    }
    for (wire::Message& message :
         wire::functions_messages(finding_, share_->place, found.coarse, found.table)) {
        member_.tell_parent(std::move(message), effects.net);
    }
    if (!found.coarse) {
        told_.insert(finding_);
        find_job_ = 0;
        find_next(effects);
    }
}

void Leaf::stop_finding(Effects& effects) {
    if (find_job_ != 0) {
        effects.jobs.emplace_back(Stop{find_job_});
        find_job_ = 0;
    }
}

void Leaf::forget_functions(Effects& effects) {
    stop_finding(effects);
    told_.clear();
    keep_given({}, effects);
}

}  // namespace shearwater::leaf
