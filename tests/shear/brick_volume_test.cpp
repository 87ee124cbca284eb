#include "renderer/shear/brick_volume.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/volume/levels.h"
#include "renderer/shear/level_builder.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::shear {
namespace {

using test::FloatCube;
using volume::Box;
using volume::Index3;

// A cube that notes what is read of it, and fails at the read of a given number.
class WatchedCube final : public volume::VoxelSource {
  public:
    explicit WatchedCube(FloatCube& cube, int failing = -1) : cube_(cube), failing_(failing) {}
    base::Status read(const Box& box, std::span<float> out) override {
        largest = std::max(largest, out.size());
        total += out.size();
        if (reads++ == failing_) {
            return base::error(base::Code::io, "read", "broken");
        }
        return cube_.read(box, out);
    }
    std::size_t largest = 0, total = 0;
    int reads = 0;

  private:
    FloatCube& cube_;
    int failing_;
};

template <class Code>
void expect_codes(const BrickVolume& volume, const FloatCube& cube) {
    const CodeVolume& voxels = volume.level(0);
    ASSERT_EQ(voxels.own(), volume.box());
    const Box& box = voxels.box();
    ASSERT_EQ(box, volume::nodes_kept(volume.box(), 0, cube.n()));
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
            for (std::int64_t x = box.lo[0]; x <= box.hi[0]; ++x) {
                ASSERT_EQ(voxels.codes<Code>()[voxels.offset({x, y, z})],
                          volume.mapping().code(static_cast<double>(cube.at(x, y, z))));
            }
        }
    }
}

// What occurs on the planes of one cube of a grid, and so many beyond, voxel by voxel.
CodeRange range_of(const BrickVolume& volume, const CodeGrid& grid, const Index3& at, const FloatCube& cube,
                   std::int64_t beyond = 0) {
    Box part;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::int64_t start = (grid.first(axis) + at[a]) * grid.edge();
        part.lo[a] = std::max<std::int64_t>(std::max(start, volume.box().lo[a]) - beyond, 0);
        part.hi[a] = std::min(std::min(start + grid.edge(), volume.box().hi[a]) + beyond, cube.n()[a] - 1);
    }
    CodeRange range;
    for (std::int64_t z = part.lo[2]; z <= part.hi[2]; ++z) {
        for (std::int64_t y = part.lo[1]; y <= part.hi[1]; ++y) {
            for (std::int64_t x = part.lo[0]; x <= part.hi[0]; ++x) {
                const auto code = volume.mapping().code(static_cast<double>(cube.at(x, y, z)));
                range.add(code == 0 ? CodeRange{.blanks = true} : CodeRange{code, code, false});
            }
        }
    }
    return range;
}

void expect_ranges(const BrickVolume& volume, const CodeGrid& grid, const FloatCube& cube) {
    Index3 at;
    for (at[2] = 0; at[2] < grid.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < grid.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < grid.counts()[0]; ++at[0]) {
                ASSERT_EQ(grid.ranges()[grid.index(at)], range_of(volume, grid, at, cube))
                    << at[0] << ", " << at[1] << ", " << at[2];
            }
        }
    }
}

void expect_reaches(const BrickVolume& volume, const FloatCube& cube) {
    const CodeGrid& grid = volume.level(0).micro_bricks();
    Index3 at;
    for (at[2] = 0; at[2] < grid.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < grid.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < grid.counts()[0]; ++at[0]) {
                ASSERT_EQ(volume.level(0).reaches()[grid.index(at)], range_of(volume, grid, at, cube, 1))
                    << at[0] << ", " << at[1] << ", " << at[2];
            }
        }
    }
}

TEST(BrickVolume, HoldsEveryVoxelsCode) {
    base::Workers workers(3);
    FloatCube cube = test::blanked(test::noise_cube({70, 41, 66}), 1009);
    for (const Box& box : {volume::whole(cube.n()), Box{{31, 0, 33}, {33, 40, 65}}, Box{{5, 6, 7}, {6, 7, 8}},
                           Box{{32, 0, 0}, {64, 32, 32}}}) {
        for (const int bits : {8, 16}) {
            for (const std::size_t slab : {1U, 100U, 4000U, 50000U, 1U << 25}) {
                WatchedCube source(cube);
                const auto volume =
                    BrickVolume::load(source, box, cube.n(), {.bits = bits}, workers, {}, {}, slab);
                ASSERT_TRUE(volume.has_value());
                // Each voxel is read once.
                EXPECT_EQ(source.total,
                          static_cast<std::size_t>(volume::nodes_to_make(box, cube.n()).front().voxels()));
                EXPECT_LE(source.largest * sizeof(float), std::max<std::size_t>(slab, sizeof(float)));
                if (slab == 4000U || slab == 1U) {
                    bits == 8 ? expect_codes<std::uint8_t>(*volume, cube)
                              : expect_codes<std::uint16_t>(*volume, cube);
                    expect_ranges(*volume, volume->level(0).micro_bricks(), cube);
                    expect_ranges(*volume, volume->bricks(), cube);
                    expect_reaches(*volume, cube);
                }
                if (box.voxels() > 10000 && slab == 1U) {
                    break;
                }
            }
        }
    }
}

