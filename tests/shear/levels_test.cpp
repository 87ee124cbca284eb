// The coarser levels that a leaf keeps, beside the same made node by node from the whole cube.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "common/image/warp.h"
#include "common/volume/levels.h"
#include "tests/support/reference_cubes.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using shear::BrickVolume;
using shear::CodeRange;
using shear::CodeVolume;
using volume::Box;
using volume::Index3;

// Some blank in every eight voxels, and a corner in which most are.
FloatCube spotted_cube(const Index3& n) {
    FloatCube cube = blanked(noise_cube(n), 5);
    for (std::int64_t z = 0; z < n[2] / 3; ++z) {
        for (std::int64_t y = 0; y < n[1] / 3; ++y) {
            for (std::int64_t x = 0; x < n[0]; ++x) {
                if ((x + y * z) % 3 != 0) {
                    cube.at(x, y, z) = std::numeric_limits<float>::quiet_NaN();
                }
            }
        }
    }
    return cube;
}

// A level of a whole cube by definition.
struct Level {
    Index3 last;
    std::vector<int> codes;

    int at(const Index3& p) const {
        Index3 q;
        for (std::size_t a = 0; a < 3; ++a) {
            q[a] = std::clamp<std::int64_t>(p[a], 0, last[a]);
        }
        return codes[static_cast<std::size_t>((q[2] * (last[1] + 1) + q[1]) * (last[0] + 1) + q[0])];
    }
};

template <class Node>
Level made(const Index3& last, const Node& node) {
    Level level{.last = last, .codes = {}};
    for (std::int64_t z = 0; z <= last[2]; ++z) {
        for (std::int64_t y = 0; y <= last[1]; ++y) {
            for (std::int64_t x = 0; x <= last[0]; ++x) {
                level.codes.push_back(node({x, y, z}));
            }
        }
    }
    return level;
}

int mean_about(const Level& finer, const Index3& p) {
    int sum = 0, weights = 0;
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const int code = finer.at({2 * p[0] + dx, 2 * p[1] + dy, 2 * p[2] + dz});
                const int weight = (2 - std::abs(dx)) * (2 - std::abs(dy)) * (2 - std::abs(dz));
                sum += weight * code;
                weights += code != 0 ? weight : 0;
            }
        }
    }
    return weights < 32 ? 0 : (2 * sum + weights) / (2 * weights);
}

std::vector<Level> levels_of(const FloatCube& cube, const volume::Mapping& mapping) {
    std::vector<Level> levels{made(volume::last_nodes(cube.n(), 0), [&](const Index3& p) {
        return mapping.code(static_cast<double>(cube.at(p[0], p[1], p[2])));
    })};
    for (int level = 1; level <= volume::coarsest_level(cube.n()); ++level) {
        levels.push_back(made(volume::last_nodes(cube.n(), level),
                              [&](const Index3& p) { return mean_about(levels.back(), p); }));
    }
    return levels;
}

template <class Each>
void for_nodes(const Box& box, const Each& each) {
    Index3 p;
    for (p[2] = box.lo[2]; p[2] <= box.hi[2]; ++p[2]) {
        for (p[1] = box.lo[1]; p[1] <= box.hi[1]; ++p[1]) {
            for (p[0] = box.lo[0]; p[0] <= box.hi[0]; ++p[0]) {
                each(p);
            }
        }
    }
}

template <class Code>
void expect_level(const CodeVolume& volume, const Level& truth) {
    std::size_t wrong = 0;
    for_nodes(volume.box(), [&](const Index3& p) {
        const int code = volume.codes<Code>()[volume.offset(p)];
        wrong += code != truth.at(p) ? 1U : 0U;
    });
    EXPECT_EQ(wrong, 0U);
    const shear::CodeGrid& grid = volume.micro_bricks();
    for_nodes({{0, 0, 0}, {grid.counts()[0] - 1, grid.counts()[1] - 1, grid.counts()[2] - 1}},
              [&](const Index3& at) {
                  Box part;
                  for (int axis = 0; axis < 3; ++axis) {
                      const auto a = static_cast<std::size_t>(axis);
                      part.lo[a] = std::max((grid.first(axis) + at[a]) * grid.edge(), volume.own().lo[a]);
                      part.hi[a] = std::min((grid.first(axis) + at[a] + 1) * grid.edge(), volume.own().hi[a]);
                  }
                  const auto range_of = [&](const Box& nodes) {
                      CodeRange range;
                      for_nodes(nodes, [&](const Index3& p) {
                          const auto code = static_cast<std::uint16_t>(truth.at(p));
                          range.add(code == 0 ? CodeRange{.blanks = true} : CodeRange{code, code, false});
                      });
                      return range;
                  };
                  ASSERT_EQ(grid.ranges()[grid.index(at)], range_of(part));
                  for (std::size_t a = 0; a < 3; ++a) {
                      part.lo[a] = std::max<std::int64_t>(part.lo[a] - 1, 0);
                      part.hi[a] = std::min(part.hi[a] + 1, truth.last[a]);
                  }
                  ASSERT_EQ(volume.reaches()[grid.index(at)], range_of(part));
              });
}

