#include "common/fits/pixels.h"

#include <algorithm>
#include <limits>

#include "common/fits/handle.h"
#include "common/fits/tiles.h"

namespace shearwater::fits {

namespace {

constexpr std::int64_t most_wide = std::int64_t{1} << 20;  // doubles held at a time

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
    if (hdu.kind == HduKind::compressed_image) {
        const std::vector<std::int64_t> tile = tile_lengths(hdu);
        if (!std::equal(tile.begin(), tile.end(), file->Fptr->tilesize)) {
            return base::error(base::Code::corrupt, operation,
                               "the header gives more than one size of tiles");
        }
    }
    return {};
}

// The number of a scaling keyword, repaired where it is none.
double scaling(const Header& header, const char* keyword, double usual, std::vector<std::string>& notes) {
    const auto value = header.real(keyword);
    if (!value && header.has(keyword)) {
        notes.push_back(std::string(keyword) + " is not a number and is ignored");
    }
    return value.value_or(usual);
}

// Beyond single precision lies infinity.
float narrowed(double value) {
    constexpr double largest = std::numeric_limits<float>::max();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return value > largest ? infinity : value < -largest ? -infinity : static_cast<float>(value);
}

}  // namespace

base::Result<PixelReader> PixelReader::prepare(fitsfile* file, const Hdu& hdu, const CubeAxes& axes,
                                               const std::string& operation,
                                               std::vector<std::string>& notes) {
    constexpr std::size_t most_axes = 9;  // of cfitsio's reading of boxes
    if (hdu.axes.size() > most_axes) {
        return base::error(base::Code::unsupported, operation,
                           "images of more than 9 axes are not supported");
    }
    PixelReader reader;
    if (hdu.kind == HduKind::compressed_image) {
        auto guard = guard_tiles(hdu, operation);
        if (!guard) {
            return guard.error();
        }
        reader.guard_ = std::move(*guard);
        reader.compressed_ = true;
    }
    if (base::Status shape = check_shape(file, hdu, operation); !shape) {
        return shape.error();
    }
    reader.axes_ = axes;
    reader.lengths_ = hdu.axes;
    reader.integer_ = hdu.bitpix > 0;
    reader.wide_ = hdu.bitpix == -64;
    const double scale = scaling(hdu.header, "BSCALE", 1, notes);
    const double zero = scaling(hdu.header, "BZERO", 0, notes);
    if (scale == 0) {
        notes.push_back("BSCALE is 0: every value is BZERO");
    }
    if (hdu.header.has("BLANK") && !reader.integer_) {
        notes.push_back("BLANK has no meaning among floating-point values and is ignored");
    }
    int status = 0;
    if (scale != 0) {
        fits_set_bscale(file, scale, zero, &status);
    }
    if (status != 0) {
        return cfitsio_error(status, operation);
    }
    return reader;
}

PixelReader::Range PixelReader::range_of(const volume::Box& box) const {
    Range range{std::vector<long>(lengths_.size(), 1), std::vector<long>(lengths_.size(), 1)};
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

// Whether the pixels of a range follow each other in the file: whole axes, then a part of one, then
// single planes.
bool PixelReader::contiguous(const Range& range) const {
    std::size_t i = 0;
    while (i < lengths_.size() && range.last[i] - range.first[i] + 1 == lengths_[i]) {
        ++i;
    }
    for (++i; i < lengths_.size(); ++i) {
        if (range.first[i] != range.last[i]) {
            return false;
        }
    }
    return true;
}

template <class Value>
int PixelReader::read_values(fitsfile* file, Range& range, std::span<Value> out) const {
    constexpr int type = sizeof(Value) == sizeof(float) ? TFLOAT : TDOUBLE;
    // Without a null value cfitsio leaves floating-point values alone; with one it would act on an
    // illegal BLANK's account and flush denormal values to zero.
    Value null = std::numeric_limits<Value>::quiet_NaN();
    Value* const null_value = integer_ || compressed_ ? &null : nullptr;
    int status = 0;
    int any_null = 0;
    if (!compressed_ && contiguous(range)) {
        std::vector<LONGLONG> first(range.first.begin(), range.first.end());
        fits_read_pixll(file, type, first.data(), static_cast<LONGLONG>(out.size()), null_value, out.data(),
                        &any_null, &status);
    } else {
        std::vector<long> step(range.first.size(), 1);
        fits_read_subset(file, type, range.first.data(), range.last.data(), step.data(), null_value,
                         out.data(), &any_null, &status);
    }
    return status;
}

// Parts of the range, along its last axis of more than one plane, until they can be read at once.
base::Status PixelReader::read_range(fitsfile* file, Range range, std::span<float> out,
                                     const std::string& operation) const {
    std::size_t last = range.first.size() - 1;
    while (last > 0 && range.first[last] == range.last[last]) {
        --last;
    }
    const bool too_many = wide_ && static_cast<std::int64_t>(out.size()) > most_wide;
    const bool rows = !compressed_ && !contiguous(range) && range.last[0] - range.first[0] + 1 == lengths_[0];
    if (last > 0 && (too_many || rows)) {
        const long planes = range.last[last] - range.first[last] + 1;
        const std::size_t plane = out.size() / static_cast<std::size_t>(planes);
        for (long i = 0; i < planes; ++i) {
            Range part = range;
            part.first[last] = part.last[last] = range.first[last] + i;
            const auto into = out.subspan(static_cast<std::size_t>(i) * plane, plane);
            if (base::Status status = read_range(file, std::move(part), into, operation); !status) {
                return status;
            }
        }
        return {};
    }
    int status = 0;
    if (wide_) {
        std::vector<double> doubles(out.size());
        status = read_values<double>(file, range, doubles);
        std::transform(doubles.begin(), doubles.end(), out.begin(), narrowed);
    } else {
        status = read_values<float>(file, range, out);
    }
    if (status != 0) {
        return cfitsio_error(status, operation);
    }
    return {};
}

base::Status PixelReader::read(fitsfile* file, const Bytes& bytes, const volume::Box& box,
                               std::span<float> out, const std::string& operation) {
    Range range = range_of(box);
    if (compressed_) {
        if (base::Status sound = guard_.check(bytes, range.first, range.last, operation); !sound) {
            return sound;
        }
    }
    return read_range(file, std::move(range), out, operation);
}

}  // namespace shearwater::fits