// A source that lets all workers read at once gives the same.
TEST(BrickVolume, LoadsAtOnceWhatItLoadsInTurn) {
    FloatCube cube = test::blanked(test::noise_cube({130, 121, 66}), 1009);
    base::Workers one(1), three(3);
    const Box box{{3, 0, 5}, {129, 117, 65}};
    ASSERT_TRUE(cube.concurrent());
    const auto together = BrickVolume::load(cube, box, cube.n(), {}, three);
    WatchedCube in_turn(cube);
    const auto apart = BrickVolume::load(in_turn, box, cube.n(), {}, one);
    ASSERT_TRUE(together.has_value() && apart.has_value());
    ASSERT_EQ(together->levels(), 3);
    for (int level = 0; level < together->levels(); ++level) {
        const CodeVolume& a = together->level(level);
        const CodeVolume& b = apart->level(level);
        EXPECT_TRUE(std::ranges::equal(a.codes<std::uint8_t>(), b.codes<std::uint8_t>())) << level;
        EXPECT_TRUE(std::ranges::equal(a.micro_bricks().ranges(), b.micro_bricks().ranges())) << level;
    }
}

TEST(BrickVolume, LaysBricksOnTheCubesGrid) {
    base::Workers workers(1);
    FloatCube cube = test::noise_cube({70, 41, 66});
    const auto volume = test::bricks_of(cube, {{20, 0, 32}, {69, 40, 65}}, workers);
    EXPECT_EQ(volume.bricks().counts(), (Index3{3, 2, 2}));
    EXPECT_EQ(volume.level(0).micro_bricks().counts(), (Index3{7, 5, 5}));
    EXPECT_EQ(volume.bricks().first(2), 1);
    EXPECT_EQ(volume.level(0).micro_bricks().first(0), 2);
}

TEST(BrickVolume, TakesLittleMoreThanItsVoxels) {
    base::Workers workers;
    FloatCube cube = test::noise_cube({200, 161, 130});
    const auto volume = test::bricks_of(cube, workers);
    const auto voxels = static_cast<double>(cube.values().size());
    EXPECT_LT(static_cast<double>(volume.level(0).bytes()), 1.2 * voxels);
    EXPECT_LT(static_cast<double>(volume.bytes()), 1.3 * voxels);
}

// However thin the box, what its coarse levels are made from beyond it is not held. Nothing is touched here.
TEST(BrickVolume, IsLoadedInLittleMoreThanItsVoxels) {
    const Index3 n{2048, 2048, 2048};
    for (const Box& box : {volume::whole(n), Box{{0, 0, 991}, {2047, 2047, 1054}},
                           Box{{0, 991, 0}, {2047, 1054, 2047}}, Box{{991, 0, 0}, {1054, 2047, 2047}}}) {
        for (const int bits : {8, 16}) {
            const LevelBuilder builder(box, n, bits, 2);
            const auto codes = static_cast<double>(box.voxels()) * bits / 8;
            EXPECT_LT(static_cast<double>(builder.bytes()), 1.4 * codes) << to_string(box);
        }
    }
}

TEST(BrickVolume, RefusesBoxesThatAreNone) {
    base::Workers workers(1);
    FloatCube cube = test::noise_cube({10, 10, 10});
    for (const Box& box : {Box{{0, 0, 0}, {10, 9, 9}}, Box{{-1, 0, 0}, {9, 9, 9}}, Box{{3, 0, 0}, {3, 9, 9}},
                           Box{{5, 0, 0}, {3, 9, 9}}}) {
        const auto volume = BrickVolume::load(cube, box, cube.n(), {}, workers);
        ASSERT_TRUE(volume.has_error()) << to_string(box);
        EXPECT_EQ(volume.error().code, base::Code::invalid_argument);
    }
}

TEST(BrickVolume, PassesOnAFailedReadWhicheverItIs) {
    base::Workers workers(1);
    FloatCube cube = test::noise_cube({20, 20, 20});
    for (int failing = 0; failing < 20; ++failing) {
        WatchedCube source(cube, failing);
        const auto volume =
            BrickVolume::load(source, volume::whole(cube.n()), cube.n(), {}, workers, {}, {}, 1600);
        ASSERT_TRUE(volume.has_error()) << failing;
        EXPECT_EQ(volume.error().code, base::Code::io);
    }
}

TEST(BrickVolume, StopsWhenToldAndSaysHowFarItIs) {
    base::Workers workers(1);
    FloatCube cube = test::noise_cube({20, 20, 20});
    std::stop_source stop;
    double last = 0;
    const auto progress = [&](double share) {
        EXPECT_GT(share, last);
        last = share;
        if (share > 0.5) {
            stop.request_stop();
        }
    };
    const auto volume = BrickVolume::load(cube, volume::whole(cube.n()), cube.n(), {}, workers, progress,
                                          stop.get_token(), 1600);
    ASSERT_TRUE(volume.has_error());
    EXPECT_EQ(volume.error().code, base::Code::cancelled);
    EXPECT_LT(last, 0.7);
}

}  // namespace
}  // namespace shearwater::shear
