#include "common/fits/tiles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace shearwater::fits {

namespace {

using base::Code;

constexpr std::int64_t most_axes = 6;  // cfitsio's own limit for compressed images
constexpr std::int64_t most_tile_pixels = std::int64_t{1} << 27;
constexpr std::int64_t most_row_bytes = std::int64_t{1} << 20;
constexpr std::int64_t most_columns = 999;
constexpr std::array<std::string_view, 7> codecs = {"RICE_1", "RICE_ONE",    "GZIP_1",    "GZIP_2",
                                                    "PLIO_1", "HCOMPRESS_1", "NOCOMPRESS"};

base::Error corrupt(const Hdu& hdu, const std::string& operation, const std::string& detail) {
    return base::error(Code::corrupt, operation, "HDU " + std::to_string(hdu.number) + ": " + detail);
}

std::int64_t tile_length(const Hdu& hdu, int axis) {
    const std::int64_t usual = axis == 1 ? hdu.axes[0] : 1;
    return hdu.header.integer("ZTILE", axis).value_or(usual);
}

// The pixels of the tile with the given number, fewer at the upper edges. Tiles count as pixels do.
std::int64_t tile_pixels(const std::vector<std::int64_t>& axes, const std::vector<std::int64_t>& steps,
                         std::int64_t number) {
    std::int64_t pixels = 1;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const std::int64_t tiles = (axes[i] + steps[i] - 1) / steps[i];
        pixels *= std::min(steps[i], axes[i] - number % tiles * steps[i]);
        number /= tiles;
    }
    return pixels;
}

// How many bytes one compressed byte can stand for at most. Deflate ends at 1032; the quadtrees and
// run lengths of the other two reach far more on empty sky.
std::int64_t best_ratio(std::string_view codec) {
    return codec == "HCOMPRESS_1" || codec == "PLIO_1" ? 20000 : 1100;
}

// A column of variable-length arrays: its place in the row, and the bytes of an element.
struct ArrayColumn {
    std::int64_t offset;
    bool wide;  // 64-bit descriptors
    std::int64_t element_bytes;
    bool compressed_data;
};

std::int64_t element_bytes(char type) {
    switch (type) {
        case 'L':
        case 'B':
        case 'A':
            return 1;
        case 'I':
            return 2;
        case 'J':
        case 'E':
            return 4;
        case 'K':
        case 'D':
        case 'C':
            return 8;
        case 'M':
        case 'P':
        case 'Q':
            return type == 'P' ? 8 : 16;
        default:
            return -1;
    }
}

// The columns of variable-length arrays; empty where a TFORM makes no sense or they outgrow the row.
std::vector<ArrayColumn> array_columns(const Header& header, std::int64_t row_bytes) {
    std::vector<ArrayColumn> columns;
    const std::int64_t fields =
        std::clamp<std::int64_t>(header.integer("TFIELDS").value_or(0), 0, most_columns);
    std::int64_t offset = 0;
    for (int field = 1; field <= fields; ++field) {
        const std::string form = header.text("TFORM", field).value_or("");
        std::int64_t repeat = 1;
        const auto [type, fault] = std::from_chars(form.data(), form.data() + form.size(), repeat);
        const bool counted = fault == std::errc{};
        const std::size_t at = counted ? static_cast<std::size_t>(type - form.data()) : 0;
        const char kind = at < form.size() ? form[at] : '\0';
        std::int64_t bytes = element_bytes(kind);
        if (kind == 'X') {
            bytes = 1;
            repeat = (repeat + 7) / 8;
        }
        if (bytes < 0 || repeat < 0 || repeat > row_bytes / bytes) {
            return {};
        }
        if ((kind == 'P' || kind == 'Q') && repeat > 0) {
            const char element = at + 1 < form.size() ? form[at + 1] : '\0';
            columns.push_back({offset, kind == 'Q', element_bytes(element),
                               header.text("TTYPE", field).value_or("") == "COMPRESSED_DATA"});
        }
        offset += repeat * bytes;
        if (offset > row_bytes || (!columns.empty() && columns.back().element_bytes < 0)) {
            return {};
        }
    }
    return columns;
}

template <class Integer>
Integer big_endian(const char* bytes) {
    std::make_unsigned_t<Integer> value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
        value =
            static_cast<std::make_unsigned_t<Integer>>(value << 8U) | static_cast<unsigned char>(bytes[i]);
    }
    return static_cast<Integer>(value);
}

struct Descriptor {
    std::int64_t elements;
    std::int64_t offset;
};

Descriptor descriptor_at(const char* bytes, bool wide) {
    if (wide) {
        return {big_endian<std::int64_t>(bytes), big_endian<std::int64_t>(bytes + 8)};
    }
    return {big_endian<std::int32_t>(bytes), big_endian<std::int32_t>(bytes + 4)};
}

// The table and its heap.
struct Table {
    std::int64_t rows, row_bytes, heap_offset, heap_bytes;
};

Table table_of(const Hdu& hdu) {
    const std::int64_t row_bytes = hdu.header.integer("NAXIS1").value_or(0);
    const std::int64_t rows = hdu.header.integer("NAXIS2").value_or(0);
    const std::int64_t gap = hdu.header.integer("THEAP").value_or(row_bytes * rows);
    if (gap < 0 || gap > hdu.data_bytes) {
        return {rows, row_bytes, hdu.header.data_offset(), -1};
    }
    return {rows, row_bytes, hdu.header.data_offset() + gap, hdu.data_bytes - gap};
}

