#pragma once
// Lossless coding of 8-bit pictures for the link to a client: runs of equal pixels and stretches of
// different ones, then deflate where that pays. The alpha channel is not sent: decoded pixels have 255.

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "common/base/buffer.h"
#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/image/image.h"

namespace shearwater::image {

// The most bytes encode_rle can give for so many pixels.
std::size_t rle_bound(std::size_t pixels);
// Encodes into `out` (of at least rle_bound bytes) and returns how many bytes were written.
std::size_t encode_rle(std::span<const Rgba8> pixels, std::span<std::byte> out);
// The same by several threads, each a part of the pixels: a run may be cut where two parts meet.
base::Buffer encode_rle(std::span<const Rgba8> pixels, base::Workers& workers);
// The same in pieces of so many pixels, coded as the picture is made: each once, in any order, by any thread.
class RlePieces {
  public:
    // A piece is rounded up to a number of pixels that leaves the bound as it is.
    RlePieces(std::size_t pixels, std::size_t piece);
    std::size_t pieces() const { return sizes_.size(); }
    // The pixels [first, second) of a piece.
    std::pair<std::size_t, std::size_t> range(std::size_t piece) const;
    void code(std::size_t piece, std::span<const Rgba8> pixels);
    // All of them, one behind the other.
    base::Buffer join();

  private:
    std::size_t pixels_, piece_;
    std::vector<std::size_t> sizes_;
    base::Buffer bytes_;
};
// Decodes untrusted bytes: they must give exactly pixels.size() pixels and leave nothing over.
base::Status decode_rle(std::span<const std::byte> bytes, std::span<Rgba8> pixels);

std::vector<std::byte> deflate(std::span<const std::byte> bytes, int level = 1);
// Inflates untrusted bytes; more than `limit` of them, or a broken stream, is an error.
base::Result<std::vector<std::byte>> inflate(std::span<const std::byte> bytes, std::size_t limit);

}  // namespace shearwater::image
