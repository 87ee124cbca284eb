// Tile-compressed images, sound and hostile.

#include <fitsio.h>
#include <gmock/gmock.h>

#include <random>

#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

// cfitsio forgets a few bytes where a decoder gives up on a damaged stream: not a leak of ours.
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libcfitsio";
}

namespace shearwater::fits {
namespace {

using support::FitsImage;
using testing::HasSubstr;

FitsImage noisy(int bitpix, int compression) {
    std::mt19937 random(5);
    FitsImage image{.bitpix = bitpix, .axes = {17, 13, 11}, .raw = std::vector<double>(17 * 13 * 11)};
    for (double& value : image.raw) {
        value = static_cast<double>(random() % 200);
    }
    image.compression = compression;
    return image;
}

class Compressed : public testing::Test {
  protected:
    // The file of one compressed cube, with one 80-character card of its second HDU replaced.
    void write_with(const FitsImage& image, const std::string& card) {
        support::write_fits(path_, {image});
        std::string bytes = support::slurp(path_);
        const std::size_t at = bytes.find(card.substr(0, 9), 2880);
        ASSERT_NE(at, std::string::npos);
        std::string padded = card;
        padded.resize(80, ' ');
        bytes.replace(at, 80, padded);
        support::spill(path_, bytes);
    }

