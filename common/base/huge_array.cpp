#include "common/base/huge_array.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace shearwater::base {

#ifdef __SANITIZE_ADDRESS__

// The address sanitizer watches the ends of what comes from the heap, and of nothing else.
HugeBytes::HugeBytes(std::size_t bytes) : size_(bytes) {
    if (bytes == 0) {
        return;
    }
    data_ = std::calloc(bytes, 1);
    if (data_ == nullptr) {
        throw std::bad_alloc();
    }
}

HugeBytes::~HugeBytes() {
    std::free(data_);
}

#else

HugeBytes::HugeBytes(std::size_t bytes) : size_(bytes) {
    if (bytes == 0) {
        return;
    }
    void* const mapped = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) {
        throw std::bad_alloc();
    }
    data_ = mapped;
    // Only advice: where it is not taken, pages are small.
    static_cast<void>(madvise(data_, bytes, MADV_HUGEPAGE));
}

HugeBytes::~HugeBytes() {
    if (data_ != nullptr) {
        munmap(data_, size_);
    }
}

#endif

}  // namespace shearwater::base
