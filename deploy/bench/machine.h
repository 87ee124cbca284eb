#pragma once
// What the figures were measured on.

#include <cstdint>
#include <string>

#include "common/base/result.h"

namespace shearwater::bench {

struct Machine {
    std::string cpu;
    int cores = 0;
    std::uint64_t memory_bytes = 0;
    std::string simd;  // the best of Highway's targets that the processor has
    std::string version;
};

Machine this_machine();

std::string to_line(const Machine& machine);
std::string to_json(const Machine& machine);

// Refuses what would not fit into this machine's memory, before the kernel ends us for it.
base::Status check_memory(const std::string& operation, std::uint64_t bytes);

}  // namespace shearwater::bench
