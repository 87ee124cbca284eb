#pragma once
// What this process holds, as the kernel counts it.

#include <cstdint>

namespace shearwater::base {

struct MemoryUse {
    std::uint64_t resident = 0;  // bytes
    std::uint64_t peak = 0;
};

MemoryUse memory_use();

// Gives freed memory back to the kernel: after loading, which frees much at once.
void release_free_memory();

}  // namespace shearwater::base
