// What little may be seen, in pieces: they hold all of it, with the volume's own voxels, and pictures made of
// them are those that the volume gives.

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

#include "common/image/warp.h"
#include "renderer/shear/sparse_pieces.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using shear::BrickVolume;
using shear::CodeVolume;
using shear::Content;
using shear::Piece;
using shear::SparsePieces;
using volume::Index3;

// Nearly nothing, but for single voxels, some thick blobs and a bar along each axis; some voxels are blank.
FloatCube scattered_cube(const Index3& n, unsigned seed = 1) {
    FloatCube cube = noise_cube(n, seed);
    for (float& value : cube.values()) {
        value *= 0.4F;
    }
    std::mt19937 random(seed);
    const auto some = [&](std::int64_t end) {
        return std::uniform_int_distribution<std::int64_t>(0, end - 1)(random);
    };
    const auto voxels = n[0] * n[1] * n[2];
    for (std::int64_t i = 0; i < voxels / 20000 + 3; ++i) {
        cube.at(some(n[0]), some(n[1]), some(n[2])) = 0.9F;
        cube.at(some(n[0]), some(n[1]), some(n[2])) = std::numeric_limits<float>::quiet_NaN();
    }
    for (int blob = 0; blob < 2; ++blob) {
        const Index3 middle{some(n[0]), some(n[1]), some(n[2])};
        for (std::int64_t i = 0; i < 200; ++i) {
            Index3 at;
            for (std::size_t a = 0; a < 3; ++a) {
                at[a] = std::clamp<std::int64_t>(middle[a] + some(7) - 3, 0, n[a] - 1);
            }
            cube.at(at[0], at[1], at[2]) = 0.7F + 0.3F * static_cast<float>(i) / 200;
        }
    }
    for (std::int64_t i = 5; i < std::min(n[0], std::int64_t{40}); ++i) {
        cube.at(i, n[1] / 2, n[2] / 2) = 0.8F;
    }
    for (std::int64_t i = 3; i < n[1]; ++i) {
        cube.at(n[0] - 1, i, n[2] / 3) = 0.8F;
    }
    for (std::int64_t i = 0; i < n[2]; ++i) {
        cube.at(n[0] / 3, 0, i) = 0.8F;
    }
    return cube;
}

// Nothing below one half.
const view::TransferFunction above_half{.opacity_pins = {view::Ramp{0.5, 0, 1, 0.6}},
                                        .colour_pins = {{0, {0.2, 0.4, 1}}, {1, {1, 0.8, 0.1}}},
                                        .background = {}};

// Which octants of the whole level may be seen, counted along its axes.
std::map<Index3, bool> opaque_octants(const CodeVolume& codes, std::span<const Content> contents) {
    std::map<Index3, bool> opaque;
    const auto& grid = codes.micro_bricks();
    Index3 at;
    for (at[2] = 0; at[2] < grid.counts()[2]; ++at[2]) {
        for (at[1] = 0; at[1] < grid.counts()[1]; ++at[1]) {
            for (at[0] = 0; at[0] < grid.counts()[0]; ++at[0]) {
                const Content& content = contents[grid.index(at)];
                for (int octant = 0; octant < 8; ++octant) {
                    if ((content.opaque_octants >> octant & 1) != 0) {
                        opaque[{2 * at[0] + octant % 2, 2 * at[1] + octant / 2 % 2, 2 * at[2] + octant / 4}] =
                            content.blanks;
                    }
                }
            }
        }
    }
    return opaque;
}

