// Files that are no cubes, and headers that lie.

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <numeric>

#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::fits {
namespace {

using base::Code;
using support::card;
using testing::HasSubstr;

const std::string simple = "SIMPLE  =                    T";

class Hostile : public testing::Test {
  protected:
    base::Error error_of(const std::string& bytes) {
        support::spill(path_, bytes);
        const base::Error error = open_error(path_);
        EXPECT_THAT(error.message(), testing::Not(HasSubstr("\n")));
        EXPECT_FALSE(error.detail.empty());
        return error;
    }
    std::string header(std::vector<std::string> cards) {
        cards.insert(cards.begin(), simple);
        return support::header_of(cards);
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("file.fits");
};

TEST_F(Hostile, WhatIsNoRegularFileIsRefusedAtOnce) {
    EXPECT_EQ(open_error(folder_.path("absent")).code, Code::not_found);
    EXPECT_THAT(open_error(folder_.path("")).detail, HasSubstr("directory"));
    const std::string fifo = folder_.path("fifo");
    ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
    EXPECT_THAT(open_error(fifo).detail, HasSubstr("not a regular file"));
    EXPECT_THAT(open_error("/dev/zero").detail, HasSubstr("not a regular file"));
    if (::geteuid() != 0) {
        support::spill(path_, "SIMPLE");
        ::chmod(path_.c_str(), 0);
        EXPECT_EQ(open_error(path_).code, Code::io);
    }
}

TEST_F(Hostile, WhatIsNotFitsIsNamed) {
    EXPECT_THAT(error_of("").detail, HasSubstr("empty"));
    EXPECT_THAT(error_of("S").detail, HasSubstr("not a FITS file"));
    EXPECT_THAT(error_of("hello, world").detail, HasSubstr("not a FITS file"));
    EXPECT_THAT(error_of(std::string(5000, '\0')).detail, HasSubstr("not a FITS file"));
    EXPECT_THAT(error_of("BZh91AY&SY").detail, HasSubstr("bzip2"));
    EXPECT_THAT(error_of("\x1f\x9d\x90 abcdefg").detail, HasSubstr("uncompress"));
    EXPECT_THAT(error_of("\xfd"
                         "7zXZ0000")
                    .detail,
                HasSubstr("xz"));
    EXPECT_THAT(error_of("\x28\xb5\x2f\xfd 0000").detail, HasSubstr("zstd"));
    EXPECT_THAT(error_of("PK\x03\x04 0000").detail, HasSubstr("zip"));
}

TEST_F(Hostile, HeadersThatContradictThemselvesAreRefused) {
    const std::string data(8192, '\0');
    const auto detail = [&](const std::vector<std::string>& cards) {
        return error_of(header(cards) + data).detail;
    };
    const std::string type = card("BITPIX", -32);
    EXPECT_THAT(detail({}), HasSubstr("BITPIX is missing"));
    EXPECT_THAT(detail({card("BITPIX", 24)}), HasSubstr("BITPIX is 24"));
    EXPECT_THAT(detail({"BITPIX  = 'float'"}), HasSubstr("BITPIX"));
    EXPECT_THAT(detail({type}), HasSubstr("NAXIS is missing"));
    EXPECT_THAT(detail({type, card("NAXIS", -1)}), HasSubstr("NAXIS is -1"));
    EXPECT_THAT(detail({type, card("NAXIS", 1000)}), HasSubstr("NAXIS is 1000"));
    EXPECT_THAT(detail({type, card("NAXIS", 3), card("NAXIS1", 9), card("NAXIS3", 9)}),
                HasSubstr("NAXIS2 is missing"));
    EXPECT_THAT(detail({type, card("NAXIS", 3), card("NAXIS1", 9), card("NAXIS2", 9), card("NAXIS3", -5)}),
                HasSubstr("NAXIS3 is -5"));
    EXPECT_THAT(detail({type, card("NAXIS", 3), card("NAXIS1", 9), card("NAXIS2", 9),
                        "NAXIS3  = 99999999999999999999"}),
                HasSubstr("NAXIS3"));
}

TEST_F(Hostile, AHeaderWithTwoShapesIsRefused) {
    const std::vector<std::string> cards = {card("BITPIX", 8), card("NAXIS", 3), card("NAXIS1", 4),
                                            card("NAXIS2", 4), card("NAXIS3", 4)};
    for (const std::string& again : {card("NAXIS2", 2), card("BITPIX", 16), card("NAXIS", 2)}) {
        std::vector<std::string> twice = cards;
        twice.push_back(again);
        const base::Error error = error_of(header(twice) + std::string(2880, '\0'));
        EXPECT_EQ(error.code, Code::corrupt);
        EXPECT_THAT(error.detail, HasSubstr("more than one shape"));
    }
}

TEST_F(Hostile, ClaimsBeyondTheFileAreRefusedBeforeAnythingIsAllocated) {
    const auto claiming = [&](std::int64_t n) {
        return error_of(header({card("BITPIX", -32), card("NAXIS", 3), card("NAXIS1", n), card("NAXIS2", n),
                                card("NAXIS3", n)}) +
                        std::string(2880, '\0'));
    };
    EXPECT_THAT(claiming(4096).detail, HasSubstr("274877904064 of 274877906944 data bytes are missing"));
    EXPECT_THAT(claiming(2000000000).detail, HasSubstr("more than any file can hold"));
    EXPECT_THAT(claiming(9223372036854775807).detail, HasSubstr("more than any file can hold"));
    EXPECT_EQ(claiming(4096).code, Code::corrupt);
}

TEST_F(Hostile, CutAnywhereAFileIsRefused) {
    support::write_fits(path_, {{.axes = {4, 5, 6}, .raw = std::vector<double>(120, 1.0)}});
    const std::string whole = support::slurp(path_);
    for (std::size_t size = 0; size < 2880 + 480; size += size < 2880 ? 97 : 13) {
        EXPECT_EQ(error_of(whole.substr(0, size)).code,
                  size < 9 && size > 0 ? Code::unsupported : Code::corrupt)
            << size;
    }
}

TEST_F(Hostile, CutAnywhereAGzipStreamIsRefused) {
    support::write_fits(path_, {{.axes = {4, 5, 6}, .raw = std::vector<double>(120, 1.0)}});
    const std::string packed = folder_.path("file.gz");
    support::gzip(path_, packed);
    const std::string whole = support::slurp(packed);
    for (std::size_t size = 2; size < whole.size(); ++size) {
        EXPECT_EQ(error_of(whole.substr(0, size)).code, Code::corrupt) << size;
    }
    std::string damaged = whole;
    damaged[whole.size() - 6] ^= 1;  // of its checksum
    EXPECT_THAT(error_of(damaged).detail, HasSubstr("damaged"));
}

TEST_F(Hostile, AGzipStreamOfSomethingElseIsGivenUpEarly) {
    const std::string packed = folder_.path("bomb.gz");
    gzFile file = gzopen(packed.c_str(), "wb");
    const std::string zeros(std::size_t{1} << 20, '\0');
    for (int i = 0; i < 64; ++i) {
        gzwrite(file, zeros.data(), static_cast<unsigned>(zeros.size()));
    }
    gzclose(file);
    EXPECT_THAT(open_error(packed).detail, HasSubstr("not a FITS file inside"));
}

TEST_F(Hostile, GroupsTablesAndEmptyImagesAreNoCubes) {
    EXPECT_THAT(error_of(header({card("BITPIX", 8), card("NAXIS", 0)})).detail, HasSubstr("HDU 0 is empty"));
    EXPECT_THAT(error_of(header({card("BITPIX", 8), card("NAXIS", 3), card("NAXIS1", 9), card("NAXIS2", 0),
                                 card("NAXIS3", 9)}))
                    .detail,
                HasSubstr("9 x 0 x 9"));
    EXPECT_THAT(error_of(header({card("BITPIX", -32), card("NAXIS", 4), card("NAXIS1", 0), card("NAXIS2", 3),
                                 card("NAXIS3", 4), card("NAXIS4", 5), "GROUPS  =                    T",
                                 card("PCOUNT", 6), card("GCOUNT", 10)}) +
                         std::string(2880, '\0'))
                    .detail,
                HasSubstr("random groups"));
}

TEST_F(Hostile, TheTextOfAHeaderIsMadePrintable) {
    support::spill(
        path_, header({card("BITPIX", 8), card("NAXIS", 3), card("NAXIS1", 2), card("NAXIS2", 2),
                       card("NAXIS3", 2), "OBJECT  = '\x1b[2J it''s \xc3\xa4'", "BUNIT   = 'K\n\r%n   '"}) +
                   std::string(2880, '\0'));
    const auto cube = Cube::open(path_);
    ASSERT_TRUE(cube) << cube.error().message();
    EXPECT_EQ(cube->info().object, "?[2J it's ??");
    EXPECT_EQ(cube->info().unit, "K??%n");
}

TEST_F(Hostile, ScalingThatIsNoNumberIsIgnoredAndSaid) {
    for (const std::string bad : {"BSCALE  = 'two'", "BSCALE  =                  NaN", "BSCALE  = 1E999"}) {
        support::spill(path_, header({card("BITPIX", 8), card("NAXIS", 3), card("NAXIS1", 2),
                                      card("NAXIS2", 2), card("NAXIS3", 2), bad}) +
                                  std::string(2880, '\3'));
        auto cube = Cube::open(path_);
        if (!cube) {
            EXPECT_EQ(cube.error().code, Code::corrupt) << bad;
            continue;
        }
        EXPECT_EQ(read_box(*cube, volume::whole({2, 2, 2}))[0], 3) << bad;
        EXPECT_THAT(cube->info().notes, testing::Contains(HasSubstr("BSCALE")));
    }
}

TEST_F(Hostile, JunkBehindTheCubeIsIgnoredAndSaid) {
    support::write_fits(path_, {{.axes = {2, 2, 2}, .raw = std::vector<double>(8, 1.0)}});
    support::spill(path_, support::slurp(path_) + std::string(4000, '#'));
    EXPECT_THAT(Cube::open(path_)->info().notes, testing::ElementsAre(HasSubstr("4000 bytes")));
}

TEST_F(Hostile, AFileThatShrinksWhileOpenGivesAnError) {
    std::vector<double> raw(64 * 64 * 16);
    std::iota(raw.begin(), raw.end(), 0);
    support::write_fits(path_, {{.axes = {64, 64, 16}, .raw = raw}});
    auto cube = Cube::open(path_);
    ASSERT_TRUE(cube);
    ASSERT_EQ(::truncate(path_.c_str(), 2880 * 20), 0);
    std::vector<float> values(64 * 64 * 16);
    const base::Status status = cube->read(volume::whole({64, 64, 16}), values);
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message(), HasSubstr(path_));
}

}  // namespace
}  // namespace shearwater::fits
