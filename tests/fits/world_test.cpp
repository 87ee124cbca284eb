// World coordinates from headers, against numbers that come from no library.

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "common/wcs/text.h"
#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::fits {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double degrees = 180 / M_PI;

using Cards = std::vector<std::string>;

std::string real(const std::string& keyword, double value) {
    return fmt::format("{:<8}= {:>20.13G}", keyword, value);
}
std::string text(const std::string& keyword, const std::string& value) {
    return fmt::format("{:<8}= '{:<8}'", keyword, value);
}
// Type, value, pixel and step of one axis.
Cards axis(int number, const std::string& type, double at, double pixel, double step,
           const std::string& unit = "") {
    const std::string n = std::to_string(number);
    Cards cards{text("CTYPE" + n, type), real("CRVAL" + n, at), real("CRPIX" + n, pixel),
                real("CDELT" + n, step)};
    if (!unit.empty()) {
        cards.push_back(text("CUNIT" + n, unit));
    }
    return cards;
}
Cards operator+(Cards a, const Cards& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

class World : public testing::Test {
  protected:
    CubeInfo open(const std::vector<std::int64_t>& lengths, const Cards& cards, OpenOptions options = {}) {
        Cards all{"SIMPLE  =                    T", support::card("BITPIX", 8),
                  support::card("NAXIS", static_cast<std::int64_t>(lengths.size()))};
        std::int64_t voxels = 1;
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            all.push_back(support::card("NAXIS" + std::to_string(i + 1), lengths[i]));
            voxels *= lengths[i];
        }
        const std::string data(static_cast<std::size_t>((voxels + 2879) / 2880 * 2880), '\0');
        support::spill(path_, support::header_of(all + cards) + data);
        options.world = true;
        const auto cube = Cube::open(path_, options);
        EXPECT_TRUE(cube) << (cube ? "" : cube.error().message());
        n_ = cube ? cube->info().n : volume::Index3{};
        return cube ? cube->info() : CubeInfo{};
    }
    double at(const wcs::Axis& axis, double x, double y, double z) const {
        return wcs::value_at(axis, n_, {x, y, z});
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("world.fits");
    volume::Index3 n_{};
    std::vector<std::string> notes_;
};

// RA and Dec at intermediate coordinates (xi, eta) in radians: the gnomonic projection as textbooks have it.
std::pair<double, double> tangent_plane(double ra0, double dec0, double xi, double eta) {
    const double d = dec0 / degrees;
    const double below = std::cos(d) - eta * std::sin(d);
    const double ra = std::atan2(xi, below);
    const double dec = std::atan2(std::sin(d) + eta * std::cos(d), std::hypot(below, xi));
    return {ra0 + ra * degrees, dec * degrees};
}

TEST_F(World, ALinearAxisIsLinear) {
    const CubeInfo info = open({9, 8, 11}, axis(3, "VRAD", 1.5e6, 3, 5000, "m/s"));
    const wcs::Axis& velocity = info.world[2];
    EXPECT_EQ(velocity.name, "radio velocity");
    EXPECT_EQ(velocity.unit, "km/s");
    EXPECT_EQ(velocity.nodes, (std::array{1, 1, 2}));
    EXPECT_NEAR(at(velocity, 0, 0, 2), 1500, 1e-9);  // FITS pixel 3
    EXPECT_NEAR(at(velocity, 4, 4, 0), 1490, 1e-9);
    EXPECT_NEAR(at(velocity, 4, 4, 10), 1540, 1e-9);
    EXPECT_FALSE(info.world[0].known());
    EXPECT_FALSE(info.world[1].known());
    EXPECT_THAT(info.notes, IsEmpty());
}

TEST_F(World, TangentPlaneByHand) {
    // One radian from the equator's point of contact lie 45 degrees, and atan(1 / sqrt 2) up from there.
    const double step = degrees / 64;
    const CubeInfo info =
        open({129, 129, 2}, axis(1, "RA---TAN", 180, 65, step) + axis(2, "DEC--TAN", 0, 65, step));
    EXPECT_NEAR(at(info.world[0], 64, 64, 0), 180, 1e-9);
    EXPECT_NEAR(at(info.world[0], 128, 64, 0), 225, 1e-9);
    EXPECT_NEAR(at(info.world[0], 0, 64, 1), 135, 1e-9);
    EXPECT_NEAR(at(info.world[1], 128, 128, 0), 35.264389682754654, 1e-9);
    EXPECT_NEAR(at(info.world[1], 64, 0, 0), -45, 1e-9);
}

TEST_F(World, TangentPlaneFarFromTheEquator) {
    const double step = 0.002;  // and a twentieth of a voxel is what the grid keeps to
    const CubeInfo info =
        open({301, 201, 2}, axis(1, "RA---TAN", 359.9, 120, -step, "deg") +
                                axis(2, "DEC--TAN", 75, 90, step, "deg") + Cards{real("EQUINOX", 2000)});
    EXPECT_EQ(info.world[0].name, "right ascension");
    EXPECT_EQ(info.world[0].notation, wcs::Notation::hours);
    EXPECT_EQ(info.world[1].name, "declination");
    for (double x = 0; x <= 300; x += 23.7) {
        for (double y = 0; y <= 200; y += 17.9) {
            const auto [ra, dec] =
                tangent_plane(359.9, 75, -step * (x - 119) / degrees, step * (y - 89) / degrees);
            EXPECT_NEAR(std::remainder(at(info.world[0], x, y, 0.5) - ra, 360) * std::cos(dec / degrees), 0,
                        step / 20);
            EXPECT_NEAR(at(info.world[1], x, y, 0.5), dec, step / 20);
        }
    }
}

TEST_F(World, ARotatedSkyFollowsWhatChangesMost) {
    // North to the right.
    const CubeInfo info = open(
        {65, 65, 2}, Cards{text("CTYPE1", "RA---TAN"), text("CTYPE2", "DEC--TAN"), real("CRVAL1", 30),
                           real("CRVAL2", 10), real("CRPIX1", 33), real("CRPIX2", 33), real("CD1_2", -0.01),
                           real("CD2_1", 0.01), real("CDELT3", 4), text("CTYPE3", "CHANNEL")});
    EXPECT_EQ(info.world[0].label, "Dec");
    EXPECT_EQ(info.world[1].label, "RA");
    EXPECT_NEAR(at(info.world[0], 42, 32, 0), 10.1, 1e-4);
    EXPECT_LT(at(info.world[1], 32, 42, 0), 30);
    EXPECT_EQ(info.world[2].name, "CHANNEL");
    EXPECT_NEAR(at(info.world[2], 0, 0, 1), 8, 1e-9) << "a row without CD takes its CDELT";
}

TEST_F(World, TypesOfBeforeTheStandard) {
    // AIPS' projection to the pole: cos(ra - ra0) cos dec = ..., of Greisen's memo: along the meridian
    // m = (cos dec0 - cos dec) / sin dec0.
    const double dec0 = 60, step = 0.01;
    const CubeInfo info = open({41, 41, 9}, axis(1, "RA---NCP", 40, 21, -step, "DEGREE") +
                                                axis(2, "DEC--NCP", dec0, 21, step, "DEGREE") +
                                                axis(3, "VELO-HEL", -100, 1, 4, "KM/S"));
    const double m = 20 * step / degrees;
    const double dec = std::acos(std::cos(dec0 / degrees) - m * std::sin(dec0 / degrees)) * degrees;
    EXPECT_NEAR(at(info.world[1], 20, 40, 0), dec, step / 20);
    EXPECT_NEAR(at(info.world[0], 20, 20, 0), 40, 1e-9);
    EXPECT_EQ(info.world[2].name, "velocity");
    EXPECT_NEAR(at(info.world[2], 0, 0, 8), -68, 1e-9);
    // The standard's way to say the same, by parameters.
    const CubeInfo slant =
        open({41, 41, 9}, axis(1, "RA---SIN", 40, 21, -step) + axis(2, "DEC--SIN", dec0, 21, step) +
                              Cards{real("PV2_1", 0), real("PV2_2", 1 / std::tan(dec0 / degrees))});
    for (std::size_t a = 0; a < 2; ++a) {
        EXPECT_NEAR(at(slant.world[a], 33, 40, 0), at(info.world[a], 33, 40, 0), 1e-9);
    }
}

TEST_F(World, ShortAxesAndPlanesAreSteppedOver) {
    const Cards cards = axis(1, "RA---SIN", 10, 3, -0.1) + axis(2, "STOKES", 1, 1, 1) +
                        axis(3, "DEC--SIN", 0, 2, 0.1) + axis(4, "FREQ", 1.4e9, 1, 1e6, "Hz");
    for (const std::int64_t stokes : {1, 2}) {
        const CubeInfo info = open({5, stokes, 4, 3}, cards, {.hdu = {}, .plane = stokes - 1});
        EXPECT_EQ(info.world[0].label, "RA");
        EXPECT_EQ(info.world[1].label, "Dec");
        EXPECT_NEAR(at(info.world[1], 2, 1, 0), 0, 1e-5);
        EXPECT_EQ(info.world[2].unit, "GHz");
        EXPECT_NEAR(at(info.world[2], 0, 0, 2), 1.402, 1e-9);
    }
}

TEST_F(World, UnitsAndNames) {
    const auto third = [&](const std::string& type, const std::string& unit, double step) {
        return open({4, 4, 11}, axis(3, type, 0, 1, step, unit)).world[2];
    };
    const wcs::Axis wave = third("LINEAR", "Angstrom", 1.25);
    EXPECT_EQ(wcs::title_text(wave), "wavelength (Angstrom)");
    EXPECT_NEAR(at(wave, 0, 0, 10), 12.5, 1e-9);
    EXPECT_EQ(wcs::title_text(third("WAVE", "", 1e-7)), "wavelength (um)");
    EXPECT_EQ(wcs::title_text(third("FREQ", "MHz", 20)), "frequency (MHz)");
    EXPECT_EQ(wcs::title_text(third("VOPT", "", 20)), "optical velocity (km/s)");
    EXPECT_EQ(wcs::title_text(third("Time", "seconds", 2)), "Time (seconds)");
    EXPECT_EQ(wcs::title_text(third("\x1b[31mred", "\xffx", 2)), "?[31mred (?x)");
    EXPECT_EQ(wcs::title_text(third("VRAD", "furlong", 2)), "radio velocity (furlong)");
    EXPECT_NEAR(at(third("VRAD", "furlong", 2), 0, 0, 3), 6, 1e-9);
    EXPECT_FALSE(third("VRAD", "km/s", 0).known()) << "no step";
    EXPECT_FALSE(third("", "km/s", 1).known()) << "no type";
}

// What cannot be used is left out with a note, and the rest stands.
TEST_F(World, WhatIsBrokenIsLeftOut) {
    const Cards velocity = axis(3, "VRAD", 0, 1, 1000, "m/s");
    const Cards sky = axis(1, "RA---TAN", 10, 3, -0.1) + axis(2, "DEC--TAN", 0, 2, 0.1);
    const auto known = [&](const Cards& cards) {
        const CubeInfo info = open({5, 6, 7}, cards);
        notes_ = info.notes;
        return std::array{info.world[0].known(), info.world[1].known(), info.world[2].known()};
    };
    EXPECT_THAT(known(axis(1, "RA---TAN", 10, 3, -0.1) + velocity), ElementsAre(false, false, true))
        << "half a sky";
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("right ascension cannot be used")));
    EXPECT_THAT(known(axis(1, "RA---TAN", 1, 3, -0.1) + axis(2, "DEC--SIN", 0, 2, 0.1) + velocity),
                ElementsAre(false, false, true));
    EXPECT_THAT(known(axis(1, "RA---QQQ", 1, 3, -0.1) + axis(2, "DEC--QQQ", 0, 2, 0.1) + velocity),
                ElementsAre(false, false, true));
    EXPECT_THAT(known(axis(1, "RA---TAN", 1, 3, -0.1, "parsec") + axis(2, "DEC--TAN", 0, 2, 0.1) + velocity),
                ElementsAre(false, false, true));
    EXPECT_THAT(known(axis(1, "RA---TAN", 1e30, 3, -0.1) + axis(2, "DEC--TAN", 0, 2, 0.1) + velocity),
                ElementsAre(false, false, true));
    EXPECT_THAT(known(sky + axis(3, "FREQ-TAB", 0, 1, 1)), ElementsAre(true, true, false));
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("frequency cannot be used")));
    EXPECT_THAT(known(sky + axis(3, "VELO-F2V", 0, 1, 1000)), ElementsAre(true, true, false))
        << "no rest frequency";
    EXPECT_THAT(known(sky + velocity + Cards{real("PC1_1", 0)}), ElementsAre(false, false, false))
        << "singular";
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("cannot be used")));
    EXPECT_THAT(known(axis(1, "RA---TAN-SIP", 10, 3, -0.1) + axis(2, "DEC--TAN-SIP", 0, 2, 0.1)),
                ElementsAre(true, true, false));
    EXPECT_THAT(notes_, ElementsAre(HasSubstr("distortions are left out")));
    EXPECT_THAT(known({"WCSAXES =  9223372036854775807"}), ElementsAre(false, false, false));
    EXPECT_THAT(notes_, IsEmpty());
}

