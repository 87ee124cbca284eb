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
// From now on memory that is freed stays here for the next that is asked for, up to a bound: what one frame
// needs the next one does too, and the kernel clears every page that it hands out.
void keep_free_memory();

}  // namespace shearwater::base
