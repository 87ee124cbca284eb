// Which HDU and which axes are the cube's.

#include <gmock/gmock.h>

#include <numeric>

#include "tests/fits/read_cube.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::fits {
namespace {

using support::FitsImage;
using testing::HasSubstr;

FitsImage image(std::vector<long> axes, std::vector<std::string> types = {}) {
    FitsImage result{.axes = std::move(axes)};
    result.raw.resize(static_cast<std::size_t>(
        std::accumulate(result.axes.begin(), result.axes.end(), 1L, std::multiplies<>())));
    std::iota(result.raw.begin(), result.raw.end(), 0);
    for (std::size_t i = 0; i < types.size(); ++i) {
        result.texts.emplace_back("CTYPE" + std::to_string(i + 1), types[i]);
    }
    return result;
}

class Axes : public testing::Test {
  protected:
    CubeInfo info(const std::vector<FitsImage>& images, const OpenOptions& options = {}) {
        support::write_fits(path_, images);
        const auto cube = Cube::open(path_, options);
        EXPECT_TRUE(cube) << (cube ? "" : cube.error().message());
        return cube ? cube->info() : CubeInfo{};
    }
    base::Error error(const std::vector<FitsImage>& images, const OpenOptions& options = {}) {
        support::write_fits(path_, images);
        return open_error(path_, options);
    }

    support::TemporaryFolder folder_;
    std::string path_ = folder_.path("cube.fits");
};

TEST_F(Axes, LengthOneIsDroppedWhereverItStands) {
    for (const std::vector<long>& axes : {std::vector<long>{2, 3, 4},
                                          {1, 2, 3, 4},
                                          {2, 1, 3, 4},
                                          {2, 3, 1, 4},
                                          {2, 3, 4, 1},
                                          {1, 2, 1, 1, 3, 1, 4, 1}}) {
        const CubeInfo found = info({image(axes)});
        EXPECT_EQ(found.n, (volume::Index3{2, 3, 4}));
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(axes[static_cast<std::size_t>(found.file_axes[i] - 1)], found.n[i]);
        }
        EXPECT_EQ(found.planes, 1);
        EXPECT_TRUE(found.notes.empty());
    }
}

TEST_F(Axes, TheLastOfFourIsCutAtAPlane) {
    const FitsImage cube = image({2, 3, 4, 5});
    const CubeInfo found = info({cube});
    EXPECT_EQ(found.n, (volume::Index3{2, 3, 4}));
    EXPECT_EQ(found.planes, 5);
    EXPECT_EQ(found.plane, 0);
    EXPECT_THAT(found.notes, testing::ElementsAre(HasSubstr("axis 4 has 5 planes")));
    for (std::int64_t plane = 0; plane < 5; ++plane) {
        EXPECT_EQ(info({cube}, {.hdu = {}, .plane = plane}).plane, plane);
        const std::vector<float> values = read_whole(path_, {.hdu = {}, .plane = plane});
        EXPECT_EQ(values.front(), static_cast<float>(24 * plane));
        EXPECT_EQ(values.back(), static_cast<float>(24 * plane + 23));
    }
    EXPECT_TRUE(info({cube}, {.hdu = {}, .plane = 3}).notes.empty());
}

TEST_F(Axes, PolarisationThenTimeIsThePlaneAxis) {
    const auto plane_axis = [&](const std::vector<std::string>& types) {
        const CubeInfo found = info({image({2, 3, 4, 5}, types)});
        return 1 + 2 + 3 + 4 - found.file_axes[0] - found.file_axes[1] - found.file_axes[2];
    };
    EXPECT_EQ(plane_axis({"RA---SIN", "POL", "FREQ", "DEC--SIN"}), 2);
    EXPECT_EQ(plane_axis({"RA---SIN", "DEC--SIN", "STOKES", "VRAD"}), 3);
    EXPECT_EQ(plane_axis({"stokes", "RA---SIN", "DEC--SIN", "VRAD"}), 1);
    EXPECT_EQ(plane_axis({"TIME", "STOKES", "RA---SIN", "DEC--SIN"}), 2);
    EXPECT_EQ(plane_axis({"Time", "X", "Y", "Z"}), 1);
    EXPECT_EQ(plane_axis({"RA---SIN", "DEC--SIN", "FREQ", "OFFSET"}), 4);
}

