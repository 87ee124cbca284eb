#pragma once
// Whether a compressed tile's stream can be decoded without reading past its end or giving more than its
// tile holds.

#include <cstdint>
#include <span>

namespace shearwater::fits {

// Ends where its bytes do at the latest, and gives 1, 2, 4 or 8 bytes for a pixel.
bool gzip_holds(std::span<char> stream, std::int64_t pixels);

// All codes of all pixels lie inside; they come in blocks of `block` pixels of 1, 2 or 4 bytes.
bool rice_holds(std::span<const char> stream, std::int64_t pixels, int pixel_bytes, int block);

// The lengths it begins with are within the tile's.
bool hcompress_holds(std::span<const char> stream, std::int64_t pixels);

// The length it begins with is within its own.
bool plio_holds(std::span<const char> stream);

}  // namespace shearwater::fits
