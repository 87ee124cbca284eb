#include "renderer/leaf/given_functions.h"

#include <algorithm>

namespace shearwater::leaf {

bool GivenFunctions::take(const wire::GivenFunctions& given) {
    const wire::FunctionPart& part = given.part;
    if (part.first_direction == 0) {
        std::erase_if(taken_, [&](const auto& taken) { return taken.second.key == given.key; });
        if (taken_.size() >= most) {
            return false;
        }
        taken_[part.number] = {given.key, 0, culling::DirectionGrid(part.side).cells()};
    }
    const auto found = taken_.find(part.number);
    if (found == taken_.end() || found->second.key != given.key ||
        found->second.directions != part.first_direction) {
        return false;
    }
    found->second.directions += part.directions;
    return true;
}

bool GivenFunctions::has(std::span<const std::uint64_t> numbers) const {
    return std::ranges::all_of(numbers, [&](std::uint64_t number) {
        const auto found = taken_.find(number);
        return found != taken_.end() && found->second.directions == found->second.all;
    });
}

std::vector<culling::FunctionKey> GivenFunctions::keep(std::span<const std::uint64_t> numbers) {
    std::vector<culling::FunctionKey> dropped;
    std::erase_if(taken_, [&](const auto& taken) {
        const bool kept = std::ranges::find(numbers, taken.first) != numbers.end();
        if (!kept) {
            dropped.push_back(taken.second.key);
        }
        return !kept;
    });
    return dropped;
}

}  // namespace shearwater::leaf
