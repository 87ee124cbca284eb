#pragma once
// How an image stores its values, and physical values from the bytes.

#include <cstdint>
#include <optional>
#include <span>

namespace shearwater::fits {

// The value of a pixel is stored * scale + zero in double precision, cut to single: beyond it lies
// infinity. An integer that is `blank` has none, and is NaN. Without scaling, floats come through as they
// are, and integers are rounded once.
struct Encoding {
    int bitpix = -32;
    double scale = 1;
    double zero = 0;
    std::optional<std::int64_t> blank;  // among integers only

    std::size_t pixel_bytes() const { return static_cast<std::size_t>(bitpix < 0 ? -bitpix : bitpix) / 8; }
    bool scaled() const { return scale != 1 || zero != 0; }
};

// Beyond single precision lies infinity.
float narrowed(double value);

// Fills `out` from as many big-endian pixels, which lie at any address, or in place where a pixel has the
// size of a float.
void decode(const Encoding& encoding, std::span<const char> stored, std::span<float> out);

// The same, pixel by pixel: the definition of it.
void decode_plainly(const Encoding& encoding, std::span<const char> stored, std::span<float> out);

}  // namespace shearwater::fits
