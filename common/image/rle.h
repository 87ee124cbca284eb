#pragma once
// Lossless coding of 8-bit pictures for the link to a client: runs of equal pixels and stretches of
// different ones, then deflate where that pays. The alpha channel is not sent: decoded pixels have 255.

#include <cstddef>
#include <span>
#include <vector>

#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/image/image.h"

namespace shearwater::image {

// The most bytes encode_rle can give for so many pixels.
std::size_t rle_bound(std::size_t pixels);
// Encodes into `out` (of at least rle_bound bytes) and returns how many bytes were written.
std::size_t encode_rle(std::span<const Rgba8> pixels, std::span<std::byte> out);
// The same by several threads, each a part of the pixels: a run may be cut where two parts meet.
std::size_t encode_rle(std::span<const Rgba8> pixels, std::span<std::byte> out, base::Workers& workers);
// Decodes untrusted bytes: they must give exactly pixels.size() pixels and leave nothing over.
base::Status decode_rle(std::span<const std::byte> bytes, std::span<Rgba8> pixels);

std::vector<std::byte> deflate(std::span<const std::byte> bytes, int level = 1);
// Inflates untrusted bytes; more than `limit` of them, or a broken stream, is an error.
base::Result<std::vector<std::byte>> inflate(std::span<const std::byte> bytes, std::size_t limit);

}  // namespace shearwater::image