TEST_F(World, ManyShortAxes) {
    std::vector<std::int64_t> lengths(40, 1);
    lengths[3] = lengths[20] = lengths[39] = 3;
    const CubeInfo info = open(lengths, axis(4, "VRAD", 0, 1, 1000, "m/s"));
    EXPECT_FALSE(info.world[0].known());
    EXPECT_THAT(info.notes, ElementsAre(HasSubstr("too many axes")));
}

// Keywords of all kinds with any numbers and types: always an end, and only what is valid.
TEST_F(World, Hostile) {
    const std::vector<std::string> types = {
        "RA---TAN", "DEC--TAN", "GLON-AIT", "GLAT-AIT", "RA---NCP", "DEC--NCP", "RA---ZPN",     "DEC--ZPN",
        "RA---COP", "DEC--COP", "RA---HPX", "DEC--HPX", "RA---QSC", "DEC--QSC", "RA---PCO",     "DEC--PCO",
        "RA---BON", "DEC--BON", "RA---CAR", "DEC--CAR", "RA---SZP", "DEC--SZP", "RA---TPV",     "DEC--TPV",
        "RA---GLS", "DEC--GLS", "RA---XPH", "DEC--XPH", "FREQ-LOG", "VELO-F2V", "FELO-HEL",     "VELO-LSR",
        "WAVE-GRI", "AWAV-GRA", "ZOPT-F2W", "FREQ-TAB", "CUBEFACE", "STOKES",   "HPLN-TAN",     "HPLT-TAN",
        "XXLN-TAN", "RA",       "DEC",      "TIME",     "RA---",    "--------", "RA---TAN-SIP", "' '"};
    const std::vector<double> numbers = {0,    1,    -1,    0.5,    -0.01, 45,   90,  -90,
                                         180,  360,  720,   1e-300, 1e-9,  1e5,  1e9, 1.42e9,
                                         -1e9, 1e30, -1e60, 1e200,  1e-60, 99999};
    const std::vector<std::string> units = {"deg", "DEGREE", "Hz",   "km/s", "m",
                                            "",    "eV",     "%n%s", "rad",  "((("};
    std::mt19937 random(7);
    const auto any = [&](const auto& of) { return of[random() % of.size()]; };
    int opened = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        Cards cards;
        const std::size_t pair = random() % (types.size() / 2) * 2;
        for (int i = 1; i <= 3; ++i) {
            const bool paired = i < 3 && random() % 4 != 0;
            const std::string type = paired ? types[pair + static_cast<std::size_t>(i) - 1] : any(types);
            cards = cards + axis(i, type, any(numbers), any(numbers), any(numbers), any(units));
        }
        for (int more = static_cast<int>(random() % 8); more > 0; --more) {
            const std::vector<std::string> keywords = {
                "LONPOLE",
                "LATPOLE",
                "RESTFRQ",
                "RESTWAV",
                "VELREF",
                "WCSAXES",
                "CROTA1",
                "CROTA2",
                fmt::format("PV{}_{}", 1 + random() % 3, random() % 40),
                fmt::format("PC{}_{}", 1 + random() % 3, 1 + random() % 3),
                fmt::format("CD{}_{}", 1 + random() % 3, 1 + random() % 3)};
            cards.push_back(real(any(keywords), any(numbers)));
        }
        const CubeInfo info = open({7, 6, 5}, cards);
        for (int along = 0; along < 3; ++along) {
            const wcs::Axis& one = info.world[static_cast<std::size_t>(along)];
            ASSERT_TRUE(wcs::validate(one, along)) << testing::PrintToString(cards);
            opened += one.known() ? 1 : 0;
            static_cast<void>(wcs::place_text(info.world, n_, {3, 3, 3}));
        }
    }
    EXPECT_GT(opened, 600);
}

