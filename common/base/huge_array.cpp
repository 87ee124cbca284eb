#include "common/base/huge_array.h"

#include <sys/mman.h>

#include <new>

namespace shearwater::base {

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

}  // namespace shearwater::base
