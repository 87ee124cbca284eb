#include "common/fits/tile_guard.h"

#include <algorithm>
#include <array>

#include "common/fits/big_endian.h"
#include "common/fits/streams.h"
#include "common/fits/tiles.h"

namespace shearwater::fits {

namespace {

struct Array {
    std::int64_t elements, offset;
};

Array array_at(const char* descriptor, bool wide) {
    if (wide) {
        return {big_endian<std::int64_t>(descriptor), big_endian<std::int64_t>(descriptor + 8)};
    }
    return {big_endian<std::int32_t>(descriptor), big_endian<std::int32_t>(descriptor + 4)};
}

}  // namespace

TileGuard::TileGuard(const Hdu& hdu, std::vector<ArrayColumn> columns)
    : axes_(hdu.axes),
      steps_(tile_lengths(hdu)),
      columns_(std::move(columns)),
      rice_(rice_parameters(hdu.header)) {
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

bool TileGuard::stream_holds(ArrayColumn::Stream kind, std::span<char> stream, std::int64_t pixels) const {
    switch (kind) {
        case ArrayColumn::Stream::gzip:
            return gzip_holds(stream, pixels);
        case ArrayColumn::Stream::rice:
            return rice_holds(stream, pixels, rice_.pixel_bytes, rice_.block);
        case ArrayColumn::Stream::hcompress:
            return hcompress_holds(stream, pixels);
        case ArrayColumn::Stream::plio:
            return plio_holds(stream);
        case ArrayColumn::Stream::other:
            break;
    }
    return true;
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
        const bool holds = stream_holds(column.stream, stream, pixels);
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
