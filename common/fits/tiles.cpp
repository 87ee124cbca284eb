#include "common/fits/tiles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace shearwater::fits {

namespace {

using base::Code;

constexpr std::int64_t most_axes = 6;  // cfitsio's own limit for compressed images
constexpr std::int64_t most_tile_pixels = std::int64_t{1} << 27;
constexpr std::int64_t most_row_bytes = std::int64_t{1} << 20;
constexpr std::int64_t most_columns = 999;
constexpr std::array<std::string_view, 6> codecs = {"RICE_1", "RICE_ONE", "GZIP_1",
                                                    "GZIP_2", "PLIO_1",   "HCOMPRESS_1"};

base::Error corrupt(const Hdu& hdu, const std::string& operation, const std::string& detail) {
    return base::error(Code::corrupt, operation, "HDU " + std::to_string(hdu.number) + ": " + detail);
}

std::int64_t tile_length(const Hdu& hdu, int axis) {
    const std::string keyword = "ZTILE" + std::to_string(axis);
    const std::int64_t usual = axis == 1 ? hdu.axes[0] : 1;
    return hdu.header.has(keyword) ? hdu.header.integer(keyword).value_or(0) : usual;
}

// How many bytes one compressed byte can stand for at most. Deflate ends at 1032; the quadtrees and
// run lengths of the other two reach far more on empty sky.
std::int64_t best_ratio(std::string_view codec) {
    return codec == "HCOMPRESS_1" || codec == "PLIO_1" ? 20000 : 1100;
}

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

ArrayColumn::Stream stream_of(const Header& header, int field) {
    const std::string column = header.text("TTYPE", field).value_or("");
    const std::string codec = header.text("ZCMPTYPE").value_or("");
    if (column == "GZIP_COMPRESSED_DATA" || (column == "COMPRESSED_DATA" && codec.starts_with("GZIP"))) {
        return ArrayColumn::Stream::gzip;
    }
    if (column != "COMPRESSED_DATA") {
        return ArrayColumn::Stream::other;
    }
    if (codec.starts_with("RICE")) {
        return ArrayColumn::Stream::rice;
    }
    return codec == "PLIO_1" ? ArrayColumn::Stream::plio : ArrayColumn::Stream::hcompress;
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
            columns.push_back({offset, kind == 'Q', element_bytes(element), stream_of(header, field)});
        }
        offset += repeat * bytes;
        if (offset > row_bytes || (!columns.empty() && columns.back().element_bytes < 0)) {
            return {};
        }
    }
    return columns;
}

}  // namespace

RiceParameters rice_parameters(const Header& header) {
    const auto value = [&](const char* keyword, int usual) {
        return header.has(keyword)
                   ? static_cast<int>(std::clamp<std::int64_t>(header.integer(keyword).value_or(0), 0, 99))
                   : usual;
    };
    return {.pixel_bytes = value("ZVAL2", 4), .block = value("ZVAL1", 32)};
}

base::Status read_compressed_shape(Hdu& hdu, const std::string& operation) {
    const Header& header = hdu.header;
    for (const std::string& keyword : header.contradicted()) {
        if (keyword.find_first_of("ZTNP") == 0) {  // of the image, the columns, the shape or the heap
            return corrupt(hdu, operation, base::printable(keyword) + " has more than one value");
        }
    }
    const std::string codec = header.text("ZCMPTYPE").value_or("");
    if (std::find(codecs.begin(), codecs.end(), codec) == codecs.end()) {
        return base::error(Code::unsupported, operation,
                           "HDU " + std::to_string(hdu.number) + ": unsupported compression \"" +
                               base::printable(codec, 20) + "\"");
    }
    const RiceParameters rice = rice_parameters(header);
    const bool possible = (rice.pixel_bytes == 1 || rice.pixel_bytes == 2 || rice.pixel_bytes == 4) &&
                          (rice.block == 16 || rice.block == 32);
    if (codec.starts_with("RICE") && !possible) {
        return corrupt(hdu, operation, "the parameters of its compression are impossible");
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
        tiles *= 1 + (length - 1) / step;
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

std::vector<std::int64_t> tile_lengths(const Hdu& hdu) {
    std::vector<std::int64_t> lengths;
    for (int axis = 1; axis <= static_cast<int>(hdu.axes.size()); ++axis) {
        lengths.push_back(tile_length(hdu, axis));
    }
    return lengths;
}

Table table_of(const Hdu& hdu) {
    const std::int64_t row_bytes = hdu.header.integer("NAXIS1").value_or(0);
    const std::int64_t rows = hdu.header.integer("NAXIS2").value_or(0);
    const std::int64_t gap =
        hdu.header.has("THEAP") ? hdu.header.integer("THEAP").value_or(-1) : row_bytes * rows;
    if (gap < row_bytes * rows || gap > hdu.data_bytes) {
        return {rows, row_bytes, hdu.header.data_offset(), -1};
    }
    return {rows, row_bytes, hdu.header.data_offset() + gap, hdu.data_bytes - gap};
}

base::Result<TileGuard> guard_tiles(const Hdu& hdu, const std::string& operation) {
    const Table table = table_of(hdu);
    auto columns = array_columns(hdu.header, table.row_bytes);
    if (columns.empty() || table.heap_bytes < 0) {
        return corrupt(hdu, operation, "the columns of the compressed image make no sense");
    }
    return TileGuard(hdu, std::move(columns));
}

}  // namespace shearwater::fits
