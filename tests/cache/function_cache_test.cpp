// Opacity functions that are kept come back as they were, or not at all.

#include "renderer/cache/function_cache.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "common/culling/family.h"
#include "tests/support/temporary_folder.h"

namespace shearwater::cache {
namespace {

namespace fs = std::filesystem;

Content content_of(double centre) {
    return {.origin = {"/cubes/a.fits", 4711, 99, 1, 2},
            .n = {70, 40, 33},
            .box = {{0, 0, 0}, {40, 39, 32}},
            .mapping = {0, 2, volume::Stretch::sqrt, 8},
            .block_edge = 32,
            .side = 4,
            .key = {culling::Footprint::column, {view::Hat{centre, 0.1, 0.2, 1}, {{0.2, 0.3}}}, 0}};
}

// Of its 2 x 2 x 1 blocks.
culling::FunctionTable table_of(unsigned seed) {
    culling::FunctionTable table{.blocks = {{0, 0, 0}, {2, 2, 1}}, .side = 4, .codes = {}};
    std::mt19937 random(seed);
    for (int code = 0; code < 4 * 8; ++code) {
        table.codes.push_back(static_cast<std::uint8_t>(random()));
    }
    return table;
}

class FunctionCacheTest : public testing::Test {
  protected:
    FunctionCache cache(std::uint64_t most_bytes = FunctionCache::default_bytes) {
        return {folder_, [this](const std::string& line) { logged_.push_back(line); }, most_bytes};
    }
    std::vector<fs::path> files() const {
        std::vector<fs::path> paths;
        for (const auto& entry : fs::directory_iterator(folder_)) {
            paths.push_back(entry.path());
        }
        return paths;
    }
    static std::string read(const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    static void write(const fs::path& path, const std::string& bytes) {
        std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    }

    const support::TemporaryFolder scratch_;
    const std::string folder_ = scratch_.path("a/b");
    std::vector<std::string> logged_;
};

TEST_F(FunctionCacheTest, GivesBackWhatWasKept) {
    EXPECT_FALSE(cache().find(content_of(0.5)));
    cache().keep(content_of(0.5), table_of(1));
    cache().keep(content_of(0.6), table_of(2));
    EXPECT_EQ(cache().find(content_of(0.5)), table_of(1));
    EXPECT_EQ(cache().find(content_of(0.6)), table_of(2));
    cache().keep(content_of(0.5), table_of(3));
    EXPECT_EQ(cache().find(content_of(0.5)), table_of(3));
    EXPECT_EQ(files().size(), 2U) << "nothing unfinished is left";
    EXPECT_TRUE(logged_.empty());
}

// Whatever functions depend on makes others of them.
TEST_F(FunctionCacheTest, NothingElseIsTakenForIt) {
    cache().keep(content_of(0.5), table_of(1));
    const std::vector<std::function<void(Content&)>> changes{
        [](Content& c) { c.origin.path += "x"; },
        [](Content& c) { ++c.origin.bytes; },
        [](Content& c) { ++c.origin.modified; },
        [](Content& c) { ++c.origin.hdu; },
        [](Content& c) { ++c.origin.plane; },
        [](Content& c) { ++c.n[2]; },
        [](Content& c) { --c.box.hi[0]; },
        [](Content& c) { ++c.box.lo[1]; },
        [](Content& c) { c.mapping.lo = -1; },
        [](Content& c) { c.mapping.hi = 3; },
        [](Content& c) { c.mapping.stretch = volume::Stretch::log; },
        [](Content& c) { c.mapping.bits = 16; },
        [](Content& c) { c.block_edge = 16; },
        [](Content& c) { c.side = 8; },
        [](Content& c) { c.key.footprint = culling::Footprint::block; },
        [](Content& c) { c.key.level = 1; },
        [](Content& c) {
            c.key.basis.shape = view::Hat{0.5, 0.1, 0.2000001, 1};
        },
        [](Content& c) {
            c.key.basis.shape = view::Ramp{0.5, 0.1, 0.2, 1};
        },
        [](Content& c) { c.key.basis.blanks.clear(); },
    };
    for (std::size_t n = 0; n < changes.size(); ++n) {
        Content other = content_of(0.5);
        changes[n](other);
        EXPECT_NE(name_of(other), name_of(content_of(0.5))) << n;
        EXPECT_FALSE(cache().find(other)) << n;
    }
    EXPECT_TRUE(cache().find(content_of(0.5)));
}

TEST_F(FunctionCacheTest, ABrokenFileIsNoneAndIsReplaced) {
    cache().keep(content_of(0.5), table_of(1));
    const fs::path path = files().at(0);
    const std::string whole = read(path);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write(path, whole.substr(0, size));
        EXPECT_FALSE(cache().find(content_of(0.5))) << "cut off after " << size;
        std::string flipped = whole;
        flipped[size] = static_cast<char>(flipped[size] ^ (1 << size % 8));
        write(path, flipped);
        EXPECT_FALSE(cache().find(content_of(0.5))) << "byte " << size;
    }
    write(path, whole + "x");
    EXPECT_FALSE(cache().find(content_of(0.5)));
    EXPECT_EQ(logged_.size(), 2 * whole.size() + 1);
    cache().keep(content_of(0.5), table_of(1));
    EXPECT_EQ(cache().find(content_of(0.5)), table_of(1));
}

TEST_F(FunctionCacheTest, TheLongestUnusedGoFirst) {
    const std::uint64_t one = file_size(name_of(content_of(0)), table_of(0).codes.size());
    const auto three = cache(3 * one);
    const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(5);
    for (int n = 0; n < 3; ++n) {
        three.keep(content_of(0.1 * n), table_of(1));
    }
    for (const fs::path& path : files()) {
        fs::last_write_time(path, long_ago);
    }
    write(fs::path(folder_) / "left.part", "behind");
    fs::last_write_time(fs::path(folder_) / "left.part", long_ago);
    write(fs::path(folder_) / "of somebody else", std::string(1000, 'x'));
    EXPECT_TRUE(three.find(content_of(0.1)));
    three.keep(content_of(0.3), table_of(1));
    EXPECT_TRUE(three.find(content_of(0.1)));
    EXPECT_TRUE(three.find(content_of(0.3)));
    EXPECT_NE(three.find(content_of(0)).has_value(), three.find(content_of(0.2)).has_value());
    EXPECT_EQ(files().size(), 4U) << "three, and what is not the cache's";
    cache(one - 1).keep(content_of(0.7), table_of(1));
    EXPECT_FALSE(cache().find(content_of(0.7))) << "larger than all may be";
}

// Where nothing can be written that is said, and no more.
TEST_F(FunctionCacheTest, WhatCannotBeKeptIsLogged) {
    write(scratch_.path("a"), "a file where the folder is to be");
    cache().keep(content_of(0.5), table_of(1));
    EXPECT_EQ(logged_.size(), 1U);
    EXPECT_FALSE(cache().find(content_of(0.5)));
    fs::remove(scratch_.path("a"));
    // As on a full disk, part of a file can be written.
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const auto ignored = ::signal(SIGXFSZ, SIG_IGN);
    const rlimit full{.rlim_cur = 100, .rlim_max = old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &full);
    cache().keep(content_of(0.5), table_of(1));
    ::setrlimit(RLIMIT_FSIZE, &old);
    ::signal(SIGXFSZ, ignored);
    EXPECT_EQ(logged_.size(), 2U);
    EXPECT_TRUE(files().empty());
    if (::geteuid() != 0) {
        fs::create_directories(folder_);
        ::chmod(folder_.c_str(), 0500);
        cache().keep(content_of(0.5), table_of(1));
        EXPECT_EQ(logged_.size(), 3U);
        ::chmod(folder_.c_str(), 0700);
    }
}

TEST_F(FunctionCacheTest, AFileThatChangesIsAnotherOrigin) {
    const std::string path = scratch_.path("cube.fits");
    write(path, "one");
    const Origin one = origin_of(path, 1, 0);
    EXPECT_EQ(one.bytes, 3U);
    write(path, "three");
    EXPECT_NE(origin_of(path, 1, 0).bytes, one.bytes);
    write(path, "two");
    fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(1));
    EXPECT_NE(origin_of(path, 1, 0).modified, one.modified);
    EXPECT_EQ(origin_of("synthetic:ball:20", 0, 0).path, "synthetic:ball:20");
}

}  // namespace
}  // namespace shearwater::cache
