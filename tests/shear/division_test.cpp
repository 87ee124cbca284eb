// One picture for every division: the leaves' windows, in 16 bits as they travel, merged in visibility
// order and warped, beside the picture of one renderer.

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>

#include "common/image/over_windows.h"
#include "common/image/warp.h"
#include "common/tree/division.h"
#include "tests/support/reference_raycaster.h"
#include "tests/support/reference_views.h"

namespace shearwater::test {
namespace {

using image::Image;
using image::Rgba8;
using image::Window;
using view::Factorisation;
using view::ImageSize;
using view::Lattice;
using volume::Box;
using volume::Index3;

// Cuts of a box, or a leaf where there are none.
struct Node {
    Box box;
    std::vector<Node> parts;
};

Node cut(const Box& box, int axis, std::vector<std::int64_t> planes) {
    const auto a = static_cast<std::size_t>(axis);
    Node node{.box = box};
    planes.push_back(box.hi[a]);
    std::int64_t from = box.lo[a];
    for (const std::int64_t plane : planes) {
        Box part = box;
        part.lo[a] = from;
        part.hi[a] = plane;
        node.parts.push_back({.box = part});
        from = plane;
    }
    return node;
}

Node even_cut(const Box& box, int axis, int pieces) {
    std::vector<std::int64_t> planes;
    for (int i = 1; i < pieces; ++i) {
        planes.push_back(box.lo[static_cast<std::size_t>(axis)] + box.cells(axis) * i / pieces);
    }
    return cut(box, axis, planes);
}

// As a tree of renderers has it.
Node division(const Box& box, int pieces, int levels) {
    Node node{.box = box};
    if (levels > 0) {
        const std::vector<double> even(static_cast<std::size_t>(pieces), 1.0);
        for (const Box& part : tree::divide(box, even).value()) {
            node.parts.push_back(division(part, pieces, levels - 1));
        }
    }
    return node;
}

// Loads every leaf's bricks once, to be drawn in many views.
class Tree {
  public:
    Tree(const Node& node, FloatCube& cube, base::Workers& workers, const volume::Mapping& mapping)
        : box_(node.box) {
        for (const Node& part : node.parts) {
            children_.emplace_back(part, cube, workers, mapping);
        }
        if (children_.empty()) {
            leaf_.push_back(bricks_of(cube, node.box, workers, mapping));
        }
    }

    std::vector<Window> render(const Factorisation& f, const view::TransferFunction& tf,
                               base::Workers& workers, std::uint64_t& samples) const {
        if (!leaf_.empty()) {
            auto [windows, stats] = shear::render(leaf_[0], f, tf, workers);
            samples += stats.samples;
            return std::move(windows);
        }
        std::vector<Box> boxes;
        for (const Tree& child : children_) {
            boxes.push_back(child.box_);
        }
        std::vector<image::CodedWindows> payloads;
        std::vector<image::SpanWindow> arrived;
        for (const int child : view::visibility_order(f, boxes)) {
            payloads.push_back(
                image::encode(children_[static_cast<std::size_t>(child)].render(f, tf, workers, samples)));
            const auto& windows = payloads.back().windows;
            arrived.insert(arrived.end(), windows.begin(), windows.end());
        }
        return image::merge_front_to_back(arrived);
    }

