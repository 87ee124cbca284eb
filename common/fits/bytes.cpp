#include "common/fits/bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/fits/inflater.h"

namespace shearwater::fits {

namespace {

using base::Code;
using std::string_view_literals::operator""sv;

constexpr std::string_view fits_start = "SIMPLE  =";

struct Packing {
    std::string_view magic;
    std::string_view name;
    std::string_view remedy;
};

constexpr std::array<Packing, 6> unsupported_packings = {{
    {"\x1f\x9d"sv, "compress (.Z)", "uncompress"},
    {"\x1f\xa0"sv, "compress (.Z)", "uncompress"},
    {"BZh"sv, "bzip2", "bunzip2"},
    {"\xfd"sv
     "7zXZ"sv,
     "xz", "unxz"},
    {"\x28\xb5\x2f\xfd"sv, "zstd", "unzstd"},
    {"PK\x03\x04"sv, "zip", "unzip"},
}};

base::Error system_error(const std::string& operation, int number) {
    return base::error(number == ENOENT ? Code::not_found : Code::io, operation, std::strerror(number));
}

// As much as half of the machine's memory, and 4 GiB at most.
std::size_t unpack_limit() {
    const auto memory = static_cast<std::size_t>(std::max(1L, sysconf(_SC_PHYS_PAGES))) *
                        static_cast<std::size_t>(std::max(1L, sysconf(_SC_PAGESIZE)));
    return std::min(std::size_t{4} << 30, memory / 2);
}

}  // namespace

Bytes::Bytes(Bytes&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      unpacked_(std::move(other.unpacked_)) {}

Bytes::~Bytes() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

base::Result<Bytes> Bytes::open(const std::string& path, const std::stop_token& stop) {
    const std::string operation = "open " + path;
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0) {
        return system_error(operation, errno);
    }
    if (!S_ISREG(about.st_mode)) {
        return base::error(Code::invalid_argument, operation,
                           S_ISDIR(about.st_mode) ? "is a directory, not a file" : "is not a regular file");
    }
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) {
        return system_error(operation, errno);
    }
    Bytes bytes(descriptor, about.st_size);
    std::array<char, fits_start.size()> first{};
    const auto present = static_cast<std::size_t>(std::min<std::int64_t>(about.st_size, first.size()));
    if (present == 0) {
        return base::error(Code::corrupt, operation, "the file is empty");
    }
    if (!bytes.read(0, std::span(first).first(present))) {
        return system_error(operation, errno);
    }
    const std::string_view start(first.data(), present);
    for (const Packing& packing : unsupported_packings) {
        if (start.starts_with(packing.magic)) {
            return base::error(Code::unsupported, operation,
                               "unsupported compression: packed by " + std::string(packing.name) +
                                   "; unpack it first with " + std::string(packing.remedy));
        }
    }
    if (start.starts_with("\x1f\x8b")) {
        if (base::Status unpacked = bytes.unpack(operation, stop); !unpacked) {
            return unpacked.error();
        }
    } else if (start != fits_start) {
        return base::error(Code::unsupported, operation,
                           "not a FITS file: it does not begin with \"SIMPLE  =\"");
    }
    return bytes;
}

bool Bytes::read(std::int64_t offset, std::span<char> out) const {
    const auto count = static_cast<std::int64_t>(out.size());
    if (offset < 0 || count > size_ || offset > size_ - count) {
        errno = EIO;
        return false;
    }
    if (unpacked_ != nullptr) {
        std::memcpy(out.data(), static_cast<const char*>(unpacked_.get()) + offset, out.size());
        return true;
    }
    std::size_t done = 0;
    while (done < out.size()) {
        const ssize_t got = ::pread(descriptor_, out.data() + done, out.size() - done,
                                    static_cast<off_t>(offset) + static_cast<off_t>(done));
        if (got <= 0) {
            errno = got == 0 ? EIO : errno;
            return false;
        }
        done += static_cast<std::size_t>(got);
    }
    return true;
}

bool Bytes::resize(Memory& memory, std::size_t size) {
    void* const resized = std::realloc(memory.get(), size);
    if (resized == nullptr) {
        return false;
    }
    static_cast<void>(memory.release());
    memory.reset(resized);
    return true;
}

