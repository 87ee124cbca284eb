#include "common/fits/tile_guard.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "common/fits/inflater.h"
#include "common/fits/tiles.h"

namespace shearwater::fits {

namespace {

template <class Integer>
std::int64_t big_endian(const char* bytes) {
    std::make_unsigned_t<Integer> value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
        value =
            static_cast<std::make_unsigned_t<Integer>>(value << 8U) | static_cast<unsigned char>(bytes[i]);
    }
    return static_cast<Integer>(value);
}

struct Array {
    std::int64_t elements, offset;
};

Array array_at(const char* descriptor, bool wide) {
    if (wide) {
        return {big_endian<std::int64_t>(descriptor), big_endian<std::int64_t>(descriptor + 8)};
    }
    return {big_endian<std::int32_t>(descriptor), big_endian<std::int32_t>(descriptor + 4)};
}

// The stream ends where its bytes do at the latest, and gives 1, 2, 4 or 8 bytes for a pixel.
bool gzip_holds(std::span<char> stream, std::int64_t pixels) {
    Inflater inflater;
    std::array<unsigned char, 1 << 15> out;
    inflater.stream.next_in = reinterpret_cast<Bytef*>(stream.data());
    inflater.stream.avail_in = static_cast<uInt>(stream.size());
    std::int64_t bytes = 0;
    int outcome = inflater.ready() ? Z_OK : Z_MEM_ERROR;
    while (outcome == Z_OK && bytes <= 8 * pixels) {
        inflater.stream.next_out = out.data();
        inflater.stream.avail_out = static_cast<uInt>(out.size());
        outcome = inflate(&inflater.stream, Z_NO_FLUSH);
        bytes += static_cast<std::int64_t>(out.size() - inflater.stream.avail_out);
    }
    return outcome == Z_STREAM_END &&
           (bytes == pixels || bytes == 2 * pixels || bytes == 4 * pixels || bytes == 8 * pixels);
}

// An HCOMPRESS stream begins with 2 bytes of magic, two lengths, a scale, a sum, and how many bits its
// three quadrants have.
bool hcompress_holds(std::span<const char> stream, std::int64_t pixels) {
    constexpr std::size_t start = 2 + 4 + 4 + 4 + 8 + 3;
    if (stream.size() < start) {
        return false;
    }
    const std::int64_t nx = big_endian<std::int32_t>(stream.data() + 2);
    const std::int64_t ny = big_endian<std::int32_t>(stream.data() + 6);
    const auto bits = stream.subspan(22, 3);
    return nx > 0 && ny > 0 && nx * ny <= pixels &&
           std::all_of(bits.begin(), bits.end(), [](char c) { return c >= 0 && c < 64; });
}

// A PLIO line list has its length in its third word, or in its fourth and fifth.
bool plio_holds(std::span<const char> stream) {
    constexpr std::size_t start = 10;
    if (stream.size() < start) {
        return false;
    }
    const auto word = [&](std::size_t i) { return big_endian<std::int16_t>(stream.data() + 2 * i); };
    const std::int64_t length = word(2) > 0 ? word(2) : word(4) * 32768 + word(3);
    return length >= 0 && word(1) >= 0 && 2 * length <= static_cast<std::int64_t>(stream.size());
}

}  // namespace

TileGuard::TileGuard(const Hdu& hdu, std::vector<ArrayColumn> columns)
    : axes_(hdu.axes), steps_(tile_lengths(hdu)), columns_(std::move(columns)) {
    const Table table = table_of(hdu);
    rows_offset_ = hdu.header.data_offset();
    row_bytes_ = table.row_bytes;
    heap_offset_ = table.heap_offset;
    heap_bytes_ = table.heap_bytes;
    checked_.resize(static_cast<std::size_t>(table.rows), false);
}

// Fewer at the upper edges. Tiles are counted as pixels are, along axis 1 first.
std::int64_t TileGuard::pixels_of(std::int64_t tile) const {
    std::int64_t pixels = 1;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const std::int64_t tiles = (axes_[i] + steps_[i] - 1) / steps_[i];
        pixels *= std::min(steps_[i], axes_[i] - tile % tiles * steps_[i]);
        tile /= tiles;
    }
    return pixels;
}

std::optional<std::string> TileGuard::fault(const Bytes& bytes, std::int64_t tile) const {
    const std::int64_t pixels = pixels_of(tile);
    std::vector<char> stream;
    for (const ArrayColumn& column : columns_) {
        std::array<char, 16> descriptor{};
        const auto used = std::span(descriptor).first(column.wide ? 16 : 8);
        if (!bytes.read(rows_offset_ + tile * row_bytes_ + column.offset, used)) {
            return "cannot be read";
        }
        const Array array = array_at(descriptor.data(), column.wide);
        if (array.elements < 0 || array.offset < 0 || array.offset > heap_bytes_ ||
            array.elements > (heap_bytes_ - array.offset) / column.element_bytes) {
            return "lies outside the data";
        }
        // A compressed tile is never much larger than the pixels themselves.
        if (array.elements > (16 * pixels + 4096) / column.element_bytes) {
            return "has more compressed bytes than pixels could need";
        }
        if (array.elements == 0 || column.stream == ArrayColumn::Stream::other) {
            continue;
        }
        stream.resize(static_cast<std::size_t>(array.elements * column.element_bytes));
        if (!bytes.read(heap_offset_ + array.offset, stream)) {
            return "cannot be read";
        }
        const bool holds = column.stream == ArrayColumn::Stream::gzip        ? gzip_holds(stream, pixels)
                           : column.stream == ArrayColumn::Stream::hcompress ? hcompress_holds(stream, pixels)
                                                                             : plio_holds(stream);
        if (!holds) {
            return "is damaged";
        }
    }
    return std::nullopt;
}

base::Status TileGuard::check(const Bytes& bytes, std::span<const long> first, std::span<const long> last,
                              const std::string& operation) {
    std::vector<std::int64_t> at(axes_.size());
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        at[i] = (first[i] - 1) / steps_[i];
    }
    while (true) {
        std::int64_t tile = 0;
        for (std::size_t i = axes_.size(); i-- > 0;) {
            tile = tile * ((axes_[i] + steps_[i] - 1) / steps_[i]) + at[i];
        }
        if (!checked_[static_cast<std::size_t>(tile)]) {
            if (const auto found = fault(bytes, tile)) {
                return base::error(base::Code::corrupt, operation,
                                   "tile " + std::to_string(tile) + " " + *found);
            }
            checked_[static_cast<std::size_t>(tile)] = true;
        }
        std::size_t axis = 0;  // the next tile, as an odometer counts
        while (axis < at.size() && ++at[axis] > (last[axis] - 1) / steps_[axis]) {
            at[axis] = (first[axis] - 1) / steps_[axis];
            ++axis;
        }
        if (axis == at.size()) {
            return {};
        }
    }
}

}  // namespace shearwater::fits
