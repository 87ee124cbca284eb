#include "common/fits/streams.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>

#include "common/fits/big_endian.h"
#include "common/fits/inflater.h"

namespace shearwater::fits {

namespace {

// Bits from the most significant on; past the end there are none, and `left` is negative.
class Bits {
  public:
    explicit Bits(std::span<const char> bytes)
        : bytes_(bytes), left_(8 * static_cast<std::int64_t>(bytes.size())) {}

    std::int64_t left() const { return left_; }

    std::uint32_t take(int count) {
        fill();
        const auto value = count == 0 ? 0U : static_cast<std::uint32_t>(window_ >> (64 - count));
        drop(count);
        return value;
    }

    // Zeros and the one behind them.
    void skip_zeros() {
        fill();
        while (window_ == 0 && left_ > 0) {
            drop(held_);
            fill();
        }
        drop(std::countl_zero(window_) + 1);
    }

  private:
    void fill() {
        for (; held_ <= 56 && next_ < bytes_.size(); held_ += 8) {
            window_ |= std::uint64_t{static_cast<unsigned char>(bytes_[next_++])} << (56 - held_);
        }
    }
    void drop(int count) {
        left_ -= count;
        held_ = std::max(0, held_ - count);
        window_ = count < 64 ? window_ << count : 0;
    }

    std::span<const char> bytes_;
    std::int64_t left_;
    std::size_t next_ = 0;
    std::uint64_t window_ = 0;
    int held_ = 0;
};

}  // namespace

bool gzip_holds(std::span<char> stream, std::int64_t pixels) {
    Inflater inflater;
    std::array<unsigned char, 1 << 15> out;
    inflater.stream.next_in = reinterpret_cast<Bytef*>(stream.data());
    inflater.stream.avail_in = static_cast<uInt>(stream.size());
    std::int64_t bytes = 0;
    int outcome = inflater.ready() ? Z_OK : Z_MEM_ERROR;
    while (outcome == Z_OK && bytes <= 8 * pixels) {
        inflater.stream.next_out = out.data();
        inflater.stream.avail_out = static_cast<uInt>(out.size());
        outcome = inflate(&inflater.stream, Z_NO_FLUSH);
        bytes += static_cast<std::int64_t>(out.size() - inflater.stream.avail_out);
    }
    return outcome == Z_STREAM_END &&
           (bytes == pixels || bytes == 2 * pixels || bytes == 4 * pixels || bytes == 8 * pixels);
}

// A Rice stream has its first pixel plainly, then for each block how many low bits of the differences
// are stored as they are; 0 stands for no differences, the largest for pixels stored plainly.
bool rice_holds(std::span<const char> stream, std::int64_t pixels, int pixel_bytes, int block) {
    const int width_bits = pixel_bytes == 1 ? 3 : pixel_bytes == 2 ? 4 : 5;
    const int plain = pixel_bytes == 1 ? 6 : pixel_bytes == 2 ? 14 : 25;
    if (static_cast<std::int64_t>(stream.size()) <= pixel_bytes) {
        return false;
    }
    Bits bits(stream.subspan(static_cast<std::size_t>(pixel_bytes)));
    for (std::int64_t done = 0; done < pixels; done += block) {
        const int low_bits = static_cast<int>(bits.take(width_bits)) - 1;
        if (low_bits > plain) {
            return false;
        }
        const std::int64_t count = low_bits < 0 ? 0 : std::min<std::int64_t>(block, pixels - done);
        for (std::int64_t i = 0; i < count && bits.left() >= 0; ++i) {
            if (low_bits == plain) {
                bits.take(8 * pixel_bytes);
                continue;
            }
            bits.skip_zeros();
            bits.take(low_bits);
        }
        if (bits.left() < 0) {
            return false;
        }
    }
    return true;
}

// An HCOMPRESS stream begins with 2 bytes of magic, two lengths, a scale, a sum, and how many bits its
// three quadrants have.
bool hcompress_holds(std::span<const char> stream, std::int64_t pixels) {
    constexpr std::size_t start = 2 + 4 + 4 + 4 + 8 + 3;
    if (stream.size() < start) {
        return false;
    }
    const std::int64_t nx = big_endian<std::int32_t>(stream.data() + 2);
    const std::int64_t ny = big_endian<std::int32_t>(stream.data() + 6);
    const auto bits = stream.subspan(22, 3);
    return nx > 0 && ny > 0 && nx * ny <= pixels &&
           std::all_of(bits.begin(), bits.end(), [](char c) { return c >= 0 && c < 64; });
}

// A PLIO line list has its length in its third word, or in its fourth and fifth.
bool plio_holds(std::span<const char> stream) {
    constexpr std::size_t start = 10;
    if (stream.size() < start) {
        return false;
    }
    const auto word = [&](std::size_t i) { return big_endian<std::int16_t>(stream.data() + 2 * i); };
    const std::int64_t length = word(2) > 0 ? word(2) : word(4) * 32768 + word(3);
    return length >= 0 && word(1) >= 0 && 2 * length <= static_cast<std::int64_t>(stream.size());
}

}  // namespace shearwater::fits
