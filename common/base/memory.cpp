#include "common/base/memory.h"

#include <malloc.h>
#include <sys/mman.h>

#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace shearwater::base {

namespace {

// The number of kibibytes behind a key of /proc/self/status, in bytes; 0 where there is none.
std::uint64_t bytes_of(std::string_view status, std::string_view key) {
    const std::size_t at = status.find(key);
    return at == std::string_view::npos
               ? 0
               : std::uint64_t{1024} * std::strtoull(status.data() + at + key.size(), nullptr, 10);
}

}  // namespace

MemoryUse memory_use() {
    std::array<char, 8192> text{};
    std::FILE* const file = std::fopen("/proc/self/status", "r");
    if (file == nullptr) {
        return {};
    }
    const std::size_t size = std::fread(text.data(), 1, text.size() - 1, file);
    std::fclose(file);
    const std::string_view status(text.data(), size);
    return {.resident = bytes_of(status, "VmRSS:"), .peak = bytes_of(status, "VmHWM:")};
}

void release_free_memory() {
    malloc_trim(0);
}

void prefer_huge_pages(std::span<std::byte> memory) {
    constexpr std::size_t huge = std::size_t{2} << 20;
    const auto begin = std::bit_cast<std::uintptr_t>(memory.data());
    const std::size_t before = (huge - begin % huge) % huge;
    if (memory.size() < before + huge) {
        return;
    }
    const auto whole = memory.subspan(before);
    static_cast<void>(madvise(whole.data(), whole.size() / huge * huge, MADV_HUGEPAGE));
}

void keep_free_memory() {
    constexpr int largest = 32 << 20;  // that malloc does not map by itself; it takes no more
    constexpr int kept = 256 << 20;    // at the end of a heap
    mallopt(M_MMAP_THRESHOLD, largest);
    mallopt(M_TRIM_THRESHOLD, kept);
}

}  // namespace shearwater::base
