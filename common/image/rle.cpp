#include "common/image/rle.h"

#include <zlib.h>

#include <algorithm>
#include <array>

namespace shearwater::image {

namespace {

// A coded picture is a sequence of
//   0nnnnnnn                     n + 1 pixels follow, 3 bytes each
//   10nnnnnn           r g b     n + 2 times one pixel
//   11nnnnnn nnnnnnnn  r g b     n + 66 times one pixel (the high bits first)
// A run saves at least two bytes and begins at most one more stretch, so runs never make a picture larger
// than plain stretches do: that is the bound.
constexpr std::size_t longest_stretch = 128;
constexpr std::size_t shortest_run = 2;
constexpr std::size_t shortest_long_run = 66;
constexpr std::size_t longest_run = shortest_long_run + 0x3fff;
constexpr std::size_t colour_bytes = 3;

bool same_colour(const Rgba8& a, const Rgba8& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
}

class Writer {
  public:
    explicit Writer(std::span<std::byte> out) : out_(out) {}

    void run(const Rgba8& pixel, std::size_t count) {
        if (count < shortest_long_run) {
            put(0x80 | (count - shortest_run));
        } else {
            put(0xc0 | ((count - shortest_long_run) >> 8));
            put((count - shortest_long_run) & 0xff);
        }
        colour(pixel);
    }

    void stretch(std::span<const Rgba8> pixels) {
        for (std::size_t i = 0; i < pixels.size(); i += longest_stretch) {
            const auto part = pixels.subspan(i, std::min(longest_stretch, pixels.size() - i));
            put(part.size() - 1);
            for (const Rgba8& pixel : part) {
                colour(pixel);
            }
        }
    }

    std::size_t written() const { return at_; }

  private:
    void put(std::size_t value) { out_[at_++] = static_cast<std::byte>(value); }
    void colour(const Rgba8& pixel) {
        put(pixel.r);
        put(pixel.g);
        put(pixel.b);
    }

    std::span<std::byte> out_;
    std::size_t at_ = 0;
};

// How many pixels from `first` on are one colour, at most longest_run.
std::size_t run_length(std::span<const Rgba8> pixels, std::size_t first) {
    const std::size_t end = std::min(pixels.size(), first + longest_run);
    std::size_t i = first + 1;
    while (i < end && same_colour(pixels[i], pixels[first])) {
        ++i;
    }
    return i - first;
}

base::Error broken(std::string detail) {
    return base::error(base::Code::corrupt, "decode picture", std::move(detail));
}

// What one control byte (and the one after, for a long run) announces.
struct Part {
    bool is_run = false;
    std::size_t pixels = 0;
    std::size_t control_bytes = 1;

    std::size_t bytes() const { return control_bytes + colour_bytes * (is_run ? 1 : pixels); }
};

Part part_at(std::span<const std::byte> bytes) {
    const auto control = std::to_integer<std::size_t>(bytes[0]);
    if (control < 0x80) {
        return {false, control + 1, 1};
    }
    if (control < 0xc0) {
        return {true, (control & 0x3f) + shortest_run, 1};
    }
    const std::size_t low = bytes.size() > 1 ? std::to_integer<std::size_t>(bytes[1]) : 0;
    return {true, (((control & 0x3f) << 8) | low) + shortest_long_run, 2};
}

Rgba8 colour_at(std::span<const std::byte> bytes) {
    return {std::to_integer<std::uint8_t>(bytes[0]), std::to_integer<std::uint8_t>(bytes[1]),
            std::to_integer<std::uint8_t>(bytes[2]), 255};
}

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

std::size_t rle_bound(std::size_t pixels) {
    return colour_bytes * pixels + (pixels + longest_stretch - 1) / longest_stretch;
}

std::size_t encode_rle(std::span<const Rgba8> pixels, std::span<std::byte> out) {
    base::check(out.size() >= rle_bound(pixels.size()), "the output holds the bound");
    Writer writer(out);
    std::size_t stretch_begin = 0;
    std::size_t i = 0;
    while (i < pixels.size()) {
        const std::size_t count = run_length(pixels, i);
        if (count >= shortest_run) {
            writer.stretch(pixels.subspan(stretch_begin, i - stretch_begin));
            writer.run(pixels[i], count);
            stretch_begin = i + count;
        }
        i += count;
    }
    writer.stretch(pixels.subspan(stretch_begin));
    return writer.written();
}

base::Status decode_rle(std::span<const std::byte> bytes, std::span<Rgba8> pixels) {
    while (!bytes.empty()) {
        const Part part = part_at(bytes);
        if (part.bytes() > bytes.size()) {
            return broken("the code ends within a part");
        }
        if (part.pixels > pixels.size()) {
            return broken("the code gives more pixels than the picture has");
        }
        const auto colours = bytes.subspan(part.control_bytes);
        if (part.is_run) {
            std::fill_n(pixels.begin(), part.pixels, colour_at(colours));
        } else {
            for (std::size_t i = 0; i < part.pixels; ++i) {
                pixels[i] = colour_at(colours.subspan(i * colour_bytes));
            }
        }
        bytes = bytes.subspan(part.bytes());
        pixels = pixels.subspan(part.pixels);
    }
    if (!pixels.empty()) {
        return broken("the code gives fewer pixels than the picture has");
    }
    return {};
}

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
