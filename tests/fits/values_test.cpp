// Values of every type, and boxes of them.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::fits {
namespace {

using support::FitsImage;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class Values : public testing::Test {
  protected:
    std::vector<float> written_and_read(const FitsImage& image) {
        support::write_fits(path_, {image});
        return read_whole(path_);
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("cube.fits");
};

std::vector<double> counting(std::size_t count, double from) {
    std::vector<double> values(count);
    std::iota(values.begin(), values.end(), from);
    return values;
}

TEST_F(Values, EveryTypePlainAndScaled) {
    for (const int bitpix : {8, 16, 32, 64, -32, -64}) {
        FitsImage image{.bitpix = bitpix, .axes = {3, 4, 5}, .raw = counting(60, bitpix == 8 ? 0 : -30)};
        std::vector<float> expected(image.raw.begin(), image.raw.end());
        expect_same(written_and_read(image), expected);
        EXPECT_EQ(Cube::open(path_)->info().bitpix, bitpix);

        image.scale = 0.25;
        image.zero = -3.5;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            expected[i] = static_cast<float>(image.raw[i] * 0.25 - 3.5);
        }
        expect_same(written_and_read(image), expected);
    }
}

TEST_F(Values, UnsignedIntegersAreShiftedSignedOnes) {
    const std::vector<double> raw = {-32768, -1, 0, 1, 100, 200, 300, 32767};
    const FitsImage image{.bitpix = 16, .axes = {2, 2, 2}, .raw = raw, .scale = 1, .zero = 32768};
    expect_same(written_and_read(image), {0, 32767, 32768, 32769, 32868, 32968, 33068, 65535});
    const FitsImage wide{
        .bitpix = 32, .axes = {2, 2, 2}, .raw = {-2147483648.0, 0, 1, 2, 3, 4, 5, 6}, .zero = 2147483648.0};
    EXPECT_EQ(written_and_read(wide)[0], 0);
    const FitsImage widest{
        .bitpix = 64, .axes = {2, 2, 2}, .raw = counting(8, 0), .zero = 9223372036854775808.0};
    EXPECT_EQ(written_and_read(widest)[0], 0x1p63F);
    const FitsImage bytes{.bitpix = 8, .axes = {2, 2, 2}, .raw = counting(8, 0), .zero = -128};
    EXPECT_EQ(written_and_read(bytes)[7], -121);
}

TEST_F(Values, BlankIntegersAreNaN) {
    for (const int bitpix : {8, 16, 32, 64}) {
        const FitsImage image{
            .bitpix = bitpix, .axes = {2, 2, 2}, .raw = counting(8, 0), .blank = 3, .scale = 2, .zero = 1};
        expect_same(written_and_read(image), {1, 3, 5, nan, 9, 11, 13, 15});
    }
}

TEST_F(Values, BlankAmongFloatsIsIgnoredAndSaid) {
    for (const int bitpix : {-32, -64}) {
        const FitsImage image{.bitpix = bitpix, .axes = {2, 2, 2}, .raw = counting(8, 0), .blank = 3};
        expect_same(written_and_read(image), {0, 1, 2, 3, 4, 5, 6, 7});
        EXPECT_THAT(Cube::open(path_)->info().notes, testing::Contains(testing::HasSubstr("BLANK")));
    }
}

TEST_F(Values, FloatsComeThroughAsStored) {
    const std::vector<double> raw = {nan, infinity, -infinity, 1e-40, -1e-45, 0, 3e38, -3e38};
    const FitsImage image{.bitpix = -32, .axes = {2, 2, 2}, .raw = raw};
    expect_same(written_and_read(image), {nan, infinity, -infinity, 1e-40F, -1e-45F, 0, 3e38F, -3e38F});
}

TEST_F(Values, DoublesBeyondSinglePrecisionAreInfinite) {
    const std::vector<double> raw = {nan, infinity, 1e300, -1e300, 1e-300, 7e-31, 1, 2};
    const FitsImage image{.bitpix = -64, .axes = {2, 2, 2}, .raw = raw};
    expect_same(written_and_read(image), {nan, infinity, infinity, -infinity, 0, 7e-31F, 1, 2});
}

TEST_F(Values, ScaleOfZeroIsAConstantCube) {
    const FitsImage image{
        .bitpix = 16, .axes = {2, 2, 2}, .raw = counting(8, 0), .blank = 3, .scale = 0, .zero = 5};
    expect_same(written_and_read(image), {5, 5, 5, nan, 5, 5, 5, 5});
    EXPECT_THAT(Cube::open(path_)->info().notes, testing::Contains(testing::HasSubstr("BSCALE is 0")));
}

// Every box of a small cube, in a file of five axes so that others stand between and behind.
TEST_F(Values, BoxesEqualPartsOfTheWhole) {
    const volume::Index3 n{4, 3, 5};
    for (const int bitpix : {16, -32, -64}) {
        support::write_fits(path_, {{.bitpix = bitpix, .axes = {4, 1, 3, 5, 1}, .raw = counting(60, 0)}});
        auto cube = Cube::open(path_);
        ASSERT_TRUE(cube);
        ASSERT_EQ(cube->info().n, n);
        const std::vector<float> whole = read_box(*cube, volume::whole(n));
        for (std::int64_t x = 0; x < 4; ++x) {
            for (std::int64_t y = 0; y < 3; ++y) {
                for (std::int64_t z = 0; z < 5; ++z) {
                    for (const volume::Index3 size :
                         {volume::Index3{3, 2, 4}, {1, 1, 2}, {3, 0, 0}, {0, 2, 1}}) {
                        const volume::Box box{
                            {x, y, z},
                            {std::min<std::int64_t>(3, x + size[0]), std::min<std::int64_t>(2, y + size[1]),
                             std::min<std::int64_t>(4, z + size[2])}};
                        std::vector<float> expected;
                        for (std::int64_t k = z; k <= box.hi[2]; ++k) {
                            for (std::int64_t j = y; j <= box.hi[1]; ++j) {
                                for (std::int64_t i = x; i <= box.hi[0]; ++i) {
                                    expected.push_back(whole[static_cast<std::size_t>(i + 4 * (j + 3 * k))]);
                                }
                            }
                        }
                        expect_same(read_box(*cube, box), expected);
                    }
                }
            }
        }
    }
}

TEST_F(Values, ManyDoublesAreReadPartByPart) {
    const std::vector<double> raw = counting(std::size_t{200} * 150 * 50, -1000);
    support::write_fits(path_, {{.bitpix = -64, .axes = {200, 150, 50}, .raw = raw}});
    expect_same(read_whole(path_), std::vector<float>(raw.begin(), raw.end()));
}

TEST_F(Values, HandlesOfOneFileAreIndependent) {
    support::write_fits(path_, {{.axes = {4, 4, 4}, .raw = counting(64, 0)}});
    auto first = Cube::open(path_);
    auto second = Cube::open(path_);
    ASSERT_TRUE(first && second);
    first = std::move(*second);
    expect_same(read_box(*first, {{3, 3, 3}, {3, 3, 3}}), {63});
}

TEST_F(Values, NamesArePlain) {
    const std::string odd = folder_.path("cube.fits[1][1:2,*] !+3.fits");
    support::write_fits(
        odd, {{.axes = {2, 2, 2}, .raw = counting(8, 0), .texts = {{"OBJECT", "M 31"}, {"BUNIT", "K"}}}});
    auto cube = Cube::open(odd);
    ASSERT_TRUE(cube) << cube.error().message();
    EXPECT_EQ(cube->info().object, "M 31");
    EXPECT_EQ(cube->info().unit, "K");
    EXPECT_EQ(cube->info().path, odd);
    expect_same(read_box(*cube, volume::whole({2, 2, 2})), {0, 1, 2, 3, 4, 5, 6, 7});
    EXPECT_EQ(open_error(folder_.path("cube.fits")).code, base::Code::not_found);
}

TEST_F(Values, GzipGivesTheSame) {
    support::write_fits(path_,
                        {{.bitpix = 16, .axes = {20, 30, 40}, .raw = counting(24000, -12000), .blank = 7}});
    const std::string packed = folder_.path("cube.fits.gz");
    support::gzip(path_, packed);
    expect_same(read_whole(packed), read_whole(path_));
    // Two members, one after the other, are one file; zeros behind are padding.
    const std::string bytes = support::slurp(path_);
    support::spill(folder_.path("a"), bytes.substr(0, 10000));
    support::spill(folder_.path("b"), bytes.substr(10000));
    support::gzip(folder_.path("a"), folder_.path("a.gz"));
    support::gzip(folder_.path("b"), folder_.path("b.gz"));
    support::spill(packed, support::slurp(folder_.path("a.gz")) + support::slurp(folder_.path("b.gz")) +
                               std::string(512, '\0'));
    expect_same(read_whole(packed), read_whole(path_));
}

TEST_F(Values, MissingPaddingDoesNoHarm) {
    support::write_fits(path_, {{.axes = {5, 6, 7}, .raw = counting(210, 0)}});
    const std::vector<float> expected = read_whole(path_);
    const std::string bytes = support::slurp(path_);
    support::spill(path_, bytes.substr(0, 2880 + 210 * 4));
    expect_same(read_whole(path_), expected);
    auto cube = Cube::open(path_);
    EXPECT_EQ(read_box(*cube, {{4, 5, 6}, {4, 5, 6}})[0], 209);
    EXPECT_THAT(cube->info().notes, testing::ElementsAre(testing::HasSubstr("2040 bytes short")));
    const std::string packed = folder_.path("cube.fits.gz");
    support::gzip(path_, packed);
    expect_same(read_whole(packed), expected);
}

TEST_F(Values, MissingPaddingOfACompressedImageDoesNoHarm) {
    support::write_fits(path_,
                        {{.bitpix = 32, .axes = {5, 6, 7}, .raw = counting(210, 0), .compression = 11}});
    const std::vector<float> expected = read_whole(path_);
    const std::string bytes = support::slurp(path_);
    ASSERT_EQ(bytes.substr(bytes.size() - 100), std::string(100, '\0'));
    support::spill(path_, bytes.substr(0, bytes.size() - 100));
    expect_same(read_whole(path_), expected);
    EXPECT_THAT(Cube::open(path_)->info().notes, testing::ElementsAre(testing::HasSubstr("100 bytes short")));
}

}  // namespace
}  // namespace shearwater::fits
