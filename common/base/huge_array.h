#pragma once
// Memory for gigabytes that are walked along every axis: in huge pages where the system gives them, so that
// addresses are found without a table walk for every row.

#include <cstddef>
#include <utility>

namespace shearwater::base {

// `bytes` zeroed bytes, or std::bad_alloc; they are only taken once they are touched.
class HugeBytes {
  public:
    HugeBytes() = default;
    explicit HugeBytes(std::size_t bytes);
    ~HugeBytes();
    HugeBytes(HugeBytes&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    HugeBytes& operator=(HugeBytes&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }
    HugeBytes(const HugeBytes&) = delete;
    HugeBytes& operator=(const HugeBytes&) = delete;

    void* data() const { return data_; }
    std::size_t size() const { return size_; }

  private:
    void* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace shearwater::base
