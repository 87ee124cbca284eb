#pragma once
// Small FITS files for tests, made through cfitsio or card by card.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace shearwater::support {

// An image of raw values: what is stored, before BSCALE and BZERO.
struct FitsImage {
    int bitpix = -32;
    std::vector<long> axes;
    std::vector<double> raw;                                 // cut to the type; one for each pixel
    std::optional<std::int64_t> blank;                       // the BLANK card
    std::optional<double> scale, zero;                       // the BSCALE and BZERO cards
    std::vector<std::pair<std::string, std::string>> texts;  // string cards
    int compression = 0;                                     // RICE_1, GZIP_2, ... of cfitsio; 0 is none
    std::vector<long> tile;                                  // of a compressed image; empty is cfitsio's own
};

// Writes the images, one to an HDU; compressed ones begin in HDU 1, behind an empty primary.
void write_fits(const std::string& path, const std::vector<FitsImage>& images);

// Whole files as bytes.
std::string slurp(const std::string& path);
void spill(const std::string& path, const std::string& bytes);
void gzip(const std::string& from, const std::string& to);

// A header of the given cards and END, padded to a block.
std::string header_of(const std::vector<std::string>& cards);
// "NAXIS   =                    3"
std::string card(const std::string& keyword, std::int64_t value);

}  // namespace shearwater::support
