// What is still done once a load or a frame has been told to stop: what was begun, and no more.

#include <gtest/gtest.h>

#include <atomic>

#include "common/volume/levels.h"
#include "renderer/shear/coarsen.h"
#include "renderer/shear/level_builder.h"
#include "renderer/shear/render.h"
#include "tests/support/reference_cubes.h"

namespace shearwater::test {
namespace {

using shear::BrickVolume;
using volume::Box;

// Tells its reader to stop in the middle of one read, and counts what is read from then on.
class Stopping final : public volume::VoxelSource {
  public:
    Stopping(FloatCube& cube, int at, bool concurrent) : cube_(cube), at_(at), concurrent_(concurrent) {}
    base::Status read(const Box& box, std::span<float> out) override {
        if (reads_++ == at_) {
            stop_.request_stop();
        }
        if (stop_.stop_requested()) {
            voxels_after_ += out.size();
        }
        return cube_.read(box, out);
    }
    bool concurrent() const override { return concurrent_; }
    std::stop_token token() const { return stop_.get_token(); }
    std::size_t voxels_after() const { return voxels_after_; }

  private:
    FloatCube& cube_;
    int at_;
    bool concurrent_;
    std::atomic<int> reads_ = 0;
    std::atomic<std::size_t> voxels_after_ = 0;
    std::stop_source stop_;
};

TEST(Stop, OfALoadReadsNoMoreThanWasBegun) {
    FloatCube cube = noise_cube({130, 121, 66});
    constexpr std::size_t slab_bytes = std::size_t{120} << 10;
    for (const int threads : {1, 3}) {
        for (const bool concurrent : {false, true}) {
            base::Workers workers(threads);
            Stopping source(cube, 9, concurrent);
            const auto volume = BrickVolume::load(source, volume::whole(cube.n()), cube.n(), {}, workers, {},
                                                  source.token(), slab_bytes);
            ASSERT_TRUE(volume.has_error()) << threads << concurrent;
            EXPECT_EQ(volume.error().code, base::Code::cancelled);
            EXPECT_LE(source.voxels_after(), 2 * slab_bytes / sizeof(float)) << threads << concurrent;
        }
    }
}

TEST(Stop, OfWhatFollowsReadingMakesNothing) {
    base::Workers workers(2);
    std::stop_source stop;
    stop.request_stop();
    const volume::Index3 n{130, 121, 66};
    shear::CodeVolume voxels(volume::whole(n), 8);
    shear::CodeVolume coarse(volume::nodes_of(volume::whole(n), 1), 8);
    EXPECT_FALSE(shear::coarsen(voxels, coarse, coarse.box(), 1, n, workers, stop.get_token()));
    EXPECT_FALSE(voxels.survey(voxels.box(), workers, stop.get_token()));
    shear::CodeVolume part({{1, 1, 1}, {100, 100, 60}}, 8);
    EXPECT_FALSE(part.copy(voxels, part.box(), workers, stop.get_token()));
    shear::LevelBuilder builder({{1, 1, 1}, {100, 100, 60}}, n, 8, 4);
    EXPECT_FALSE(builder.rise(workers, stop.get_token()));
}

TEST(Stop, OfAFrameTakesNoSample) {
    FloatCube cube = noise_cube({40, 41, 42});
    base::Workers workers(2);
    const auto volume = bricks_of(cube, workers);
    const view::Lattice lattice{.n = cube.n(), .spacing = {1, 1, 1}};
    const auto factorisation = view::factorise(view::camera_on({}, lattice), {300, 200}, lattice, {});
    std::stop_source stop;
    const auto samples = [&] {
        return shear::render(volume, factorisation, view::default_transfer_function(), workers,
                             {.stop = stop.get_token()})
            .stats.samples;
    };
    EXPECT_GT(samples(), 0U);
    stop.request_stop();
    EXPECT_EQ(samples(), 0U);
}

}  // namespace
}  // namespace shearwater::test