base::Status Bytes::pad(std::int64_t size, const std::string& operation) {
    const auto wanted = static_cast<std::size_t>(size);
    const auto present = static_cast<std::size_t>(size_);
    base::check(size > size_, "there is something to pad");
    if (wanted > unpack_limit()) {
        return base::error(Code::corrupt, operation,
                           "the file is cut off: " + std::to_string(wanted - present) +
                               " bytes of its last block are missing");
    }
    const bool on_disk = unpacked_ == nullptr;
    Memory memory = std::move(unpacked_);
    if (!resize(memory, wanted)) {
        return base::error(Code::too_large, operation, "no memory to hold it");
    }
    auto* const first = static_cast<char*>(memory.get());
    if (on_disk && !read(0, std::span(first, present))) {
        return system_error(operation, errno);
    }
    std::memset(first + present, 0, wanted - present);
    unpacked_ = std::move(memory);
    size_ = size;
    return {};
}

base::Status Bytes::unpack(const std::string& operation, const std::stop_token& stop) {
    constexpr std::size_t most_at_once = std::size_t{16} << 20;  // so that a request to stop is soon heard
    const std::size_t limit = unpack_limit();
    Inflater inflater;
    std::vector<char> packed(std::size_t{1} << 18);
    std::size_t capacity = std::size_t{1} << 20;
    std::size_t filled = 0;
    Memory memory(std::malloc(capacity));
    if (!inflater.ready() || memory == nullptr) {
        return base::error(Code::io, operation, "no memory to unpack it");
    }
    z_stream& stream = inflater.stream;
    std::int64_t taken = 0;
    bool ended = false;
    while (true) {
        if (stop.stop_requested()) {
            return base::error(Code::cancelled, operation, "stopped");
        }
        if (stream.avail_in == 0) {
            const auto count = static_cast<std::size_t>(
                std::min<std::int64_t>(size_ - taken, static_cast<std::int64_t>(packed.size())));
            if (count == 0) {
                break;
            }
            if (!read(taken, std::span(packed).first(count))) {
                return system_error(operation, errno);
            }
            taken += static_cast<std::int64_t>(count);
            stream.next_in = reinterpret_cast<Bytef*>(packed.data());
            stream.avail_in = static_cast<uInt>(count);
        }
        if (ended) {  // what follows is another member, or padding
            if (*stream.next_in != 0x1f) {
                break;
            }
            inflateReset(&stream);
            ended = false;
        }
        if (filled == capacity) {
            if (capacity >= limit) {
                return base::error(Code::too_large, operation,
                                   "unpacks to more than " + std::to_string(limit >> 20) +
                                       " MiB; unpack it first with gunzip");
            }
            capacity = std::min(capacity * 2, limit);
            if (!resize(memory, capacity)) {
                return base::error(Code::too_large, operation, "no memory to unpack it");
            }
        }
        const auto room = static_cast<uInt>(std::min(capacity - filled, most_at_once));
        stream.next_out = static_cast<Bytef*>(memory.get()) + filled;
        stream.avail_out = room;
        const int outcome = inflate(&stream, Z_NO_FLUSH);
        filled += room - stream.avail_out;
        if (outcome != Z_OK && outcome != Z_STREAM_END && outcome != Z_BUF_ERROR) {
            return base::error(
                Code::corrupt, operation,
                "the gzip stream is damaged after " + std::to_string(filled) + " unpacked bytes");
        }
        ended = outcome == Z_STREAM_END;
        if (filled >= fits_start.size() &&
            std::memcmp(memory.get(), fits_start.data(), fits_start.size()) != 0) {
            return base::error(Code::unsupported, operation, "not a FITS file inside the gzip stream");
        }
    }
    if (!ended) {
        return base::error(Code::corrupt, operation,
                           "the gzip stream is cut off after " + std::to_string(filled) + " unpacked bytes");
    }
    if (filled < fits_start.size()) {
        return base::error(Code::unsupported, operation, "not a FITS file inside the gzip stream");
    }
    unpacked_ = std::move(memory);
    size_ = static_cast<std::int64_t>(filled);
    return {};
}

}  // namespace shearwater::fits
