#include <zlib.h>

#include <algorithm>
#include <array>

#include "common/image/rle.h"

namespace shearwater::image {

namespace {

// zlib counts input in 32 bits: hands it over piece by piece.
void feed(z_stream& stream, std::span<const std::byte>& rest) {
    constexpr std::size_t piece = std::size_t{1} << 30;
    if (stream.avail_in == 0 && !rest.empty()) {
        const std::size_t take = std::min(piece, rest.size());
        stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(rest.data()));
        stream.avail_in = static_cast<uInt>(take);
        rest = rest.subspan(take);
    }
}

struct Inflater {
    z_stream stream{};
    bool ready = inflateInit(&stream) == Z_OK;

    Inflater() = default;
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;
    ~Inflater() {
        if (ready) {
            inflateEnd(&stream);
        }
    }
};

}  // namespace

std::vector<std::byte> deflate(std::span<const std::byte> bytes, int level) {
    uLongf size = compressBound(bytes.size());
    std::vector<std::byte> out(size);
    const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                                 reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level);
    base::check(status == Z_OK, "deflate has the room and the level it needs");
    out.resize(size);
    return out;
}

base::Result<std::vector<std::byte>> inflate(std::span<const std::byte> bytes, std::size_t limit) {
    const auto fault = [](base::Code code, const char* detail) {
        return base::error(code, "inflate", detail);
    };
    Inflater inflater;
    if (!inflater.ready) {
        return fault(base::Code::io, "out of memory");
    }
    z_stream& stream = inflater.stream;
    std::vector<std::byte> out;
    std::array<std::byte, std::size_t{1} << 16> piece;
    int status = Z_OK;
    while (status != Z_STREAM_END) {
        feed(stream, bytes);
        stream.next_out = reinterpret_cast<Bytef*>(piece.data());
        stream.avail_out = static_cast<uInt>(piece.size());
        status = ::inflate(&stream, Z_NO_FLUSH);
        const std::size_t got = piece.size() - stream.avail_out;
        if (got > limit - out.size()) {
            return fault(base::Code::too_large, "more bytes than the picture can have");
        }
        out.insert(out.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(got));
        if (status == Z_BUF_ERROR) {
            return fault(base::Code::corrupt, "the stream is cut off");
        }
        if (status != Z_OK && status != Z_STREAM_END) {
            return fault(base::Code::corrupt, "the stream is broken");
        }
    }
    if (stream.avail_in > 0 || !bytes.empty()) {
        return fault(base::Code::corrupt, "bytes follow the stream");
    }
    return out;
}

}  // namespace shearwater::image