// An HCOMPRESS stream begins with 2 bytes of magic and its own two lengths, by which it is decoded.
bool hcompress_fits(const Bytes& bytes, std::int64_t offset, std::int64_t stream_bytes, std::int64_t pixels) {
    std::array<char, 10> start{};
    if (stream_bytes < static_cast<std::int64_t>(start.size()) || !bytes.read(offset, start)) {
        return false;
    }
    const std::int64_t nx = big_endian<std::int32_t>(start.data() + 2);
    const std::int64_t ny = big_endian<std::int32_t>(start.data() + 6);
    return nx > 0 && ny > 0 && nx * ny <= pixels;
}

struct TileCheck {
    const Bytes& bytes;
    const Table& table;
    const std::vector<std::int64_t>& axes;
    std::vector<std::int64_t> steps;
    bool hcompress;

    std::optional<std::string> fault(std::int64_t tile, const ArrayColumn& column,
                                     const Descriptor& array) const {
        if (array.elements < 0 || array.offset < 0 || array.offset > table.heap_bytes ||
            array.elements > (table.heap_bytes - array.offset) / column.element_bytes) {
            return " lies outside the data";
        }
        if (hcompress && column.compressed_data && array.elements != 0 &&
            !hcompress_fits(bytes, table.heap_offset + array.offset, array.elements,
                            tile_pixels(axes, steps, tile))) {
            return " is compressed from another shape";
        }
        return std::nullopt;
    }
};

}  // namespace

base::Status read_compressed_shape(Hdu& hdu, const std::string& operation) {
    const Header& header = hdu.header;
    const std::string codec = header.text("ZCMPTYPE").value_or("");
    if (std::find(codecs.begin(), codecs.end(), codec) == codecs.end()) {
        return base::error(Code::unsupported, operation,
                           "HDU " + std::to_string(hdu.number) + ": unsupported compression \"" +
                               base::printable(codec, 20) + "\"");
    }
    const auto bitpix = header.integer("ZBITPIX").value_or(0);
    constexpr std::array<std::int64_t, 6> bitpixes = {8, 16, 32, 64, -32, -64};
    const auto count = header.integer("ZNAXIS").value_or(-1);
    if (std::find(bitpixes.begin(), bitpixes.end(), bitpix) == bitpixes.end() || count < 1 ||
        count > most_axes) {
        return corrupt(hdu, operation, "ZBITPIX or ZNAXIS of the compressed image is missing or impossible");
    }
    if (hdu.bitpix != 8 || hdu.axes.size() != 2 || hdu.axes[0] < 1 || hdu.axes[0] > most_row_bytes) {
        return corrupt(hdu, operation, "the table of the compressed image has an impossible shape");
    }
    hdu.axes.clear();
    std::int64_t pixels = 1;
    std::int64_t tiles = 1;
    std::int64_t tile = 1;
    for (int axis = 1; axis <= count; ++axis) {
        const std::int64_t length = header.integer("ZNAXIS", axis).value_or(-1);
        if (length < 1 || __builtin_mul_overflow(pixels, length, &pixels)) {
            return corrupt(hdu, operation, "ZNAXIS" + std::to_string(axis) + " is missing or impossible");
        }
        hdu.axes.push_back(length);
        const std::int64_t step = tile_length(hdu, axis);
        if (step < 1 || step > most_tile_pixels / tile) {
            return corrupt(hdu, operation,
                           "ZTILE" + std::to_string(axis) + " is " + std::to_string(step) +
                               ": no possible size of a tile");
        }
        tile *= step;
        tiles *= (length + step - 1) / step;
    }
    hdu.bitpix = static_cast<int>(bitpix);
    const Table table = table_of(hdu);
    if (tiles != table.rows) {
        return corrupt(hdu, operation,
                       "the image has " + std::to_string(tiles) + " tiles, its table " +
                           std::to_string(table.rows) + " rows");
    }
    const std::int64_t pixel_bytes = std::abs(hdu.bitpix) / 8;
    if (pixels / best_ratio(codec) > hdu.data_bytes / pixel_bytes) {
        return corrupt(
            hdu, operation,
            std::to_string(hdu.data_bytes) + " compressed bytes cannot hold " + hdu.shape() + " values");
    }
    return {};
}

base::Status check_tiles(const Hdu& hdu, const Bytes& bytes, const std::string& operation) {
    const Table table = table_of(hdu);
    const auto columns = array_columns(hdu.header, table.row_bytes);
    if (columns.empty() || table.heap_bytes < 0) {
        return corrupt(hdu, operation, "the columns of the compressed image make no sense");
    }
    TileCheck check{.bytes = bytes, .table = table, .axes = hdu.axes, .steps = {}, .hcompress = false};
    check.hcompress = hdu.header.text("ZCMPTYPE").value_or("") == "HCOMPRESS_1";
    for (int axis = 1; axis <= static_cast<int>(hdu.axes.size()); ++axis) {
        check.steps.push_back(tile_length(hdu, axis));
    }
    const std::int64_t rows_at_once = most_row_bytes / table.row_bytes;
    std::vector<char> rows(static_cast<std::size_t>(std::min(rows_at_once, table.rows) * table.row_bytes));
    for (std::int64_t row = 0; row < table.rows; ++row) {
        const std::int64_t in_part = row % rows_at_once;
        if (in_part == 0) {
            const std::int64_t count = std::min(rows_at_once, table.rows - row);
            const auto part = std::span(rows).first(static_cast<std::size_t>(count * table.row_bytes));
            if (!bytes.read(hdu.header.data_offset() + row * table.row_bytes, part)) {
                return base::error(Code::io, operation, "the table of tiles cannot be read");
            }
        }
        for (const ArrayColumn& column : columns) {
            const char* const at = rows.data() + in_part * table.row_bytes + column.offset;
            if (const auto fault = check.fault(row, column, descriptor_at(at, column.wide))) {
                return corrupt(hdu, operation, "tile " + std::to_string(row) + *fault);
            }
        }
    }
    return {};
}

}  // namespace shearwater::fits
