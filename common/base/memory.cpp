#include "common/base/memory.h"

#include <malloc.h>

#include <fstream>
#include <sstream>
#include <string>

namespace shearwater::base {

MemoryUse memory_use() {
    MemoryUse use;
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        std::istringstream words(line);
        std::string key;
        std::uint64_t kib = 0;
        words >> key >> kib;
        if (key == "VmRSS:") {
            use.resident = kib * 1024;
        } else if (key == "VmHWM:") {
            use.peak = kib * 1024;
        }
    }
    return use;
}

void release_free_memory() {
    malloc_trim(0);
}

}  // namespace shearwater::base