  private:
    Box box_;
    std::vector<Tree> children_;
    std::vector<shear::BrickVolume> leaf_;
};

struct Picture {
    Image<Rgba8> pixels;
    std::uint64_t samples = 0;
    int level = 0;
};

Picture picture_of_tree(const Tree& tree, const Lattice& lattice, const view::Camera& camera,
                        const ImageSize& size, const view::TransferFunction& tf, base::Workers& workers,
                        const view::Sampling& sampling, const std::optional<Box>& crop) {
    const Factorisation f = view::factorise(camera, size, lattice, sampling, crop);
    Picture picture{.pixels = {}, .samples = 0, .level = f.level()};
    const auto windows = tree.render(f, tf, workers, picture.samples);
    picture.pixels = image::warp(f, windows, camera, size, {0, 0, 0}, workers);
    return picture;
}

// How the pictures of an expectation are taken.
struct Taking {
    view::Vec3 spacing{1, 1, 1};
    volume::Mapping mapping{};
    std::size_t every = 1;  // of all views
    ImageSize size{90, 70};
    view::Sampling sampling{};
    view::TransferFunction tf = ramp_to(0.2);
    std::optional<Box> crop = {};
};

// Returns how many pictures were taken of each level of detail.
std::map<int, int> expect_one_picture(FloatCube& cube, const std::vector<Node>& divisions,
                                      const Taking& taking = {}) {
    base::Workers workers;
    const Lattice lattice{cube.n(), taking.spacing};
    const Tree whole({.box = volume::whole(cube.n())}, cube, workers, taking.mapping);
    // Nothing gets opaque under this one, so every sample is taken by whoever owns it.
    const view::TransferFunction thin{.opacity_pins = {view::Flat{1e-9}}, .colour_pins = {{0, {1, 1, 1}}}};
    std::map<int, int> levels;
    std::vector<Tree> trees;
    for (const Node& node : divisions) {
        trees.emplace_back(node, cube, workers, taking.mapping);
    }
    for (const NamedView& view : all_views(lattice, taking.every)) {
        const auto picture = [&](const Tree& tree, const view::TransferFunction& by) {
            return picture_of_tree(tree, lattice, view.camera, taking.size, by, workers, taking.sampling,
                                   taking.crop);
        };
        const Picture one = picture(whole, taking.tf);
        const Picture count = picture(whole, thin);
        ++levels[one.level];
        for (std::size_t i = 0; i < trees.size(); ++i) {
            const Picture many = picture(trees[i], taking.tf);
            EXPECT_LE(largest_difference(one.pixels, many.pixels), 1) << view.name << ", division " << i;
            EXPECT_GE(psnr(one.pixels, many.pixels), 60) << view.name << ", division " << i;
            EXPECT_EQ(picture(trees[i], thin).samples, count.samples) << view.name << ", division " << i;
        }
    }
    return levels;
}

TEST(Division, AcrossEveryAxisGivesOnePicture) {
    FloatCube cube = noise_cube({47, 41, 53});
    const Box whole = volume::whole(cube.n());
    std::vector<Node> divisions;
    for (int axis = 0; axis < 3; ++axis) {
        for (const int pieces : {2, 3, 5, 8}) {
            divisions.push_back(even_cut(whole, axis, pieces));
        }
    }
    expect_one_picture(cube, divisions, {.every = 5});
    // An eye on the plane of a cut, and rays along it.
    expect_one_picture(cube, {divisions[0], divisions[4], divisions[8]});
}

TEST(Division, InTreesGivesOnePicture) {
    FloatCube cube = noise_cube({67, 37, 43}, 2);
    std::vector<Node> divisions;
    for (const auto& [pieces, levels] : {std::pair{2, 2}, {2, 3}, {3, 2}, {8, 1}}) {
        divisions.push_back(division(volume::whole(cube.n()), pieces, levels));
    }
    expect_one_picture(cube, divisions, {.spacing = {1, 0.4, 1.7}, .every = 2});
}

// Slivers one cell thin, beside one another and at the cube's edges; parts cut along different axes.
TEST(Division, UnevenlyGivesOnePicture) {
    FloatCube cube = blanked(noise_cube({34, 33, 35}, 3), 11);
    const Box whole = volume::whole(cube.n());
    Node slivers = cut(whole, 0, {1, 2, 20, 32});
    slivers.parts[2] = cut(slivers.parts[2].box, 1, {31});
    slivers.parts[3] = cut(slivers.parts[3].box, 2, {1, 17, 33});
    Node single = cut(cut(cut(whole, 2, {17}).parts[0].box, 1, {16}).parts[0].box, 0, {15});
    Node nested = cut(whole, 2, {17});
    nested.parts[0] = cut(nested.parts[0].box, 1, {16});
    nested.parts[0].parts[0] = single;
    expect_one_picture(cube, {slivers, nested}, {.mapping = {.bits = 16}});
}

// Cuts that fall on nodes of no level but the voxels, on pictures in which voxels are small.
TEST(Division, OnCoarserLevelsGivesOnePicture) {
    FloatCube cube = blanked(noise_cube({131, 67, 97}, 4), 7);
    const Box whole = volume::whole(cube.n());
    const Node tree = division(whole, 2, 3);
    Node uneven = cut(whole, 0, {1, 2, 3, 37, 41, 129});
    uneven.parts[3] = cut(uneven.parts[3].box, 1, {31});
    uneven.parts[5] = cut(uneven.parts[5].box, 2, {1, 17, 50, 95});
    const std::vector<Node> divisions{tree, uneven, even_cut(whole, 1, 3), even_cut(whole, 2, 7)};
    for (const int bits : {8, 16}) {
        const auto levels = expect_one_picture(cube, divisions,
                                               {.mapping = {.bits = bits},
                                                .every = bits == 8 ? 1U : 5U,
                                                .size = {91, 71},
                                                .sampling = {.level_of_detail = true}});
        EXPECT_GT(levels.contains(1) ? levels.at(1) : 0, 2);
    }
    const auto levels = expect_one_picture(
        cube, divisions, {.every = 3, .size = {37, 29}, .sampling = {.level_of_detail = true}});
    EXPECT_GT(levels.contains(2) ? levels.at(2) : 0, 2);
}

// Boxes to crop to that end on planes of cuts, beside them and between, and that leave whole parts out.
TEST(Division, OfACroppedCubeGivesOnePicture) {
    FloatCube cube = noise_cube({47, 41, 53}, 8);
    const Box whole = volume::whole(cube.n());
    const Node tree = division(whole, 2, 3);
    Node slivers = cut(whole, 2, {1, 9, 10, 11, 40});
    slivers.parts[4] = cut(slivers.parts[4].box, 0, {8, 23, 24});
    const std::vector<Node> divisions{tree, slivers, cut(whole, 0, {8, 23}), even_cut(whole, 1, 3)};
    for (const Box& crop : {Box{{8, 0, 10}, {23, 40, 40}}, Box{{23, 5, 11}, {24, 33, 52}},
                            Box{{7, 13, 9}, {24, 27, 10}}, Box{{0, 0, 0}, {46, 40, 1}}}) {
        for (const auto classify : {view::Classify::post, view::Classify::pre_integrated}) {
            expect_one_picture(cube, divisions,
                               {.every = 5, .sampling = {.classify = classify}, .crop = crop});
        }
    }
    const auto high = view::sampling(view::Quality::high);
    expect_one_picture(cube, divisions, {.every = 5, .sampling = high, .crop = Box{{8, 0, 9}, {24, 40, 41}}});
}

TEST(Division, OfACroppedCubeOnCoarserLevelsGivesOnePicture) {
    FloatCube cube = noise_cube({131, 67, 97}, 9);
    const Box whole = volume::whole(cube.n());
    const Node tree = division(whole, 2, 3);
    const std::vector<Node> divisions{tree, cut(whole, 0, {1, 2, 3, 37, 41, 129}), even_cut(whole, 2, 7)};
    for (const auto classify : {view::Classify::post, view::Classify::pre_integrated}) {
        auto levels = expect_one_picture(cube, divisions,
                                         {.every = 4,
                                          .size = {37, 29},
                                          .sampling = {.level_of_detail = true, .classify = classify},
                                          .crop = Box{{37, 0, 13}, {129, 33, 95}}});
        EXPECT_GT(levels[1] + levels[2], 2);
    }
}

// Segments that begin in one part and end in another, and a transfer function that shows where one is cut
// short: most of what is seen lies between two samples.
class DivisionOfSegments : public testing::Test {
  protected:
    static Taking taking(std::size_t every, const view::ImageSize& size, const view::Sampling& sampling) {
        Taking made{.every = every, .size = size, .sampling = sampling};
        made.sampling.classify = view::Classify::pre_integrated;
        made.tf.opacity_pins = {view::Hat{0.4, 0.01, 0.01, 0.9}, view::Hat{0.7, 0.03, 0.03, 0.5}};
        return made;
    }
};

TEST_F(DivisionOfSegments, AcrossEveryAxisGivesOnePicture) {
    FloatCube cube = noise_cube({27, 41, 33}, 5);
    const Box whole = volume::whole(cube.n());
    std::vector<Node> halves, fifths;
    for (int axis = 0; axis < 3; ++axis) {
        halves.push_back(even_cut(whole, axis, 2));
        fifths.push_back(even_cut(whole, axis, 5));
    }
    // Among all views, an eye on the plane of a cut, and rays along it.
    expect_one_picture(cube, halves, taking(1, {40, 33}, {}));
    expect_one_picture(cube, fifths, taking(5, {60, 50}, {}));
    expect_one_picture(cube, fifths, taking(5, {60, 50}, view::sampling(view::Quality::high)));
}

TEST_F(DivisionOfSegments, IntoSliversGivesOnePicture) {
    FloatCube cube = blanked(noise_cube({34, 33, 35}, 6), 11);
    Node slivers = cut(volume::whole(cube.n()), 0, {1, 2, 20, 32});
    slivers.parts[2] = cut(slivers.parts[2].box, 1, {31});
    slivers.parts[3] = cut(slivers.parts[3].box, 2, {1, 17, 33});
    for (const auto quality : {view::Quality::normal, view::Quality::high}) {
        Taking pictures = taking(3, {60, 50}, view::sampling(quality));
        pictures.mapping.bits = 16;
        pictures.spacing = {1, 0.4, 1.7};
        expect_one_picture(cube, {slivers}, pictures);
    }
}

TEST_F(DivisionOfSegments, OnCoarserLevelsGivesOnePicture) {
    FloatCube cube = blanked(noise_cube({131, 67, 97}, 7), 7);
    const Box whole = volume::whole(cube.n());
    const Node tree = division(whole, 2, 3);
    const std::vector<Node> divisions{tree, cut(whole, 0, {1, 2, 3, 37, 41, 129}), even_cut(whole, 1, 3),
                                      even_cut(whole, 2, 7)};
    auto levels = expect_one_picture(cube, divisions, taking(3, {71, 55}, {.level_of_detail = true}));
    EXPECT_GT(levels[1], 2);
    levels = expect_one_picture(cube, divisions, taking(4, {37, 29}, {.level_of_detail = true}));
    EXPECT_GT(levels[2], 2);
}

}  // namespace
}  // namespace shearwater::test
