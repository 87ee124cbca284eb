// What a person types to say where a cube is.

#include "client/model/place.h"

#include <gtest/gtest.h>

#include <set>

namespace shearwater::model {
namespace {

using Kind = Place::Kind;

class PlaceTest : public testing::Test {
  protected:
    // "KIND what it leads to", or what is wrong.
    std::string read(std::string_view typed) {
        const Here here{[this](const std::string& path) { return files_.contains(path); }, "/work",
                        "/home/ann"};
        const auto place = place_from(typed, here);
        if (!place) {
            return "? " + place.error().message();
        }
        switch (place->kind) {
            case Kind::server:
                EXPECT_EQ(place->name, wire::to_string(place->address));
                return "server " + place->name;
            case Kind::elsewhere:
                return "ssh " + place->there.host + " " + place->there.path;
            case Kind::here:
                break;
        }
        return "here " + place->name;
    }

    std::set<std::string> files_;
};

TEST_F(PlaceTest, FilesAreMadeAbsolute) {
    EXPECT_EQ(read("/data/a b.fits"), "here /data/a b.fits");
    EXPECT_EQ(read("galaxy.fits"), "here /work/galaxy.fits");
    EXPECT_EQ(read("./galaxy.fits"), "here /work/galaxy.fits");
    EXPECT_EQ(read("../galaxy.fits"), "here /work/../galaxy.fits");
    EXPECT_EQ(read("~/galaxy.fits"), "here /home/ann/galaxy.fits");
    EXPECT_EQ(read("/data/a:7500"), "here /data/a:7500");
    EXPECT_EQ(read("./ann@big:/x"), "here /work/ann@big:/x");
    EXPECT_EQ(read("/\xff\x01"), "here /\xff\x01") << "names are any bytes";
    EXPECT_EQ(read("-o"), "here /work/-o") << "no option of a program that it is given to";
}

TEST_F(PlaceTest, AFormulaStaysAsItIs) {
    EXPECT_EQ(read("synthetic:noise-sources:64"), "here synthetic:noise-sources:64");
}

TEST_F(PlaceTest, ServersHavePorts) {
    EXPECT_EQ(read("localhost:7500"), "server localhost:7500");
    EXPECT_EQ(read(" 10.0.0.1:1\n"), "server 10.0.0.1:1");
    EXPECT_EQ(read("[::1]:7500"), "server [::1]:7500");
    for (const char* wrong : {"[::1]", "[::1", "localhost:", "localhost:0", "localhost:65536", "b c:7500"}) {
        EXPECT_EQ(read(wrong).substr(0, 2), "? ") << wrong;
    }
}

TEST_F(PlaceTest, CubesElsewhereHaveAHostAndAPath) {
    EXPECT_EQ(read("ann@big.org:/data/a:b.fits"), "ssh ann@big.org /data/a:b.fits");
    EXPECT_EQ(read("big:cube.fits"), "ssh big cube.fits");
    EXPECT_EQ(read("ann@big:7500"), "ssh ann@big 7500");
    EXPECT_EQ(read(" big:/x "), "ssh big /x");
    EXPECT_EQ(read("-oProxyCommand=x:/y"), "here /work/-oProxyCommand=x:/y") << "no option of ssh's";
}

TEST_F(PlaceTest, WhatIsHereComesFirst) {
    files_ = {"/work/localhost:7500", "/work/big:cube.fits", "/work/ x", "/work/synthetic:ball:8"};
    EXPECT_EQ(read("localhost:7500"), "here /work/localhost:7500");
    EXPECT_EQ(read("big:cube.fits"), "here /work/big:cube.fits");
    EXPECT_EQ(read(" x"), "here /work/ x") << "blanks and all";
    EXPECT_EQ(read("synthetic:ball:8"), "here /work/synthetic:ball:8");
}

TEST_F(PlaceTest, NothingTypedIsSaid) {
    EXPECT_EQ(read("").substr(0, 2), "? ");
    EXPECT_EQ(read(" \t ").substr(0, 2), "? ");
}

TEST_F(PlaceTest, IsSaidInPrintableWords) {
    const Here here{[](const std::string&) { return false; }, "/", ""};
    for (const char* typed : {"big\n\xff:/x", "/\xfe", "h:1"}) {
        const auto place = place_from(typed, here);
        ASSERT_TRUE(place);
        for (const std::string& words : {in_words(*place), advice(*place)}) {
            EXPECT_EQ(words, base::printable(words, 1000));
        }
    }
    EXPECT_EQ(in_words(*place_from("h:1", here)), "the server at h, port 1");
}

TEST(CubeNames, EndInFitsPerhapsCompressed) {
    for (const char* cube : {"a.fits", "/x/A.FITS", "a.fit", "a.fts", "a.fits.gz", "a.fits.fz"}) {
        EXPECT_TRUE(is_named_as_cube(cube)) << cube;
    }
    for (const char* other : {"a.png", "a.toml", "a.gz", "fits", ""}) {
        EXPECT_FALSE(is_named_as_cube(other)) << other;
    }
}

}  // namespace
}  // namespace shearwater::model