TEST(Levels, AreTheSameWhateverTheBox) {
    base::Workers workers(3);
    for (const Index3& n : {Index3{131, 34, 45}, Index3{40, 128, 33}}) {
        FloatCube cube = spotted_cube(n);
        for (const int bits : {8, 16}) {
            const volume::Mapping mapping{.bits = bits};
            const auto truth = levels_of(cube, mapping);
            ASSERT_EQ(truth.size(), 3U);
            for (const Level& level : truth) {
                const auto blanks = std::ranges::count(level.codes, 0);
                EXPECT_GT(blanks, 0);
                EXPECT_LT(blanks, std::ssize(level.codes) / 2);
            }
            const Box whole = volume::whole(n);
            for (const Box& box : {whole, Box{{17, 3, 5}, {18, 4, 6}}, Box{{0, 9, 16}, {37, 31, 32}},
                                   Box{{20, 1, 30}, {whole.hi[0], whole.hi[1] - 1, whole.hi[2]}}}) {
                const BrickVolume volume = bricks_of(cube, box, workers, mapping);
                ASSERT_EQ(volume.levels(), 3);
                for (int level = 0; level < 3; ++level) {
                    SCOPED_TRACE(to_string(box) + ", level " + std::to_string(level));
                    const CodeVolume& codes = volume.level(level);
                    ASSERT_EQ(codes.own(), volume::nodes_of(box, level));
                    ASSERT_EQ(codes.box(), volume::nodes_kept(box, level, n));
                    bits == 8 ? expect_level<std::uint8_t>(codes, truth[static_cast<std::size_t>(level)])
                              : expect_level<std::uint16_t>(codes, truth[static_cast<std::size_t>(level)]);
                }
            }
        }
    }
}

// A cube by formula, so that none needs to be held.
class Formula final : public volume::VoxelSource {
  public:
    base::Status read(const Box&, std::span<float> out) override {
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = static_cast<float>(i % 256) / 255;
        }
        return {};
    }
    bool concurrent() const override { return true; }
};

TEST(Levels, TakeASeventhOfTheVoxelsAndLittleMarginStays) {
    base::Workers workers;
    Formula source;
    const Index3 n{512, 512, 512};
    for (const Box& box : {Box{{0, 0, 0}, {256, 256, 256}}, Box{{131, 131, 131}, {387, 387, 387}}}) {
        const auto volume = BrickVolume::load(source, box, n, {}, workers);
        ASSERT_TRUE(volume.has_value());
        ASSERT_EQ(volume->levels(), 5);
        EXPECT_LT(static_cast<double>(volume->bytes()), 1.3 * static_cast<double>(box.voxels()));
    }
}

TEST(Levels, AreNoLongerMadeOnceStopped) {
    base::Workers workers(1);
    FloatCube cube = noise_cube({140, 70, 80});
    std::stop_source stop;
    const auto read = [&](double share) {
        if (share == 1) {
            stop.request_stop();
        }
    };
    const auto volume =
        BrickVolume::load(cube, volume::whole(cube.n()), cube.n(), {}, workers, read, stop.get_token());
    ASSERT_TRUE(volume.has_error());
    EXPECT_EQ(volume.error().code, base::Code::cancelled);
}

// Where a level is chosen, the picture is that of all voxels but for what is too fine for its pixels.
TEST(Levels, ComeNearToThePictureOfEveryVoxel) {
    base::Workers workers;
    FloatCube cube = smooth_cube({201, 180, 160});
    const view::Lattice lattice{cube.n(), {1, 1, 1}};
    const auto volume = bricks_of(cube, workers);
    const auto tf = ramp_to(0.1);
    std::array<int, 3> chosen{};
    for (const view::ImageSize& size : {view::ImageSize{120, 105}, view::ImageSize{55, 49}}) {
        for (const auto& [name, camera] : all_views(lattice)) {
            const view::Sampling sampling{.level_of_detail = true};
            const auto f = view::factorise(camera, size, lattice, sampling);
            ++chosen.at(static_cast<std::size_t>(f.level()));
            const auto exact = in_8_bits(picture_of(volume, lattice, tf, camera, size, workers));
            const auto coarse = in_8_bits(picture_of(volume, lattice, tf, camera, size, workers, sampling));
            EXPECT_GT(psnr(coarse, exact), f.level() == 0 ? 99 : 35) << name << ", level " << f.level();
        }
    }
    EXPECT_GT(chosen[1], 10);
    EXPECT_GT(chosen[2], 10);
}

}  // namespace
}  // namespace shearwater::test
