// Every kernel that decodes pixels against the definition, bit by bit.

#include "common/fits/encoding.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

#include "tests/support/simd_targets.h"

namespace shearwater::fits {
namespace {

// Bytes at random, and values at the edges of what decoding has to tell apart.
std::vector<char> pixels_of(const Encoding& encoding, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    const std::size_t size = encoding.pixel_bytes();
    std::vector<char> bytes(count * size);
    for (char& byte : bytes) {
        byte = static_cast<char>(random());
    }
    for (std::size_t i = 0; i < count; i += 3) {
        // The values -2 to 7 among integers; zeros, infinities, NaN and the largest among floats.
        const int byte = static_cast<int>(random() % 10) - 2;
        for (std::size_t k = 0; k < size; ++k) {
            bytes[i * size + k] = static_cast<char>(byte < 0 ? -1 : 0);
        }
        bytes[(i + 1) * size - 1] = static_cast<char>(byte);
        if (encoding.bitpix < 0 && byte >= 0) {
            bytes[i * size] = static_cast<char>(byte % 2 == 0 ? 0x7f : 0xff);
            bytes[i * size + 1] = static_cast<char>(byte < 4 ? 0x80 : byte < 6 ? 0x7f : 0xf0);
        }
    }
    if (encoding.bitpix == -64) {
        // Past the largest float by less than what is rounded away.
        for (std::size_t i = 2; i < count; i += 7) {
            std::copy_n("\x47\xef\xff\xff\xe0\x00\x00\x01", size, &bytes[i * size]);
        }
    }
    return bytes;
}

std::uint32_t bits_of(float value) {
    return value == value ? std::bit_cast<std::uint32_t>(value) : 0x7fc00000U;
}

void expect_as_defined(const Encoding& encoding) {
    constexpr std::size_t most = 300;
    const std::size_t size = encoding.pixel_bytes();
    for (std::size_t count = 0; count < most; count += count < 70 ? 1 : 37) {
        const std::size_t shift = count % 9;
        std::vector<char> bytes(shift + count * size);
        const std::vector<char> pixels = pixels_of(encoding, count + 1, static_cast<unsigned>(count));
        std::copy_n(pixels.begin(), count * size, bytes.begin() + static_cast<std::ptrdiff_t>(shift));
        const std::span<const char> stored = std::span(bytes).subspan(shift);
        std::vector<float> expected(count);
        decode_plainly(encoding, stored, expected);
        std::vector<float> found(shift + count + 1, 42.0F);
        decode(encoding, stored, std::span(found).subspan(shift, count));
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(bits_of(found[shift + i]), bits_of(expected[i]))
                << i << " of " << count << ", BITPIX " << encoding.bitpix << ": " << found[shift + i]
                << " and " << expected[i];
        }
        EXPECT_EQ(found.back(), 42.0F);
        if (size == sizeof(float)) {
            std::vector<float> place(count);
            std::copy(stored.begin(), stored.end(), reinterpret_cast<char*>(place.data()));
            decode(encoding, {reinterpret_cast<const char*>(place.data()), count * size}, place);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(bits_of(place[i]), bits_of(expected[i]));
            }
        }
    }
}

TEST(Encoding, EveryTargetDecodesAsDefined) {
    support::for_each_target([] {
        for (const int bitpix : {8, 16, 32, 64, -32, -64}) {
            expect_as_defined({.bitpix = bitpix});
            expect_as_defined({.bitpix = bitpix, .scale = 0.1, .zero = -3.3});
            expect_as_defined({.bitpix = bitpix, .scale = -1e30});
            expect_as_defined({.bitpix = bitpix, .scale = 0, .zero = 5});
            if (bitpix > 0) {
                expect_as_defined({.bitpix = bitpix, .blank = 3});
                expect_as_defined({.bitpix = bitpix, .scale = 0.1, .zero = 1, .blank = bitpix == 8 ? 6 : -2});
                expect_as_defined({.bitpix = bitpix, .blank = (std::int64_t{1} << 32) + 3});
            }
        }
        expect_as_defined({.bitpix = 64, .zero = 0x1p63});
    });
}

TEST(Encoding, ScalingIsDoneInDoublePrecisionAndRoundedOnce) {
    const Encoding encoding{.bitpix = 32, .scale = 0.1, .zero = 1e-3};
    const std::vector<char> bytes = {0x7f, char(0xff), char(0xff), char(0xfd)};
    std::vector<float> value(1);
    decode(encoding, bytes, value);
    EXPECT_EQ(value[0], static_cast<float>(2147483645 * 0.1 + 1e-3));
}

TEST(Encoding, SmallUnsignedIntegersOf64BitsAreNotLost) {
    const Encoding encoding{.bitpix = 64, .zero = 0x1p63};
    const std::vector<char> bytes = {char(0x80), 0, 0, 0, 0, 0, 0, 7};
    std::vector<float> value(1);
    decode(encoding, bytes, value);
    EXPECT_EQ(value[0], 7);
}

}  // namespace
}  // namespace shearwater::fits
