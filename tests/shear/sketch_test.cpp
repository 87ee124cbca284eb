// A sketch beside the voxels it should hold, and how little it takes to have it.

#include "renderer/shear/sketch.h"

#include <gtest/gtest.h>

#include <atomic>

#include "common/image/warp.h"
#include "common/volume/levels.h"
#include "common/volume/statistics.h"
#include "renderer/shear/render.h"
#include "tests/support/reference_cubes.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using shear::Sketch;
using volume::Box;
using volume::Index3;

// Counts what is read, fails at one read or asks for a stop at one.
class Watched final : public volume::VoxelSource {
  public:
    explicit Watched(FloatCube& cube) : cube_(cube) {}
    base::Status read(const Box& box, std::span<float> out) override {
        const int number = reads++;
        voxels += out.size();
        if (number == fails_at) {
            return base::error(base::Code::io, "read", "broken");
        }
        if (number == stops_at) {
            stop.request_stop();
        }
        return cube_.read(box, out);
    }
    bool concurrent() const override { return true; }

    std::atomic<int> reads = 0;
    std::atomic<std::size_t> voxels = 0;
    int fails_at = -1, stops_at = -1;
    std::stop_source stop;

  private:
    FloatCube& cube_;
};

template <class Code>
void expect_nodes(const shear::BrickVolume& volume, int level, const FloatCube& cube) {
    const shear::CodeVolume& nodes = volume.level(level);
    ASSERT_EQ(nodes.box(), volume::nodes_kept(volume.box(), level, cube.n()));
    Index3 p;
    for (p[2] = nodes.box().lo[2]; p[2] <= nodes.box().hi[2]; ++p[2]) {
        for (p[1] = nodes.box().lo[1]; p[1] <= nodes.box().hi[1]; ++p[1]) {
            for (p[0] = nodes.box().lo[0]; p[0] <= nodes.box().hi[0]; ++p[0]) {
                const auto voxel = [&](std::size_t a) { return std::min(p[a] << level, cube.n()[a] - 1); };
                ASSERT_EQ(nodes.codes<Code>()[nodes.offset(p)],
                          volume.mapping().code(static_cast<double>(cube.at(voxel(0), voxel(1), voxel(2)))));
            }
        }
    }
}

const std::vector<Box> boxes{volume::whole({131, 70, 97}),
                             {{1, 2, 3}, {130, 69, 96}},
                             {{64, 0, 32}, {68, 5, 33}},
                             {{3, 5, 6}, {4, 6, 7}}};

TEST(Sketch, HoldsTheVoxelsOnTheNodes) {
    FloatCube cube = blanked(noise_cube({131, 70, 97}), 7);
    base::Workers workers(3);
    for (const Box& box : boxes) {
        for (int level = 1; level <= volume::coarsest_level(cube.n()); ++level) {
            const auto sketch = Sketch::read(cube, box, cube.n(), level, workers);
            ASSERT_TRUE(sketch.has_value());
            expect_nodes<std::uint8_t>(sketch->volume({.bits = 8}, workers), level, cube);
            expect_nodes<std::uint16_t>(sketch->volume({.bits = 16}, workers), level, cube);
        }
    }
}

// Of the rows between its nodes nothing is read.
TEST(Sketch, ReadsOneRowForEachRowOfNodes) {
    FloatCube cube = noise_cube({131, 70, 97});
    base::Workers workers(2);
    for (const Box& box : boxes) {
        Watched source(cube);
        ASSERT_TRUE(Sketch::read(source, box, cube.n(), 2, workers).has_value());
        const Box nodes = volume::nodes_kept(box, 2, cube.n());
        EXPECT_EQ(source.reads, nodes.planes(1) * nodes.planes(2));
        EXPECT_LE(source.voxels,
                  static_cast<std::size_t>(source.reads) * static_cast<std::size_t>(cube.n()[0]));
    }
}