template <class Code>
void expect_pieces_hold_all(const BrickVolume& volume, int level, int axis, base::Workers& workers) {
    const auto classification = shear::classify(volume, above_half, view::Classify::post, workers);
    const auto& contents = classification.micro_bricks[static_cast<std::size_t>(level)];
    const CodeVolume& codes = volume.level(level);
    const SparsePieces<Code> pieces(codes, classification.table, contents, axis, workers);
    const std::array<int, 3> axes{axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, axis};
    const auto turned = [&](std::int64_t fast, std::int64_t slow, std::int64_t principal) {
        Index3 at;
        at[static_cast<std::size_t>(axes[0])] = fast;
        at[static_cast<std::size_t>(axes[1])] = slow;
        at[static_cast<std::size_t>(axes[2])] = principal;
        return at;
    };
    const auto opaque = opaque_octants(codes, contents);
    ASSERT_GT(opaque.size(), 10U);
    std::map<Index3, int> covered;
    const std::int64_t halves = 2 * codes.micro_bricks().counts()[static_cast<std::size_t>(axis)];
    for (std::int64_t half = 0; half < halves; ++half) {
        bool any = false;
        for (std::int64_t column = 0; column * SparsePieces<Code>::column < pieces.octants()[0].end;
             ++column) {
            for (const auto& copied : pieces.in(half, column)) {
                any = true;
                const Piece& piece = copied.piece;
                for (std::int64_t s = piece.slow.first; s < piece.slow.end; ++s) {
                    for (std::int64_t f = piece.fast.first; f < piece.fast.end; ++f) {
                        EXPECT_EQ(f / SparsePieces<Code>::column, column);
                        const Index3 octant = turned(f, s, half);
                        EXPECT_EQ(++covered[octant], 1) << "no two pieces meet";
                        if (const auto found = opaque.find(octant); found != opaque.end()) {
                            EXPECT_TRUE(piece.visit == shear::Visit::with_blanks || !found->second);
                        }
                    }
                }
                const auto nodes = pieces.nodes_of(half, piece);
                const auto place = pieces.find(copied, nodes);
                for (std::int64_t w = nodes.lo[2]; w <= nodes.hi[2]; ++w) {
                    for (std::int64_t v = nodes.lo[1]; v <= nodes.hi[1]; ++v) {
                        for (std::int64_t u = nodes.lo[0]; u <= nodes.hi[0]; ++u) {
                            const Code copy =
                                place.first[(w - nodes.lo[2]) * place.plane_stride +
                                            (v - nodes.lo[1]) * place.row_stride + (u - nodes.lo[0])];
                            ASSERT_EQ(copy, codes.codes<Code>()[codes.offset(turned(u, v, w))]);
                        }
                    }
                }
            }
        }
        EXPECT_EQ(pieces.any_in(half), any);
    }
    for (const auto& [octant, blanks] : opaque) {
        EXPECT_EQ(covered.contains(octant), true) << octant[0] << ", " << octant[1] << ", " << octant[2];
    }
    EXPECT_LT(covered.size(), 4 * opaque.size());
}

TEST(Sparse, PiecesHoldAllThatMayBeSeen) {
    base::Workers workers(3);
    FloatCube cube = scattered_cube({301, 71, 90});
    for (const volume::Box& box : {volume::whole(cube.n()), volume::Box{{13, 5, 3}, {291, 66, 77}},
                                   volume::Box{{90, 0, 20}, {160, 9, 60}}}) {
        const BrickVolume bytes = bricks_of(cube, box, workers),
                          words = bricks_of(cube, box, workers, {.bits = 16});
        for (int axis = 0; axis < 3; ++axis) {
            expect_pieces_hold_all<std::uint8_t>(bytes, 0, axis, workers);
            expect_pieces_hold_all<std::uint16_t>(words, 0, axis, workers);
        }
    }
}

TEST(Sparse, IsWhatShowsLittle) {
    using shear::SparseFaces;
    EXPECT_TRUE(SparseFaces::pay(0, 0));
    EXPECT_TRUE(SparseFaces::pay(10, 1000));
    EXPECT_FALSE(SparseFaces::pay(100, 1000));
    EXPECT_FALSE(SparseFaces::pay(std::uint64_t{1} << 30U, std::uint64_t{1} << 40U)) << "it would take long";
    base::Workers workers(2);
    FloatCube cube = scattered_cube({131, 67, 97});
    const BrickVolume volume = bricks_of(cube, workers);
    const auto sparse = shear::classify(volume, above_half, view::Classify::post, workers);
    EXPECT_TRUE(sparse.is_sparse.front());
    EXPECT_FALSE(shear::classify(volume, ramp_to(0.2), view::Classify::post, workers).is_sparse.front());
    EXPECT_FALSE(
        shear::classify(volume, above_half, view::Classify::pre_integrated, workers).is_sparse.front())
        << "segments reach beyond an octant";
}

