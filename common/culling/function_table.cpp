#include "common/culling/function_table.h"

#include <algorithm>

namespace shearwater::culling {

FunctionTable finer(const FunctionTable& table, int times) {
    FunctionTable fine{.blocks = table.blocks, .side = table.side * times, .codes = {}};
    const std::size_t count = table.block_count();
    fine.codes.reserve(table.codes.size() * static_cast<std::size_t>(times * times));
    for (int i = 0; i < fine.side; ++i) {
        for (int j = 0; j < fine.side / 2; ++j) {
            const auto cell = static_cast<std::size_t>(i / times * (table.side / 2) + j / times);
            const auto* const from = table.codes.data() + cell * count;
            fine.codes.insert(fine.codes.end(), from, from + count);
        }
    }
    return fine;
}

}  // namespace shearwater::culling
