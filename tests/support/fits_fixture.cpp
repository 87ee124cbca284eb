#include "tests/support/fits_fixture.h"

#include <fitsio.h>
#include <zlib.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "common/base/check.h"

namespace shearwater::support {

namespace {

template <class Value>
void write_as(int type, fitsfile* file, const FitsImage& image, int* status) {
    std::vector<Value> raw(image.raw.begin(), image.raw.end());
    fits_write_img(file, type, 1, static_cast<LONGLONG>(raw.size()), raw.data(), status);
}

// Values as they are stored, whatever the scaling cards will say.
void write_raw(fitsfile* file, const FitsImage& image, int* status) {
    fits_set_bscale(file, 1, 0, status);
    switch (image.bitpix) {  // compressed images take their own types only
        case BYTE_IMG:
            return write_as<std::uint8_t>(TBYTE, file, image, status);
        case SHORT_IMG:
            return write_as<std::int16_t>(TSHORT, file, image, status);
        case LONG_IMG:
            return write_as<int>(TINT, file, image, status);
        case LONGLONG_IMG:
            return write_as<LONGLONG>(TLONGLONG, file, image, status);
        case FLOAT_IMG:
            return write_as<float>(TFLOAT, file, image, status);
        case DOUBLE_IMG:
            return write_as<double>(TDOUBLE, file, image, status);
        default:
            base::check(false, "a BITPIX of FITS");
    }
}

void write_image(fitsfile* file, const FitsImage& image, int* status) {
    fits_set_compression_type(file, image.compression, status);
    if (!image.tile.empty()) {
        std::vector<long> tile = image.tile;
        fits_set_tile_dim(file, static_cast<int>(tile.size()), tile.data(), status);
    }
    fits_set_quantize_level(file, 0, status);
    std::vector<long> axes = image.axes;
    fits_create_img(file, image.bitpix, static_cast<int>(axes.size()), axes.data(), status);
    for (auto [keyword, text] : image.texts) {
        fits_write_key(file, TSTRING, keyword.c_str(), text.data(), nullptr, status);
    }
    write_raw(file, image, status);
    if (image.blank) {
        LONGLONG blank = *image.blank;
        fits_write_key(file, TLONGLONG, "BLANK", &blank, nullptr, status);
    }
    if (image.scale) {
        double scale = *image.scale;
        fits_write_key(file, TDOUBLE, "BSCALE", &scale, nullptr, status);
    }
    if (image.zero) {
        double zero = *image.zero;
        fits_write_key(file, TDOUBLE, "BZERO", &zero, nullptr, status);
    }
}

}  // namespace

void write_fits(const std::string& path, const std::vector<FitsImage>& images) {
    std::remove(path.c_str());
    fitsfile* file = nullptr;
    int status = 0;
    fits_create_diskfile(&file, path.c_str(), &status);
    for (const FitsImage& image : images) {
        write_image(file, image, &status);
    }
    fits_close_file(file, &status);
    fits_report_error(stderr, status);
    base::check(status == 0, "the test's FITS file is written");
}

std::string slurp(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void spill(const std::string& path, const std::string& bytes) {
    std::remove(path.c_str());  // a new file is not flushed to disk as one that is cut is
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void gzip(const std::string& from, const std::string& to) {
    const std::string bytes = slurp(from);
    gzFile file = gzopen(to.c_str(), "wb");
    base::check(file != nullptr, "the test's gzip file is opened");
    gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
}

std::string header_of(const std::vector<std::string>& cards) {
    std::string header;
    for (std::string one : cards) {
        one.resize(80, ' ');
        header += one;
    }
    header += "END";
    header.resize((header.size() + 2879) / 2880 * 2880, ' ');
    return header;
}

std::string card(const std::string& keyword, std::int64_t value) {
    std::string text = keyword;
    text.resize(8, ' ');
    const std::string number = std::to_string(value);
    return text + "= " + std::string(number.size() < 20 ? 20 - number.size() : 0, ' ') + number;
}

}  // namespace shearwater::support
