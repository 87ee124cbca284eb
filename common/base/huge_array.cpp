#include "common/base/huge_array.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <new>

#include "common/base/check.h"

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

void HugeBytes::shrink(std::size_t bytes) {
    check(0 < bytes && bytes <= size_, "memory shrinks to a part of it");
    void* const shrunk = std::realloc(data_, bytes);
    if (shrunk != nullptr) {
        data_ = shrunk;
    }
    size_ = bytes;
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

void HugeBytes::shrink(std::size_t bytes) {
    check(0 < bytes && bytes <= size_, "memory shrinks to a part of it");
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const auto pages = [page](std::size_t size) { return (size + page - 1) / page * page; };
    if (pages(bytes) < pages(size_)) {
        munmap(static_cast<std::byte*>(data_) + pages(bytes), pages(size_) - pages(bytes));
    }
    size_ = bytes;
}

#endif

}  // namespace shearwater::base
