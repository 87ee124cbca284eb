// Headers of small files with bytes and cards changed at random: opened or refused, never a crash.

#include <fitsio.h>

#include <array>
#include <numeric>
#include <random>

#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::fits {
namespace {

using support::FitsImage;

constexpr std::array<const char*, 18> words = {"0",
                                               "-1",
                                               "1",
                                               "2",
                                               "9",
                                               "255",
                                               "65536",
                                               "2147483647",
                                               "2147483648",
                                               "9223372036854775807",
                                               "-9223372036854775808",
                                               "1E400",
                                               "-1E38",
                                               "NaN",
                                               "T",
                                               "F",
                                               "'text'",
                                               "'1QB(99)'"};

// Changes some bytes anywhere in the header, or the value of one of its cards.
void mutate(std::string& bytes, std::size_t header_bytes, std::mt19937& random) {
    if (random() % 2 == 0) {
        for (unsigned i = 0; i < 1 + random() % 4; ++i) {
            bytes[random() % header_bytes] = static_cast<char>(random());
        }
        return;
    }
    const std::size_t card = random() % (header_bytes / 80) * 80;
    if (bytes[card + 8] == '=') {
        std::string value = words[random() % words.size()];
        value.insert(0, 20 - std::min<std::size_t>(20, value.size()), ' ');
        value.resize(70, ' ');
        bytes.replace(card + 10, 70, value);
    } else {
        bytes.replace(card, 80, bytes.substr(random() % (header_bytes / 80) * 80, 80));
    }
}

void fuzz(const FitsImage& image, int trials, unsigned seed) {
    const support::TemporaryFolder folder;
    const std::string path = folder.path("fuzzed.fits");
    support::write_fits(path, {image});
    const std::string sound = support::slurp(path);
    const std::size_t header_bytes = (sound.rfind("END     ") / 2880 + 1) * 2880;
    std::mt19937 random(seed);
    int opened = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::string bytes = sound;
        for (unsigned i = 0; i < 1 + random() % 3; ++i) {
            mutate(bytes, header_bytes, random);
        }
        support::spill(path, bytes);
        auto cube = Cube::open(path, {.world = true});
        if (!cube) {
            EXPECT_FALSE(cube.error().detail.empty());
            continue;
        }
        ++opened;
        for (int along = 0; along < 3; ++along) {
            EXPECT_TRUE(wcs::validate(cube->info().world[static_cast<std::size_t>(along)], along));
        }
        const volume::Index3 n = cube->info().n;
        ASSERT_LE(volume::voxel_count(n), static_cast<std::int64_t>(bytes.size() * 20000));
        if (volume::voxel_count(n) < 1 << 22) {
            std::vector<float> values(static_cast<std::size_t>(volume::voxel_count(n)));
            static_cast<void>(cube->read(volume::whole(n), values));
        }
    }
    EXPECT_GT(opened, 0);
    EXPECT_LT(opened, trials);
}

FitsImage counting(int bitpix) {
    FitsImage image{.bitpix = bitpix, .axes = {6, 5, 4}, .raw = std::vector<double>(120)};
    std::iota(image.raw.begin(), image.raw.end(), 0);
    image.scale = 2;
    image.zero = 1;
    image.texts = {{"CTYPE1", "RA---SIN"}, {"CTYPE2", "DEC--SIN"}, {"CTYPE3", "VELO-LSR"},
                   {"CUNIT1", "deg"},      {"CUNIT3", "km/s"},     {"OBJECT", "fuzz"}};
    return image;
}

TEST(HeaderFuzz, Integers) {
    FitsImage image = counting(16);
    image.blank = 5;
    fuzz(image, 4000, 1);
}

TEST(HeaderFuzz, Doubles) {
    fuzz(counting(-64), 4000, 2);
}

TEST(HeaderFuzz, TilesOfRice) {
    FitsImage image = counting(16);
    image.compression = RICE_1;
    fuzz(image, 6000, 3);
}

TEST(HeaderFuzz, TilesOfGzip) {
    FitsImage image = counting(-32);
    image.compression = GZIP_2;
    image.tile = {3, 5, 2};
    fuzz(image, 6000, 4);
}

TEST(HeaderFuzz, TilesOfHcompress) {
    FitsImage image = counting(32);
    image.compression = HCOMPRESS_1;
    image.tile = {6, 5, 1};
    fuzz(image, 4000, 5);
}

}  // namespace
}  // namespace shearwater::fits