    // Of reading the whole of a file that opens.
    base::Error read_error() {
        auto cube = Cube::open(path_);
        EXPECT_TRUE(cube) << (cube ? "" : cube.error().message());
        std::vector<float> values(17 * 13 * 11);
        const base::Status status = cube->read(volume::whole({17, 13, 11}), values);
        EXPECT_FALSE(status);
        return status ? base::Error{} : status.error();
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("cube.fits.fz");
};

TEST_F(Compressed, EveryCodecGivesThePlainValues) {
    const std::vector<std::pair<int, int>> kinds = {{16, RICE_1},  {8, RICE_1},   {32, RICE_1},
                                                    {16, GZIP_1},  {32, GZIP_2},  {-32, GZIP_1},
                                                    {-32, GZIP_2}, {-64, GZIP_2}, {16, PLIO_1}};
    for (const auto& [bitpix, compression] : kinds) {
        FitsImage image = noisy(bitpix, compression);
        const std::vector<float> expected(image.raw.begin(), image.raw.end());
        for (const std::vector<long>& tile : {std::vector<long>{}, {5, 4, 3}, {17, 13, 1}}) {
            image.tile = tile;
            support::write_fits(path_, {image});
            auto cube = Cube::open(path_);
            ASSERT_TRUE(cube) << cube.error().message();
            EXPECT_EQ(cube->info().hdu, 1);
            EXPECT_EQ(cube->info().bitpix, bitpix);
            expect_same(read_box(*cube, volume::whole({17, 13, 11})), expected);
            EXPECT_EQ(read_box(*cube, {{3, 5, 7}, {16, 12, 10}})[0], expected[3 + 17 * (5 + 13 * 7)]);
        }
    }
}

TEST_F(Compressed, HcompressGivesThePlainValues) {
    FitsImage image = noisy(16, HCOMPRESS_1);
    image.tile = {17, 13, 1};
    support::write_fits(path_, {image});
    expect_same(read_whole(path_), std::vector<float>(image.raw.begin(), image.raw.end()));
}

// A row can be had alone where tiles are rows.
TEST_F(Compressed, RowsAreGivenByRowsOfTiles) {
    const auto gives_rows = [&](const FitsImage& image) {
        support::write_fits(path_, {image});
        return Cube::open(path_).value().gives_rows();
    };
    FitsImage image = noisy(16, RICE_1);
    EXPECT_TRUE(gives_rows(image)) << "cfitsio's own tiles";
    image.tile = {5, 1, 1};
    EXPECT_TRUE(gives_rows(image));
    for (const std::vector<long>& tile :
         {std::vector<long>{17, 2, 1}, {17, 1, 3}, {17, 13, 11}, {1, 13, 1}}) {
        image.tile = tile;
        EXPECT_FALSE(gives_rows(image));
    }
    image.tile = {};
    image.compression = 0;
    EXPECT_TRUE(gives_rows(image));
}

TEST_F(Compressed, BlankAndScaleStay) {
    FitsImage image = noisy(16, RICE_1);
    image.blank = 7;
    image.scale = 0.5;
    image.zero = 10;
    support::write_fits(path_, {image});
    const std::vector<float> values = read_whole(path_);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (image.raw[i] == 7) {
            EXPECT_TRUE(std::isnan(values[i]));
        } else {
            EXPECT_EQ(values[i], 0.5F * static_cast<float>(image.raw[i]) + 10);
        }
    }
}

TEST_F(Compressed, HeadersThatContradictThemselvesAreRefused) {
    const std::pair<std::string, std::string> cases[] = {
        {support::card("ZTILE1", 0), "ZTILE1"},
        {"ZTILE1  =                    F", "ZTILE1"},
        {"ZTILE1  =                  0.5", "ZTILE1"},

        {support::card("ZTILE1", -4), "ZTILE1"},
        {support::card("ZTILE1", 2147483647), "ZTILE1"},
        {support::card("ZTILE2", 9223372036854775807), "ZTILE2"},
        {support::card("ZTILE1", 16), "tiles"},
        {support::card("ZNAXIS1", 0), "ZNAXIS1"},
        {support::card("ZNAXIS2", -1), "ZNAXIS2"},
        {support::card("ZNAXIS2", 9223372036854775807), "ZNAXIS"},
        {support::card("ZNAXIS", 99), "ZNAXIS"},
        {support::card("ZNAXIS3", 1000), "tiles"},
        {support::card("ZBITPIX", 12), "ZBITPIX"},
        {"ZCMPTYPE= 'LZMA    '", "unsupported compression"},
        {support::card("ZVAL1", 2000000), "parameters of its compression"},
        {support::card("ZVAL2", 3), "parameters of its compression"},
        {"TFORM1  = '3ZZ     '", "columns"},
        {"TFORM1  = '99999999PB(1)'", "columns"},
        {support::card("TFIELDS", 0), "columns"},
        {support::card("PCOUNT", 9223372036854775807), "more than any file"},
        {support::card("PCOUNT", 100000000), "missing"},
        {support::card("NAXIS1", 99999999), "impossible shape"},
    };
    for (const auto& [card, expected] : cases) {
        write_with(noisy(16, RICE_1), card);
        EXPECT_THAT(open_error(path_).message(), HasSubstr(expected)) << card;
    }
}

TEST_F(Compressed, AHugeImageInFewBytesIsRefused) {
    // One tile for all: the number of rows agrees, and only the bytes are far too few.
    FitsImage image = noisy(16, RICE_1);
    image.tile = {17, 13, 11};
    write_with(image, support::card("ZNAXIS1", 500000));
    std::string bytes = support::slurp(path_);
    const std::size_t at = bytes.find("ZTILE1  =");
    std::string tile = support::card("ZTILE1", 500000);
    tile.resize(80, ' ');
    bytes.replace(at, 80, tile);
    support::spill(path_, bytes);
    EXPECT_THAT(open_error(path_).message(), HasSubstr("cannot hold"));
}

TEST_F(Compressed, TilesOutsideTheHeapAreRefused) {
    support::write_fits(path_, {noisy(16, RICE_1)});
    const std::string sound = support::slurp(path_);
    // The rows of descriptors follow the table's header: the first one's length, then its offset.
    const std::size_t end = sound.find("END     ", 2880 + 80);
    const std::size_t rows = (end / 2880 + 1) * 2880;
    for (const std::size_t byte : {rows, rows + 4, rows + 8 * 50, rows + 8 * 50 + 4}) {
        for (const char hostile : {'\x7f', '\xff'}) {
            std::string bytes = sound;
            bytes[byte] = hostile;
            support::spill(path_, bytes);
            EXPECT_THAT(read_error().message(),
                        testing::AnyOf(HasSubstr("outside"), HasSubstr("more compressed bytes")))
                << byte;
        }
    }
}

TEST_F(Compressed, HcompressStreamsOfAnotherShapeAreRefused) {
    FitsImage image = noisy(16, HCOMPRESS_1);
    image.tile = {17, 13, 1};
    support::write_fits(path_, {image});
    std::string bytes = support::slurp(path_);
    const std::size_t stream = bytes.find("\xdd\x99");
    ASSERT_NE(stream, std::string::npos);
    bytes[stream + 3] = '\x10';  // of its first length
    support::spill(path_, bytes);
    EXPECT_THAT(read_error().message(), HasSubstr("tile 0 is damaged"));
}

// Damage in the compressed bytes themselves: an error or other values, but no crash.
TEST_F(Compressed, DamagedStreamsDoNoHarm) {
    std::mt19937 random(17);
    for (const int compression : {RICE_1, GZIP_1, GZIP_2, HCOMPRESS_1, PLIO_1}) {
        FitsImage image = noisy(16, compression);
        image.tile = {17, 13, 1};
        support::write_fits(path_, {image});
        const std::string sound = support::slurp(path_);
        const std::size_t data = (sound.find("END     ", 2880 + 80) / 2880 + 1) * 2880;
        for (int trial = 0; trial < 60; ++trial) {
            std::string bytes = sound;
            for (int i = 0; i < 4; ++i) {
                bytes[data + 100 + random() % (bytes.size() - data - 100)] = static_cast<char>(random());
            }
            support::spill(path_, bytes);
            if (auto cube = Cube::open(path_)) {
                std::vector<float> values(17 * 13 * 11);
                static_cast<void>(cube->read(volume::whole(cube->info().n), values));
            }
        }
    }
}

}  // namespace
}  // namespace shearwater::fits
