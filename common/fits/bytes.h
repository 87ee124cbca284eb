#pragma once
// The bytes of a FITS file: as they lie on disk, or unpacked from gzip into memory.

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <stop_token>
#include <string>

#include "common/base/result.h"

namespace shearwater::fits {

class Bytes {
  public:
    // Refuses what is not a regular file, what is packed by anything but gzip, and what does not begin
    // as FITS does. A gzip stream is unpacked to its end, growing with what it really holds up to a
    // limit, so that one that is cut off, damaged or absurd is refused here.
    static base::Result<Bytes> open(const std::string& path, const std::stop_token& stop = {});

    Bytes(Bytes&& other) noexcept;
    Bytes& operator=(Bytes&&) = delete;
    ~Bytes();

    std::int64_t size() const { return size_; }

    // Fills `out` from `offset` on; false where the file ends too soon or cannot be read. Any
    // number of threads may read at once.
    bool read(std::int64_t offset, std::span<char> out) const;

    // Holds the bytes in memory, with zeros behind them up to `size`: for a file whose last block was not
    // filled up, where cfitsio reads whole blocks only. An error where that is more than the limit.
    base::Status pad(std::int64_t size, const std::string& operation);

    // Where the unpacked or padded bytes are; null for those on disk.
    void* unpacked() const { return unpacked_.get(); }

  private:
    struct Free {
        void operator()(void* memory) const { std::free(memory); }
    };
    using Memory = std::unique_ptr<void, Free>;

    static bool resize(Memory& memory, std::size_t size);

    explicit Bytes(int descriptor, std::int64_t size) : descriptor_(descriptor), size_(size) {}
    base::Status unpack(const std::string& operation, const std::stop_token& stop);

    int descriptor_;
    std::int64_t size_;
    Memory unpacked_;
};

}  // namespace shearwater::fits