TEST_F(Axes, AnInnerPlaneAxisIsSteppedOver) {
    const CubeInfo found = info({image({2, 3, 2, 2}, {"X", "STOKES", "Y", "Z"})}, {.hdu = {}, .plane = 1});
    EXPECT_EQ(found.file_axes, (std::array<int, 3>{1, 3, 4}));
    EXPECT_EQ(found.axis_types, (std::array<std::string, 3>{"X", "Y", "Z"}));
    expect_same(read_whole(path_, {.hdu = {}, .plane = 1}), {2, 3, 8, 9, 14, 15, 20, 21});
}

TEST_F(Axes, PlanesThatAreNotThereAreRefused) {
    EXPECT_THAT(error({image({2, 3, 4, 5})}, {.hdu = {}, .plane = 5}).detail, HasSubstr("planes 0 to 4"));
    EXPECT_THAT(error({image({2, 3, 4, 5})}, {.hdu = {}, .plane = -1}).detail, HasSubstr("planes 0 to 4"));
    EXPECT_THAT(error({image({2, 3, 4})}, {.hdu = {}, .plane = 1}).detail, HasSubstr("no fourth axis"));
    EXPECT_EQ(error({image({2, 3, 4})}, {.hdu = {}, .plane = 1}).code, base::Code::invalid_argument);
}

TEST_F(Axes, TooFewAndTooManyAreNotACube) {
    EXPECT_THAT(error({image({10})}).detail, HasSubstr("an image of 10"));
    EXPECT_THAT(error({image({10, 20})}).detail, HasSubstr("an image of 10 x 20"));
    EXPECT_THAT(error({image({10, 1, 20})}).detail, HasSubstr("not a cube"));
    EXPECT_THAT(error({image({2, 2, 2, 2, 2})}).detail, HasSubstr("not a cube"));
    EXPECT_THAT(error({image({2, 2, 2, 2, 2})}, {.hdu = 0, .plane = {}}).detail,
                HasSubstr("5 axes longer than 1"));
    EXPECT_THAT(error({image({10, 20})}, {.hdu = 0, .plane = {}}).detail, HasSubstr("is 10 x 20"));
    EXPECT_EQ(error({image({10, 20})}).code, base::Code::unsupported);
}

TEST_F(Axes, TheFirstHduThatHoldsACubeIsTaken) {
    const CubeInfo found = info({image({4, 4}), image({2, 3, 4}), image({5, 6, 7})});
    EXPECT_EQ(found.hdu, 1);
    EXPECT_EQ(found.n, (volume::Index3{2, 3, 4}));
    EXPECT_THAT(found.notes, testing::ElementsAre(HasSubstr("HDU 2")));
}

TEST_F(Axes, AnHduCanBeChosen) {
    const std::vector<FitsImage> images = {image({4, 4}), image({2, 3, 4}), image({5, 6, 7})};
    const CubeInfo found = info(images, {.hdu = 2, .plane = {}});
    EXPECT_EQ(found.hdu, 2);
    EXPECT_EQ(found.n, (volume::Index3{5, 6, 7}));
    EXPECT_THAT(error(images, {.hdu = 0, .plane = {}}).detail, HasSubstr("is 4 x 4"));
    EXPECT_THAT(error(images, {.hdu = 3, .plane = {}}).detail, HasSubstr("HDUs 0 to 2"));
    EXPECT_EQ(error(images, {.hdu = -1, .plane = {}}).code, base::Code::invalid_argument);
}

}  // namespace
}  // namespace shearwater::fits
