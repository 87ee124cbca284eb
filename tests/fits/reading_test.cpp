// Boxes read in large pieces, by several threads, and given up.

#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <numeric>
#include <random>
#include <thread>

#include "common/base/workers.h"
#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::fits {
namespace {

using support::FitsImage;
using volume::Box;
using volume::Index3;

// The number of a voxel in the cube, as it is stored.
std::vector<double> numbers(std::size_t count) {
    std::vector<double> values(count);
    std::iota(values.begin(), values.end(), 0);
    return values;
}

class Reading : public testing::Test {
  protected:
    Cube cube_of(const FitsImage& image, const OpenOptions& options = {}) {
        support::write_fits(path_, {image});
        auto cube = Cube::open(path_, options);
        EXPECT_TRUE(cube) << (cube ? "" : cube.error().message());
        return std::move(*cube);
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("cube.fits");
};

Box random_box(const Index3& n, std::mt19937& random) {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t a = static_cast<std::int64_t>(random() % static_cast<unsigned>(n[axis]));
        const std::int64_t b = static_cast<std::int64_t>(random() % static_cast<unsigned>(n[axis]));
        box.lo[axis] = std::min(a, b);
        box.hi[axis] = random() % 3 == 0 ? n[axis] - 1 : std::max(a, b);
        box.lo[axis] = random() % 3 == 0 ? 0 : box.lo[axis];
    }
    return box;
}

void expect_numbers(Cube& cube, const Box& box, const std::function<double(const Index3&)>& number) {
    const std::vector<float> values = read_box(cube, box);
    std::size_t i = 0;
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
            for (std::int64_t x = box.lo[0]; x <= box.hi[0]; ++x) {
                ASSERT_EQ(values[i++], static_cast<float>(number({x, y, z})))
                    << to_string(box) << " at " << x << " " << y << " " << z;
            }
        }
    }
}

// Rows of a few bytes, of some pages, and longer than a piece; whole planes and single columns.
TEST_F(Reading, BoxesOfAnyShapeAreFoundInFilesOfAnyShape) {
    std::mt19937 random(1);
    for (const Index3& n : {Index3{90000, 3, 2}, {700, 60, 9}, {5, 300, 100}, {2, 2, 40000}}) {
        for (const int bitpix : {32, -64}) {
            Cube cube =
                cube_of({.bitpix = bitpix,
                         .axes = {static_cast<long>(n[0]), static_cast<long>(n[1]), static_cast<long>(n[2])},
                         .raw = numbers(static_cast<std::size_t>(n[0] * n[1] * n[2]))});
            EXPECT_TRUE(cube.concurrent());
            for (int trial = 0; trial < 12; ++trial) {
                expect_numbers(cube, trial == 0 ? volume::whole(n) : random_box(n, random),
                               [&](const Index3& at) { return at[0] + n[0] * (at[1] + n[1] * at[2]); });
            }
        }
    }
}

// The fourth axis stands in front of the cube's, so that no two of its pixels follow each other.
TEST_F(Reading, OnePlaneOfAnAxisInFrontIsPickedOut) {
    std::mt19937 random(2);
    for (const Index3& n : {Index3{31, 17, 11}, {30000, 3, 2}}) {
        for (const int bitpix : {32, -32}) {
            FitsImage image{
                .bitpix = bitpix,
                .axes = {4, static_cast<long>(n[0]), static_cast<long>(n[1]), static_cast<long>(n[2])},
                .raw = numbers(static_cast<std::size_t>(4 * n[0] * n[1] * n[2]))};
            image.texts = {{"CTYPE1", "STOKES"}};
            Cube cube = cube_of(image, {.plane = 2});
            ASSERT_EQ(cube.info().n, n);
            for (int trial = 0; trial < 8; ++trial) {
                expect_numbers(
                    cube, trial == 0 ? volume::whole(n) : random_box(n, random),
                    [&](const Index3& at) { return 2 + 4 * (at[0] + n[0] * (at[1] + n[1] * at[2])); });
            }
        }
    }
}

// Tiles of every shape, larger than what is unpacked at once.
TEST_F(Reading, CompressedBoxesAreCutBetweenTiles) {
    std::mt19937 random(3);
    const Index3 n{200, 190, 30};
    for (const std::vector<long>& tile :
         {std::vector<long>{200, 1, 1}, {32, 32, 8}, {200, 190, 30}, {7, 190, 1}}) {
        for (const int bitpix : {32, -64}) {
            if (bitpix < 0 && tile[2] == 1) {
                continue;
            }
            Cube cube = cube_of({.bitpix = bitpix,
                                 .axes = {200, 190, 30},
                                 .raw = numbers(200 * 190 * 30),
                                 .compression = bitpix > 0 ? 11 : 21,  // RICE_1, GZIP_1 of cfitsio
                                 .tile = tile});
            EXPECT_FALSE(cube.concurrent());
            for (int trial = 0; trial < 3; ++trial) {
                const Box box = trial == 0 ? volume::whole(n) : random_box(n, random);
                expect_numbers(cube, box,
                               [&](const Index3& at) { return at[0] + n[0] * (at[1] + n[1] * at[2]); });
            }
        }
    }
}

TEST_F(Reading, ThreadsReadOneCubeAtOnce) {
    const Index3 n{64, 64, 64};
    Cube cube = cube_of({.bitpix = 32, .axes = {64, 64, 64}, .raw = numbers(64 * 64 * 64)});
    base::Workers workers(4);
    workers.for_each(200, [&](std::int64_t i) {
        std::mt19937 random(static_cast<unsigned>(i));
        expect_numbers(cube, random_box(n, random),
                       [&](const Index3& at) { return at[0] + n[0] * (at[1] + n[1] * at[2]); });
    });
}

TEST_F(Reading, AStopEndsOpeningAndReading) {
    std::stop_source stop;
    Cube cube = cube_of({.axes = {20, 20, 20}, .raw = numbers(8000)}, {.stop = stop.get_token()});
    std::vector<float> values(8000);
    EXPECT_TRUE(cube.read(volume::whole({20, 20, 20}), values));
    support::gzip(path_, folder_.path("cube.fits.gz"));
    const std::string tiled = folder_.path("tiled.fits");
    support::write_fits(
        tiled, {{.bitpix = 32, .axes = {20, 20, 20}, .raw = numbers(8000), .compression = 11, .tile = {}}});
    auto unpacking = Cube::open(tiled, {.stop = stop.get_token()});
    ASSERT_TRUE(unpacking);
    stop.request_stop();
    for (Cube* const open : {&cube, &*unpacking}) {
        const base::Status status = open->read(volume::whole({20, 20, 20}), values);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, base::Code::cancelled);
    }
    EXPECT_EQ(open_error(folder_.path("cube.fits.gz"), {.stop = stop.get_token()}).code,
              base::Code::cancelled);
}

}  // namespace
}  // namespace shearwater::fits