// Whatever the cuts, every node of the cube is counted in one of the boxes.
TEST(Sketch, OfADivisionCountsWhatThatOfTheWholeDoes) {
    FloatCube cube = blanked(noise_cube({131, 70, 97}), 7);
    base::Workers workers(1);
    const auto histogram_of = [&](const Box& box, int level) {
        return Sketch::read(cube, box, cube.n(), level, workers).value().histogram();
    };
    for (const int level : {1, 2}) {
        const volume::Histogram whole = histogram_of(volume::whole(cube.n()), level);
        const Index3 nodes = volume::last_nodes(cube.n(), level);
        std::uint64_t inside = 1;
        for (std::size_t a = 0; a < 3; ++a) {
            const bool is_last_inside = nodes[a] << level <= cube.n()[a] - 1;
            inside *= static_cast<std::uint64_t>(nodes[a] + (is_last_inside ? 1 : 0));
        }
        EXPECT_EQ(whole.valid() + whole.blank(), inside);
        for (const Index3& cuts : {Index3{64, 32, 48}, Index3{1, 1, 1}, Index3{129, 67, 95}}) {
            volume::Histogram sum;
            for (unsigned corner = 0; corner < 8; ++corner) {
                Box box = volume::whole(cube.n());
                for (unsigned axis = 0; axis < 3; ++axis) {
                    ((corner >> axis & 1U) != 0 ? box.lo : box.hi)[axis] = cuts[axis];
                }
                sum.merge(histogram_of(box, level));
            }
            EXPECT_EQ(sum.filled(), whole.filled());
            EXPECT_EQ(sum.blank(), whole.blank());
        }
    }
}

// A slab of one value, which no level can miss: the sketch's picture of it is the cube's, but for rays that
// cut its edges between two slices.
TEST(Sketch, OfAnEvenCubeGivesTheCubesPicture) {
    FloatCube cube({131, 70, 97}, [](double, double, double) { return 0.5F; });
    base::Workers workers(2);
    const auto whole = bricks_of(cube, workers);
    const auto sketch = Sketch::read(cube, whole.box(), cube.n(), 2, workers)->volume({}, workers);
    const view::Lattice lattice{.n = cube.n(), .spacing = {1, 1, 1}};
    view::TransferFunction tf = view::default_transfer_function();
    tf.opacity_pins = {view::Flat{.height = 0.02}};
    const view::ImageSize size{.width = 60, .height = 50};
    const view::Camera camera = view::camera_on({}, lattice);
    view::Factorisation factorisation = view::factorise(camera, size, lattice, {});
    const auto picture = [&](const shear::BrickVolume& volume, shear::RenderStats& stats) {
        const auto drawn = shear::render(volume, factorisation, tf, workers);
        stats = drawn.stats;
        return image::warp(factorisation, drawn.windows, camera, size, tf.background, workers);
    };
    shear::RenderStats by_voxels, by_nodes;
    const auto expected = picture(whole, by_voxels);
    factorisation.slice_exponent = 2;
    const auto actual = picture(sketch, by_nodes);
    int apart = 0;
    for (std::size_t i = 0; i < expected.pixels().size(); ++i) {
        apart += std::abs(expected.pixels()[i].r - actual.pixels()[i].r) > 2 ? 1 : 0;
    }
    EXPECT_LE(apart, size.width * size.height / 50);
    EXPECT_GT(expected.at(30, 25).r, 100);
    EXPECT_LT(by_nodes.samples, by_voxels.samples / 3);
    EXPECT_EQ(by_nodes.bricks_rendered, by_voxels.bricks_rendered);
    EXPECT_EQ(by_nodes.bricks_empty, 0U);
}

TEST(Sketch, PassesOnAFailedReadAndReadsNoMoreAfterIt) {
    FloatCube cube = noise_cube({131, 70, 97});
    for (const int threads : {1, 3}) {
        base::Workers workers(threads);
        for (const int failing : {0, 10, 300}) {
            Watched source(cube);
            source.fails_at = failing;
            const auto sketch = Sketch::read(source, volume::whole(cube.n()), cube.n(), 2, workers);
            ASSERT_TRUE(sketch.has_error());
            EXPECT_EQ(sketch.error().code, base::Code::io);
            EXPECT_LE(source.reads, failing + 2 * threads);
        }
    }
}

TEST(Sketch, StopsBetweenRows) {
    FloatCube cube = noise_cube({131, 70, 97});
    for (const int threads : {1, 3}) {
        base::Workers workers(threads);
        Watched source(cube);
        source.stops_at = 100;
        const auto sketch =
            Sketch::read(source, volume::whole(cube.n()), cube.n(), 2, workers, source.stop.get_token());
        ASSERT_TRUE(sketch.has_error());
        EXPECT_EQ(sketch.error().code, base::Code::cancelled);
        EXPECT_LE(source.reads, 100 + 2 * threads);
    }
}

TEST(Sketch, WithMoreNodesThanAnyNeedsIsRefused) {
    FloatCube cube = noise_cube({4, 4, 4});
    base::Workers workers(1);
    const Index3 n{2000, 2000, 2000};
    Watched source(cube);
    const auto sketch = Sketch::read(source, volume::whole(n), n, 1, workers);
    ASSERT_TRUE(sketch.has_error());
    EXPECT_EQ(sketch.error().code, base::Code::too_large);
    EXPECT_EQ(source.reads, 0);
}

}  // namespace
}  // namespace shearwater::test
