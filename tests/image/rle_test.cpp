#include "common/image/rle.h"

#include <gtest/gtest.h>

#include <random>

namespace shearwater::image {
namespace {

using Pixels = std::vector<Rgba8>;
using Bytes = std::vector<std::byte>;

Bytes encoded(const Pixels& pixels) {
    Bytes out(rle_bound(pixels.size()));
    out.resize(encode_rle(pixels, out));
    return out;
}

Bytes bytes_of(std::initializer_list<int> values) {
    Bytes out;
    for (const int v : values) {
        out.push_back(static_cast<std::byte>(v));
    }
    return out;
}

void expect_round_trip(const Pixels& pixels) {
    Pixels back(pixels.size());
    const auto decoded = decode_rle(encoded(pixels), back);
    ASSERT_TRUE(decoded) << decoded.error().message();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        ASSERT_EQ(back[i], (Rgba8{pixels[i].r, pixels[i].g, pixels[i].b, 255})) << i;
    }
}

TEST(Rle, KnownBytes) {
    const Rgba8 a{1, 2, 3, 255}, b{4, 5, 6, 255};
    EXPECT_EQ(encoded({}), bytes_of({}));
    EXPECT_EQ(encoded({a}), bytes_of({0x00, 1, 2, 3}));
    EXPECT_EQ(encoded({a, b}), bytes_of({0x01, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(encoded({a, a}), bytes_of({0x80, 1, 2, 3}));
    EXPECT_EQ(encoded({b, a, a, a, a, b}), bytes_of({0x00, 4, 5, 6, 0x82, 1, 2, 3, 0x00, 4, 5, 6}));
    EXPECT_EQ(encoded({a, a, b, b, b, a}), bytes_of({0x80, 1, 2, 3, 0x81, 4, 5, 6, 0x00, 1, 2, 3}));
    // A stretch does not end for so little.
    EXPECT_EQ(encoded({b, a, a, a, b}), bytes_of({0x04, 4, 5, 6, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(encoded(Pixels(65, a)), bytes_of({0xbf, 1, 2, 3}));
    EXPECT_EQ(encoded(Pixels(66, a)), bytes_of({0xc0, 0, 1, 2, 3}));
    EXPECT_EQ(encoded(Pixels(66 + 0x3fff, a)), bytes_of({0xff, 0xff, 1, 2, 3}));
}

// Other coders may end one.
TEST(Rle, ReadsRunsOfAnyLengthBetweenStretches) {
    const Rgba8 a{1, 2, 3, 255}, b{4, 5, 6, 255};
    Pixels pixels(5);
    ASSERT_TRUE(decode_rle(bytes_of({0x00, 4, 5, 6, 0x81, 1, 2, 3, 0x00, 4, 5, 6}), pixels));
    EXPECT_EQ(pixels, (Pixels{b, a, a, a, b}));
}

// By several threads, of pictures too small for that, of whole stretches and not, of runs and of none.
TEST(Rle, InPartsKeepsToTheBound) {
    base::Workers workers(3);
    std::mt19937 random(1);
    for (const std::size_t n : {0, 1, 16383, 16384, 16385, 3 * 16384, 3 * 16384 + 128, 100001}) {
        for (const unsigned colours : {1U, 2U, 1U << 24}) {
            Pixels pixels(n);
            for (Rgba8& pixel : pixels) {
                const auto colour = random() % colours;
                pixel = {static_cast<std::uint8_t>(colour), static_cast<std::uint8_t>(colour >> 8),
                         static_cast<std::uint8_t>(colour >> 16), 255};
            }
            const base::Buffer out = encode_rle(pixels, workers);
            EXPECT_LE(out.size(), rle_bound(n));
            Pixels back(n);
            ASSERT_TRUE(decode_rle(out, back)) << n;
            EXPECT_EQ(back, pixels) << n << " of " << colours;
        }
    }
}

TEST(Rle, PiecesComeInAnyOrder) {
    std::mt19937 random(4);
    Pixels pixels(5000);
    for (Rgba8& pixel : pixels) {
        pixel = {static_cast<std::uint8_t>(random() % 2 == 0 ? random() : 7), 3, 5, 255};
    }
    RlePieces pieces(pixels.size(), 700);  // 768 by whole stretches
    ASSERT_EQ(pieces.pieces(), 7U);
    EXPECT_EQ(pieces.range(6), (std::pair<std::size_t, std::size_t>{4608, 5000}));
    Bytes expected;
    for (const std::size_t piece : {3, 0, 6, 5, 1, 4, 2}) {
        pieces.code(piece, pixels);
    }
    for (std::size_t piece = 0; piece < 7; ++piece) {
        const auto [begin, end] = pieces.range(piece);
        const Bytes one = encoded(Pixels(pixels.begin() + static_cast<std::ptrdiff_t>(begin),
                                         pixels.begin() + static_cast<std::ptrdiff_t>(end)));
        expected.insert(expected.end(), one.begin(), one.end());
    }
    EXPECT_TRUE(std::ranges::equal(pieces.join(), expected));
}

TEST(Rle, AlphaIsNotSent) {
    EXPECT_EQ(encoded({{1, 2, 3, 0}, {1, 2, 3, 9}}), bytes_of({0x80, 1, 2, 3}));
    expect_round_trip({{1, 2, 3, 0}, {1, 2, 3, 9}, {7, 7, 7, 7}});
}

TEST(Rle, EveryLengthAroundTheLimitsOfAPart) {
    for (const std::size_t n :
         {1, 2, 3, 64, 65, 66, 67, 127, 128, 129, 255, 256, 257, 16448, 16449, 16450, 40000}) {
        expect_round_trip(Pixels(n, Rgba8{9, 8, 7, 255}));
        Pixels different(n);
        for (std::size_t i = 0; i < n; ++i) {
            different[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 0, 255};
        }
        expect_round_trip(different);
        EXPECT_LE(encoded(different).size(), rle_bound(n));
    }
}

// Runs of random lengths and few colours, at every density of runs.
TEST(Rle, RandomPicturesComeBackWithinTheBound) {
    std::mt19937 random(1);
    for (int round = 0; round < 400; ++round) {
        Pixels pixels;
        const auto runs = random() % 60;
        for (unsigned run = 0; run < runs; ++run) {
            const std::size_t length = 1 + random() % (round % 2 == 0 ? 3 : 300);
            pixels.insert(pixels.end(), length, Rgba8{static_cast<std::uint8_t>(random() % 2), 0, 0, 255});
        }
        ASSERT_LE(encoded(pixels).size(), rle_bound(pixels.size()));
        expect_round_trip(pixels);
    }
}

TEST(Rle, EmptySkyIsSmall) {
    EXPECT_LT(encoded(Pixels(1024 * 1024)).size(), 400u);
}

TEST(Rle, EveryTruncationAndEveryWrongSizeIsRefused) {
    Pixels pixels(300, Rgba8{1, 1, 1, 255});
    pixels[100] = {5, 6, 7, 255};
    pixels[101] = {6, 6, 7, 255};
    const Bytes whole = encoded(pixels);
    Pixels out(pixels.size());
    ASSERT_TRUE(decode_rle(whole, out));
    for (std::size_t cut = 0; cut < whole.size(); ++cut) {
        EXPECT_FALSE(decode_rle(std::span(whole).first(cut), out)) << cut;
    }
    Pixels fewer(pixels.size() - 1), more(pixels.size() + 1);
    EXPECT_FALSE(decode_rle(whole, fewer));
    EXPECT_FALSE(decode_rle(whole, more));
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(decode_rle(longer, out));
    EXPECT_EQ(decode_rle(bytes_of({0xff, 0xff, 1, 2, 3}), out).error().code, base::Code::corrupt);
}

TEST(Rle, FuzzedBytesNeverCrashAndNeverWriteBeyondThePicture) {
    std::mt19937 random(2);
    for (int round = 0; round < 20000; ++round) {
        Bytes bytes(random() % 40);
        for (std::byte& b : bytes) {
            b = static_cast<std::byte>(random());
        }
        Pixels out(random() % 300);
        if (decode_rle(bytes, out)) {
            Pixels back(out.size());
            EXPECT_TRUE(decode_rle(encoded(out), back));
            EXPECT_EQ(back, out);
        }
    }
}

Bytes noise(std::size_t size, unsigned seed) {
    std::mt19937 random(seed);
    Bytes bytes(size);
    for (std::byte& b : bytes) {
        b = static_cast<std::byte>(random());
    }
    return bytes;
}

TEST(Deflate, ComesBackExactlyAtItsLimit) {
    for (const std::size_t size : {0, 1, 1000, 65536, 65537, 300000}) {
        for (const Bytes& bytes : {Bytes(size, std::byte{7}), noise(size, 3)}) {
            const auto back = inflate(deflate(bytes), size);
            ASSERT_TRUE(back) << back.error().message();
            EXPECT_EQ(*back, bytes);
            if (size > 0) {
                EXPECT_EQ(inflate(deflate(bytes), size - 1).error().code, base::Code::too_large);
            }
        }
    }
}

TEST(Deflate, ABombStopsAtTheLimit) {
    const Bytes bomb = deflate(Bytes(std::size_t{64} << 20), 9);
    ASSERT_LT(bomb.size(), 100000u);
    EXPECT_EQ(inflate(bomb, 1 << 16).error().code, base::Code::too_large);
}

TEST(Deflate, EveryTruncationAndWhatFollowsIsRefused) {
    const Bytes whole = deflate(noise(500, 4));
    for (std::size_t cut = 0; cut < whole.size(); ++cut) {
        EXPECT_FALSE(inflate(std::span(whole).first(cut), 500)) << cut;
    }
    Bytes longer = whole;
    longer.push_back(std::byte{0});
    EXPECT_EQ(inflate(longer, 500).error().code, base::Code::corrupt);
}

TEST(Deflate, FuzzedStreamsNeverCrash) {
    const Bytes whole = deflate(Bytes(5000, std::byte{1}));
    std::mt19937 random(5);
    for (int round = 0; round < 5000; ++round) {
        Bytes bytes = round % 2 == 0 ? whole : noise(1 + random() % 60, random());
        bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        const auto out = inflate(bytes, 8192);
        EXPECT_TRUE(!out || out->size() <= 8192);
    }
}

}  // namespace
}  // namespace shearwater::image
