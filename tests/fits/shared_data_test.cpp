// Real and hostile files: each opens with its shape and values, or is refused in clear words.

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "tests/fits/read_cube.h"

namespace shearwater::fits {
namespace {

namespace fs = std::filesystem;

const fs::path data = SHEARWATER_SHARED_DATA;

class SharedData : public testing::Test {
  protected:
    void SetUp() override {
        if (!fs::is_directory(data)) {
            GTEST_SKIP() << "the shared sample data are not at " << data;
        }
    }
};

struct Opens {
    const char* name;
    volume::Index3 n;
    int hdu;
    int bitpix;
    double min, max;  // of the valid values, as astropy reads them
    double blank_percent = 0;
    OpenOptions options = {};
};

const Opens cubes[] = {
    {"WEIN069.fits", {134, 70, 83}, 0, -32, -0.00171, 0.00858, 0.0},
    {"WFPC2u5780205r_c0fx.fits", {200, 200, 4}, 0, -32, -5.12, 3.74e+03, 0.0},
    {"allnan.fits", {28, 24, 20}, 0, -32, 0, 0, 100.0},
    {"astrodendro_3d.fits", {51, 51, 51}, 0, -32, -0.668, 8.28, 0.0},
    {"astrodendro_3d1.fits", {51, 51, 51}, 1, -32, -0.668, 8.28, 0.0},
    {"brainsmall.fits", {128, 128, 84}, 0, 8, 0, 202, 0.0},
    {"bscale_zero.fits", {16, 16, 16}, 0, 16, 5, 5, 0.0},
    {"carta_M17_SWex_unittest.fits", {31, 31, 5}, 0, -32, -0.0277, 0.0211, 53.4},
    {"carta_noise_3d_degen_casa.fits", {10, 10, 10}, 0, -32, -2.7, 3.17, 0.0},
    {"carta_noise_4d.fits", {10, 10, 5}, 0, -32, -2.44, 3.14, 0.0},
    {"carta_noise_4d_casa.fits", {10, 10, 5}, 0, -32, -2.42, 3.14, 0.0},
    {"comptel_drb.fits.gz", {60, 60, 25}, 0, -64, 5.85e-05, 18.3, 0.0},
    {"cta_stacked_cntcube.fits.gz", {200, 200, 20}, 0, -64, 0, 21, 0.0},
    {"ctrl_chars_header.fits", {16, 16, 16}, 0, 8, 0, 250, 0.0},
    {"dysmalpy_fdata_cube.fits.gz", {30, 30, 80}, 0, -64, 7.07e-31, 0.0057, 79.1},
    {"embryo_256.fits.gz", {256, 256, 256}, 0, 8, 0, 197, 0.0},
    {"eso121-g6.fits", {64, 64, 130}, 0, -32, -0.0091, 0.0441, 0.0},
    {"eso121_i32.fits", {64, 64, 65}, 0, 32, -0.0091, 0.0417, 0.0},
    {"fermi_gc_ccube_00.fits", {80, 80, 28}, 0, 32, 0, 47, 0.0},
    {"gll_iem_v07_gc.fits.gz", {80, 80, 28}, 0, -32, 8.07e-16, 5.67e-05, 0.0},
    {"headsq.fits", {64, 64, 93}, 0, 16, 0, 3.93e+03, 0.0},
    {"hydrogen_atom.fits", {128, 128, 128}, 0, 8, 0, 250, 0.0},
    {"iris_SJI_1400.fits", {37, 40, 62}, 0, -32, -200, 390, 0.0},
    {"kapteyn_ra_pol_freq_dec.fits", {35, 16, 41}, 0, -32, -5.8e+03, 5.8e+03, 0.0},
    {"l1448_13co.fits", {105, 105, 53}, 0, -32, -0.66, 4, 0.0},
    {"l1448_i16_blank.fits", {105, 105, 53}, 0, 16, -0.66, 4, 32.0},
    {"l1448_rice_q4.fits.fz", {105, 105, 53}, 1, -32, -0.647, 4.01, 0.0},
    {"lidc2_ct.fits", {256, 256, 133}, 0, 8, 0, 255, 0.0},
    {"marschnerlobb.fits", {43, 43, 43}, 0, 8, 0, 255, 0.0},
    {"muse_Central_Datacube_bkg.fits", {101, 101, 10}, 1, -64, -1.4, 399, 0.0},
    {"muse_subcub_mosaic.fits", {30, 30, 500}, 1, -32, -6.22, 7.71, 0.0},
    {"neghip.fits", {70, 70, 70}, 0, 8, 0, 255, 0.0},
    {"ngc6946.fits", {100, 100, 101}, 0, 16, -0.0412, 0.157, 0.0},
    {"ngc6946_masked_nan.fits", {100, 100, 101}, 0, -32, -0.011, 0.157, 85.6},
    {"ngc6946_rice.fits.fz", {100, 100, 101}, 1, 16, -0.0412, 0.157, 0.0},
    {"ngc6946_u8.fits", {100, 100, 101}, 0, 8, -0.0412, 0.157, 0.0},
    {"pcasl_4d.fits", {52, 68, 20}, 0, 16, 0, 2.61e+03, 0.0},
    {"quickclump_3d.fits", {10, 10, 10}, 0, 8, 0, 0, 0.0},
    {"trailing_junk.fits", {64, 64, 30}, 0, 16, -20, 280, 0.0},
    {"wein069_gzip2_tiles.fits.fz", {134, 70, 83}, 1, -32, -0.00171, 0.00858, 0.0},
};

struct Refused {
    const char* name;
    base::Code code;
    const char* detail;  // a part of it
};

const Refused others[] = {
    {"astrogo_issue-38.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 0 x 0)"},
    {"astropy_blank.fits", base::Code::unsupported, "three axes longer than 1 (HDU 0 is an image of 1 x 1)"},
    {"astropy_compressed_with_nan.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is empty, HDU 1 is an image of 12 x 12)"},
    {"astropy_group_invalid.fits", base::Code::unsupported, "three axes longer than 1 (HDU 0 is empty)"},
    {"astropy_header_newlines.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 1 x 1)"},
    {"astropy_m13_hcomp.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is empty, HDU 1 is an image of 300 x 300)"},
    {"astropy_random_groups.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is random groups)"},
    {"astropy_tab-time-last-axis.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 1 x 1 x 1, HDU 1 is a table)"},
    {"astropy_zerowidth.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 777777701 x 0, HDU 1 is a table, HDU 2 is a table, HDU "
     "3 is a table, ...)"},
    {"bad_bitpix.fits", base::Code::corrupt, "BITPIX is 24; FITS has 8, 16, 32, 64, -32 and -64"},
    {"brainsmall.den", base::Code::unsupported, "not a FITS file: it does not begin with \"SIMPLE  =\""},
    {"carta_empty2.fits", base::Code::corrupt, "the file is empty"},
    {"ch2bet.nii.gz", base::Code::unsupported, "not a FITS file inside the gzip stream"},
    {"checkercube.rvf", base::Code::unsupported, "not a FITS file: it does not begin with \"SIMPLE  =\""},
    {"claims_256GiB.fits", base::Code::corrupt,
     "the file is cut off: 274877904064 of 274877906944 data bytes are missing"},
    {"dup_missing_naxis.fits", base::Code::corrupt, "NAXIS2 is missing or not an integer"},
    {"huge_naxis_overflow.fits", base::Code::corrupt,
     "its 2000000000 x 2000000000 x 2000000000 values are more than any file can hold"},
    {"kapteyn_blankset16.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 20 x 20)"},
    {"neg_naxis.fits", base::Code::corrupt, "NAXIS3 is -5"},
    {"nomtam_issue49test.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 0, HDU 1 is a table)"},
    {"nomtam_m13real_rice.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is empty, HDU 1 is an image of 300 x 300)"},
    {"nomtam_test.fits.Z", base::Code::unsupported,
     "unsupported compression: packed by compress (.Z); unpack it first with uncompress"},
    {"nomtam_test.fits.bz2", base::Code::unsupported,
     "unsupported compression: packed by bzip2; unpack it first with bunzip2"},
    {"quickclump_1d.fits", base::Code::unsupported, "three axes longer than 1 (HDU 0 is an image of 10)"},
    {"quickclump_2d.fits", base::Code::unsupported,
     "three axes longer than 1 (HDU 0 is an image of 10 x 10)"},
    {"softpyramid.xvf", base::Code::unsupported, "not a FITS file: it does not begin with \"SIMPLE  =\""},
    {"sunpy_not_actually_fits.fits", base::Code::unsupported,
     "not a FITS file: it does not begin with \"SIMPLE  =\""},
    {"trunc_data_ngc6946.fits", base::Code::corrupt,
     "the file is cut off: 813856 of 2020000 data bytes are missing"},
    {"trunc_header_ngc6946.fits", base::Code::corrupt, "the header has no END: the file is cut off in it"},
    {"trunc_midstream.fits.gz", base::Code::corrupt,
     "the gzip stream is cut off after 362421 unpacked bytes"},
};

TEST_F(SharedData, CubesOpenWithTheirShapesAndValues) {
    for (const Opens& expected : cubes) {
        SCOPED_TRACE(expected.name);
        auto cube = Cube::open(data / expected.name, expected.options);
        ASSERT_TRUE(cube) << cube.error().message();
        EXPECT_EQ(cube->info().n, expected.n);
        EXPECT_EQ(cube->info().hdu, expected.hdu);
        EXPECT_EQ(cube->info().bitpix, expected.bitpix);
        const std::vector<float> values = read_box(*cube, volume::whole(expected.n));
        float min = std::numeric_limits<float>::infinity();
        float max = -min;
        double blank = 0;
        for (const float value : values) {
            if (!std::isfinite(value)) {
                ++blank;
                continue;
            }
            min = std::min(min, value);
            max = std::max(max, value);
        }
        EXPECT_NEAR(100 * blank / static_cast<double>(values.size()), expected.blank_percent, 0.06);
        if (expected.blank_percent < 100) {
            EXPECT_NEAR(min, expected.min, 0.006 * std::abs(expected.min));
            EXPECT_NEAR(max, expected.max, 0.006 * std::abs(expected.max));
        }
    }
}

TEST_F(SharedData, OthersAreRefusedInClearWords) {
    for (const Refused& expected : others) {
        const base::Error error = open_error(data / expected.name);
        EXPECT_EQ(error.code, expected.code) << expected.name;
        EXPECT_THAT(error.detail, testing::HasSubstr(expected.detail)) << expected.name;
        EXPECT_THAT(error.operation, testing::HasSubstr(expected.name));
    }
}

TEST_F(SharedData, EveryFileIsInOneOfTheTables) {
    for (const auto& entry : fs::recursive_directory_iterator(data)) {
        const std::string name = fs::relative(entry.path(), data).string();
        const auto named = [&](const auto& row) { return row.name == name; };
        const bool series = name.starts_with("eit_series/") || name.starts_with("pcasl_series/");
        EXPECT_TRUE(!entry.is_regular_file() || name == "MANIFEST.md" || series ||
                    std::any_of(std::begin(cubes), std::end(cubes), named) ||
                    std::any_of(std::begin(others), std::end(others), named))
            << name;
        if (series) {
            const auto cube = Cube::open(entry.path());
            EXPECT_EQ(static_cast<bool>(cube), name.starts_with("pcasl_series/")) << name;
        }
    }
}

TEST_F(SharedData, LosslessCompressionGivesTheSameValues) {
    expect_same(read_whole(data / "ngc6946_rice.fits.fz"), read_whole(data / "ngc6946.fits"));
    expect_same(read_whole(data / "wein069_gzip2_tiles.fits.fz"), read_whole(data / "WEIN069.fits"));
}

TEST_F(SharedData, QuantisedCompressionGivesValuesWithinTheNoise) {
    const std::vector<float> original = read_whole(data / "l1448_13co.fits");
    const std::vector<float> lossy = read_whole(data / "l1448_rice_q4.fits.fz");
    ASSERT_EQ(original.size(), lossy.size());
    for (std::size_t i = 0; i < original.size(); ++i) {
        ASSERT_NEAR(original[i], lossy[i], 0.06) << i;
    }
}

TEST_F(SharedData, ThePlanesOfATimeSeriesAreItsFiles) {
    for (std::int64_t plane = 0; plane < 10; ++plane) {
        const std::string file = "pcasl_series/pcasl_t0" + std::to_string(plane) + ".fits";
        expect_same(read_whole(data / "pcasl_4d.fits", {.hdu = {}, .plane = plane}), read_whole(data / file));
    }
}

TEST_F(SharedData, ControlCharactersOfAHeaderNeverComeThrough) {
    const auto cube = Cube::open(data / "ctrl_chars_header.fits");
    ASSERT_TRUE(cube);
    for (const std::string& text : {cube->info().object, cube->info().unit}) {
        EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    }
}

}  // namespace
}  // namespace shearwater::fits
