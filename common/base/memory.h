#pragma once
// What this process holds, as the kernel counts it.

#include <cstddef>
#include <cstdint>
#include <span>

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
// Advises the kernel to put what is written to next on huge pages, as far as whole ones lie in it.
void prefer_huge_pages(std::span<std::byte> memory);

}  // namespace shearwater::base
