#include "common/fits/tiled_pixels.h"

#include <algorithm>
#include <limits>

#include "common/fits/handle.h"
#include "common/fits/tiles.h"

namespace shearwater::fits {

namespace {

using volume::Box;

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

// A box cut by a grid of blocks that begins at voxel 0.
std::vector<Box> cut_up(const Box& box, const volume::Index3& sides) {
    const auto end = [&](const Box& block, std::size_t axis) {
        return std::min(box.hi[axis], (block.lo[axis] / sides[axis] + 1) * sides[axis] - 1);
    };
    std::vector<Box> blocks;
    Box block;
    for (block.lo[2] = box.lo[2]; block.lo[2] <= box.hi[2]; block.lo[2] = block.hi[2] + 1) {
        block.hi[2] = end(block, 2);
        for (block.lo[1] = box.lo[1]; block.lo[1] <= box.hi[1]; block.lo[1] = block.hi[1] + 1) {
            block.hi[1] = end(block, 1);
            for (block.lo[0] = box.lo[0]; block.lo[0] <= box.hi[0]; block.lo[0] = block.hi[0] + 1) {
                block.hi[0] = end(block, 0);
                blocks.push_back(block);
            }
        }
    }
    return blocks;
}

std::size_t offset_in(const Box& box, const volume::Index3& at) {
    return static_cast<std::size_t>(
        ((at[2] - box.lo[2]) * box.planes(1) + (at[1] - box.lo[1])) * box.planes(0) + (at[0] - box.lo[0]));
}

// Whether the voxels of a block are neighbours among those of the box.
bool follow_each_other(const Box& block, const Box& box) {
    return block.planes(0) == box.planes(0) && (block.planes(1) == box.planes(1) || block.planes(2) == 1);
}

void copy_block(std::span<const float> values, const Box& block, std::span<float> out, const Box& box) {
    const auto row = static_cast<std::size_t>(block.planes(0));
    for (std::int64_t z = block.lo[2]; z <= block.hi[2]; ++z) {
        for (std::int64_t y = block.lo[1]; y <= block.hi[1]; ++y) {
            std::copy_n(values.begin(), row, out.subspan(offset_in(box, {block.lo[0], y, z})).begin());
            values = values.subspan(row);
        }
    }
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

bool TiledPixels::has_row_tiles() const {
    std::int64_t rows = 1;
    for (std::size_t axis = 0; axis < tile_.size(); ++axis) {
        rows *= static_cast<int>(axis) + 1 == axes_.axis[0] ? 1 : tile_[axis];
    }
    return rows == 1;
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

// The sides of the blocks that a box is read in. They meet between tiles, so that none is unpacked twice, and
// hold no more than is wanted at once, or one tile; of doubles even a part of a tile.
volume::Index3 TiledPixels::block_of(const volume::Box& box) const {
    volume::Index3 sides = box.plane_counts();
    volume::Index3 block = axes_.n;
    const auto cut = [&](std::size_t axis, std::int64_t unit, std::int64_t most) {
        const std::int64_t others = sides[0] * sides[1] * sides[2] / sides[axis];
        if (others * sides[axis] > most && unit < sides[axis]) {
            sides[axis] = block[axis] = std::max<std::int64_t>(1, most / others / unit) * unit;
        }
    };
    for (std::size_t axis = 3; axis-- > 0;) {
        cut(axis, tile_[static_cast<std::size_t>(axes_.axis[axis] - 1)], most_at_once);
    }
    for (std::size_t axis = 3; wide_ && axis-- > 0;) {
        cut(axis, 1, most_wide);
    }
    return block;
}

base::Status TiledPixels::read_block(const Reading& reading, const Box& block, std::span<float> out) {
    const Range range = range_of(block);
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

base::Status TiledPixels::read(fitsfile* file, const Bytes& bytes, const Box& box, std::span<float> out,
                               const std::string& operation, const std::stop_token& stop) {
    const Reading reading{file, bytes, operation, stop};
    std::vector<float> values;
    for (const Box& block : cut_up(box, block_of(box))) {
        const auto count = static_cast<std::size_t>(block.voxels());
        const bool in_place = follow_each_other(block, box);
        values.resize(in_place ? 0 : count);
        const auto into = in_place ? out.subspan(offset_in(box, block.lo), count) : std::span(values);
        if (base::Status status = read_block(reading, block, into); !status) {
            return status;
        }
        if (!in_place) {
            copy_block(values, block, out, box);
        }
    }
    return {};
}

}  // namespace shearwater::fits