// Real headers at their reference pixels, which may lie outside of the cube, and elsewhere by simple
// formulas.
TEST(WorldOfRealCubes, AreWhereTheirHeadersSay) {
    const std::filesystem::path data = SHEARWATER_SHARED_DATA;
    if (!std::filesystem::is_directory(data)) {
        GTEST_SKIP() << "the shared sample data are not at " << data;
    }
    struct Known {
        const char* file;
        wcs::Place place;
        std::array<double, 3> values;
        const char* words;
    };
    constexpr double l1448_dec = 0.006388889 * 4742.913;
    for (const Known& known :
         {Known{"ngc6946.fits",
                {50, 50, 0},
                {308.717915, 60.15388802, -154.8},
                "RA 20h34m52.3s  Dec +60\u00b009'14\"  Vel -154.8 km/s"},
          {"ngc6946_rice.fits.fz",
           {50, 50, 100},
           {308.717915, 60.15388802, 265.2},
           "RA 20h34m52.3s  Dec +60\u00b009'14\"  Vel 265.2 km/s"},
          {"eso121-g6.fits",
           {24, 24, 0},
           {91.8755417, -61.8404528, 980.482359},
           "RA 06h07m30.1s  Dec -61\u00b050'26\"  Vel 980.5 km/s"},
          {"WEIN069.fits", {0, 0, 82}, {NAN, NAN, 1.40388096 - 44 * -39062.5e-9}, nullptr},
          {"l1448_13co.fits",
           {0, 0, 0},
           {57.66 - 0.006388889 * 800 / std::cos(l1448_dec / degrees), l1448_dec, 2.5281949},
           nullptr},
          {"kapteyn_ra_pol_freq_dec.fits", {17, 4, 9}, {45, 1.424, 60}, nullptr},
          {"gll_iem_v07_gc.fits.gz", {39.5, 40, 5}, {0, 0, NAN}, nullptr},
          {"muse_Central_Datacube_bkg.fits",
           {62.2973274458, 55.2971568745, 8},
           {19.9997833, -30.00008056, 6060},
           nullptr}}) {
        const auto cube = Cube::open(data / known.file, {.world = true});
        ASSERT_TRUE(cube) << known.file;
        const CubeInfo& info = cube->info();
        for (std::size_t a = 0; a < 3; ++a) {
            wcs::Place next = known.place;
            next[a] += 1;
            const wcs::Axis& axis = info.world[a];
            const double value = wcs::value_at(axis, info.n, known.place);
            const double voxel = std::abs(wcs::difference(axis, value, wcs::value_at(axis, info.n, next)));
            if (!std::isnan(known.values[a])) {
                EXPECT_NEAR(wcs::difference(axis, known.values[a], value), 0, voxel / 20)
                    << known.file << " " << a;
            }
        }
        if (known.words != nullptr) {
            EXPECT_EQ(wcs::place_text(info.world, info.n, known.place), known.words);
        }
    }
}

}  // namespace
}  // namespace shearwater::fits