struct Shown {
    int bits = 8;
    view::Sampling sampling{};
    view::ImageSize size{90, 70};
    std::optional<volume::Box> crop = {};
    bool some_hidden = false;
};

// By pieces, and by the volume.
void expect_as_by_volume(FloatCube& cube, const volume::Box& box, const Shown& taking) {
    base::Workers workers;
    const view::Lattice lattice{cube.n(), {1, 1.3, 0.8}};
    const BrickVolume volume = bricks_of(cube, box, workers, {.bits = taking.bits});
    const auto by_pieces = shear::classify(volume, above_half, view::Classify::post, workers);
    auto by_volume = shear::classify(volume, above_half, view::Classify::post, workers);
    by_volume.is_sparse.assign(by_volume.is_sparse.size(), false);
    // Nothing is lit in a hidden block: what else is left out with it is another's affair.
    std::optional<culling::VisibleBlocks> visible;
    if (taking.some_hidden) {
        const culling::BlockGrid grid(cube.n(), 16);
        visible = {grid, culling::BlockSet(grid.size())};
        for (std::size_t n = 0; n < grid.size(); ++n) {
            const volume::Box block = grid.box(grid.at(n));
            bool lit = false;
            for (std::int64_t z = block.lo[2]; z <= block.hi[2]; ++z) {
                for (std::int64_t y = block.lo[1]; y <= block.hi[1]; ++y) {
                    for (std::int64_t x = block.lo[0]; x <= block.hi[0]; ++x) {
                        lit = lit || cube.at(x, y, z) > 0.45F;
                    }
                }
            }
            visible->blocks.bytes()[n] = lit ? 1 : 0;
        }
    }
    int lit = 0, sparse = 0;
    for (const NamedView& view : all_views(lattice, 2)) {
        const auto factorisation =
            view::factorise(view.camera, taking.size, lattice, taking.sampling, taking.crop);
        sparse += by_pieces.is_sparse[static_cast<std::size_t>(factorisation.level())] ? 1 : 0;
        const auto picture = [&](const shear::Classification& classification) {
            const auto windows = shear::render(volume, classification, factorisation, workers,
                                               {.visible = visible ? &*visible : nullptr})
                                     .windows;
            return image::warp(factorisation, windows, view.camera, taking.size, {0, 0, 0}, workers);
        };
        const auto a = picture(by_pieces), b = picture(by_volume);
        EXPECT_LE(largest_difference(a, b), 1) << view.name;
        EXPECT_GE(psnr(a, b), 60) << view.name;
        lit += std::ranges::any_of(a.pixels(), [](const image::Rgba8& p) { return p.r + p.b > 20; }) ? 1 : 0;
    }
    EXPECT_GT(lit, 5);
    EXPECT_GT(sparse, 8);
}

TEST(Sparse, PiecesGiveTheSamePictures) {
    FloatCube cube = scattered_cube({131, 167, 97});
    const volume::Box whole = volume::whole(cube.n());
    const auto high = view::sampling(view::Quality::high);
    for (const int bits : {8, 16}) {
        expect_as_by_volume(cube, whole, {.bits = bits});
        expect_as_by_volume(cube, {{13, 5, 3}, {111, 160, 90}}, {.bits = bits, .sampling = high});
    }
    expect_as_by_volume(cube, whole, {.sampling = {.level_of_detail = true}, .size = {61, 47}});
    expect_as_by_volume(cube, whole, {.crop = volume::Box{{8, 0, 10}, {100, 140, 81}}});
    expect_as_by_volume(cube, whole, {.some_hidden = true});
}

}  // namespace
}  // namespace shearwater::test
