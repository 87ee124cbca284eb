// The names of cubes without a file, good and bad, and opening them like any other.

#include <gmock/gmock.h>

#include "common/cube/open.h"
#include "common/synthetic/source.h"

namespace shearwater::synthetic {
namespace {

TEST(SyntheticName, IsReadInEveryForm) {
    EXPECT_EQ(*parse("synthetic:random:2048"), (Name{"random", {2048, 2048, 2048}, 1}));
    EXPECT_EQ(*parse("synthetic:ball:7,8,9"), (Name{"ball", {7, 8, 9}, 1}));
    EXPECT_EQ(*parse("synthetic:random-bytes:16:77"), (Name{"random-bytes", {16, 16, 16}, 77}));
    for (const char* text : {"synthetic:random:7,8,9", "synthetic:random:7,8,9:4"}) {
        EXPECT_EQ(to_string(*parse(text)), text);
    }
}

TEST(SyntheticName, NothingElseIsTakenForOne) {
    for (const char* path :
         {"", "synthetic", "Synthetic:random:8", "/tmp/synthetic:random:8", "./synthetic:"}) {
        EXPECT_FALSE(is_synthetic(path)) << path;
    }
}

TEST(SyntheticName, WhatIsWrongWithOneIsSaid) {
    for (const char* path :
         {"synthetic:", "synthetic:random", "synthetic:random:", "synthetic:random:8,8",
          "synthetic:random:8,8,8,8", "synthetic:random:8x8x8", "synthetic:random:8,8,",
          "synthetic:random: 8", "synthetic:random:8:", "synthetic:random:8:-1", "synthetic:random:8:1:2",
          "synthetic:random:99999999999999999999", "synthetic:random:1", "synthetic:random:-8",
          "synthetic:random:8,8,2000000", "synthetic:pear:8", "synthetic::8"}) {
        const auto opened = Source::open(path);
        ASSERT_FALSE(opened) << path;
        EXPECT_EQ(opened.error().code, base::Code::invalid_argument) << path;
    }
}

TEST(SyntheticCube, IsOpenedLikeAFile) {
    auto cube = cube::open("synthetic:random-bytes:6,5,4");
    ASSERT_TRUE(cube);
    EXPECT_EQ(cube->info.n, (volume::Index3{6, 5, 4}));
    EXPECT_EQ(cube->info.bitpix, 8);
    EXPECT_EQ(cube->info.object, "random-bytes");
    std::vector<float> values(6 * 5 * 4, -1);
    ASSERT_TRUE(cube->source->read(volume::whole(cube->info.n), values));
    EXPECT_THAT(values, testing::Each(testing::Ge(0.0F)));
    EXPECT_EQ(cube::open("/nowhere.fits").error().code, base::Code::not_found);
}

TEST(SyntheticCube, KeepsItsNameWhereFilesGetAWholePath) {
    EXPECT_EQ(cube::absolute("synthetic:random:8"), "synthetic:random:8");
    EXPECT_TRUE(cube::absolute("some.fits").ends_with("/some.fits"));
    EXPECT_TRUE(cube::absolute("some.fits").starts_with("/"));
}

}  // namespace
}  // namespace shearwater::synthetic
