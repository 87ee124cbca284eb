#include "common/fits/tiled_pixels.h"

#include <algorithm>
#include <limits>

#include "common/fits/handle.h"
#include "common/fits/tiles.h"

namespace shearwater::fits {

namespace {

constexpr std::int64_t most_at_once = std::int64_t{1} << 18;  // so that a request to stop is soon heard
constexpr std::int64_t most_wide = std::int64_t{1} << 20;     // doubles held at a time

base::Status check_shape(fitsfile* file, const Hdu& hdu, const std::string& operation) {
    int status = 0;
    int axes = 0;
    int bitpix = 0;
    fits_movabs_hdu(file, hdu.number + 1, nullptr, &status);
    fits_get_img_dim(file, &axes, &status);
    fits_get_img_type(file, &bitpix, &status);
    std::vector<LONGLONG> lengths(hdu.axes.size());
    fits_get_img_sizell(file, static_cast<int>(lengths.size()), lengths.data(), &status);
    if (status != 0) {
        return cfitsio_error(status, operation);
    }
    if (axes != static_cast<int>(hdu.axes.size()) || bitpix != hdu.bitpix ||
        !std::equal(lengths.begin(), lengths.end(), hdu.axes.begin())) {
        return base::error(base::Code::corrupt, operation, "the header gives more than one shape");
    }
    const std::vector<std::int64_t> tile = tile_lengths(hdu);
    if (!std::equal(tile.begin(), tile.end(), file->Fptr->tilesize)) {
        return base::error(base::Code::corrupt, operation, "the header gives more than one size of tiles");
    }
    return {};
}

template <class Value>
int read_values(fitsfile* file, std::vector<long> first, std::vector<long> last, std::span<Value> out) {
    constexpr int type = sizeof(Value) == sizeof(float) ? TFLOAT : TDOUBLE;
    std::vector<long> step(first.size(), 1);
    Value null = std::numeric_limits<Value>::quiet_NaN();
    int status = 0;
    int any_null = 0;
    fits_read_subset(file, type, first.data(), last.data(), step.data(), &null, out.data(), &any_null,
                     &status);
    return status;
}

}  // namespace

base::Result<TiledPixels> TiledPixels::prepare(fitsfile* file, const Hdu& hdu, const CubeAxes& axes,
                                               const Encoding& encoding, const std::string& operation) {
    TiledPixels pixels;
    auto guard = guard_tiles(hdu, operation);
    if (!guard) {
        return guard.error();
    }
    pixels.guard_ = std::move(*guard);
    if (base::Status shape = check_shape(file, hdu, operation); !shape) {
        return shape.error();
    }
    pixels.axes_ = axes;
    pixels.dimensions_ = hdu.axes.size();
    pixels.tile_ = tile_lengths(hdu);
    pixels.wide_ = hdu.bitpix == -64;
    int status = 0;
    if (encoding.scale != 0) {
        fits_set_bscale(file, encoding.scale, encoding.zero, &status);
    }
    if (status != 0) {
        return cfitsio_error(status, operation);
    }
    return pixels;
}

TiledPixels::Range TiledPixels::range_of(const volume::Box& box) const {
    Range range{std::vector<long>(dimensions_, 1), std::vector<long>(dimensions_, 1)};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(axes_.axis[i] - 1);
        range.first[axis] = box.lo[i] + 1;
        range.last[axis] = box.hi[i] + 1;
    }
    if (axes_.plane_axis != 0) {
        const auto axis = static_cast<std::size_t>(axes_.plane_axis - 1);
        range.first[axis] = range.last[axis] = axes_.plane + 1;
    }
    return range;
}

// Parts of the range, along its last axis of more than one plane, until they are small: between tiles, so
// that none is unpacked twice, or plane by plane where one tile has too many doubles.
base::Status TiledPixels::read_range(const Reading& reading, const Range& range, std::span<float> out) {
    std::size_t axis = dimensions_ - 1;
    while (axis > 0 && range.first[axis] == range.last[axis]) {
        --axis;
    }
    const long first = range.first[axis];
    const long last = range.last[axis];
    const long tile = tile_[axis];
    const auto pixels = static_cast<std::int64_t>(out.size());
    const bool many_tiles = (first - 1) / tile != (last - 1) / tile;
    if (axis == 0 || !((many_tiles && pixels > most_at_once) || (wide_ && pixels > most_wide))) {
        return read_part(reading, range, out);
    }
    const std::int64_t plane = pixels / (last - first + 1);
    const long tiles = std::max(1L, most_at_once / plane / tile);
    Range part = range;
    for (long from = first; from <= last; from = part.last[axis] + 1) {
        part.first[axis] = from;
        part.last[axis] = many_tiles ? std::min(last, ((from - 1) / tile + tiles) * tile) : from;
        const auto size = static_cast<std::size_t>((part.last[axis] - from + 1) * plane);
        if (base::Status status = read_range(reading, part, out.first(size)); !status) {
            return status;
        }
        out = out.subspan(size);
    }
    return {};
}

base::Status TiledPixels::read_part(const Reading& reading, const Range& range, std::span<float> out) {
    if (reading.stop.stop_requested()) {
        return base::error(base::Code::cancelled, reading.operation, "stopped");
    }
    if (base::Status sound = guard_.check(reading.bytes, range.first, range.last, reading.operation);
        !sound) {
        return sound;
    }
    int status = 0;
    if (wide_) {
        std::vector<double> doubles(out.size());
        status = read_values<double>(reading.file, range.first, range.last, doubles);
        std::transform(doubles.begin(), doubles.end(), out.begin(), narrowed);
    } else {
        status = read_values<float>(reading.file, range.first, range.last, out);
    }
    if (status != 0) {
        return cfitsio_error(status, reading.operation);
    }
    return {};
}

base::Status TiledPixels::read(fitsfile* file, const Bytes& bytes, const volume::Box& box,
                               std::span<float> out, const std::string& operation,
                               const std::stop_token& stop) {
    return read_range({file, bytes, operation, stop}, range_of(box), out);
}

}  // namespace shearwater::fits
