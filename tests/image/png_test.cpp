#include "common/image/png.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace shearwater::image {
namespace {

namespace fs = std::filesystem;

class Png : public testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "shearwater-png-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::size_t files() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

Image<Rgba8> picture(int width, int height, bool opaque) {
    std::mt19937 random(1);
    Image<Rgba8> image(width, height);
    for (Rgba8& p : image.pixels()) {
        p = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
             static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(opaque ? 255 : random())};
    }
    return image;
}

bool same(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin());
}

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(Png, ComesBackExactly) {
    for (const bool opaque : {true, false}) {
        const auto image = picture(37, 23, opaque);
        ASSERT_TRUE(write_png(path("a.png"), image));
        const auto back = read_png(path("a.png"));
        ASSERT_TRUE(back) << back.error().message();
        EXPECT_TRUE(same(*back, image));
    }
    EXPECT_EQ(files(), 1u) << "nothing but the picture stays behind";
}

TEST_F(Png, ReplacesAFileWholeOrNotAtAll) {
    ASSERT_TRUE(write_png(path("a.png"), picture(8, 8, true)));
    ASSERT_TRUE(write_png(path("a.png"), picture(9, 9, true)));
    EXPECT_EQ(read_png(path("a.png")).value().width(), 9);

    fs::create_directory(folder_ / "folder");
    EXPECT_FALSE(write_png(path("folder"), picture(8, 8, true)));
    const auto nowhere = write_png(path("none/a.png"), picture(8, 8, true));
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().code, base::Code::io);
    EXPECT_EQ(files(), 2u);
}

// Reached through links of ours, so that nothing but a link is at stake should this be broken.
TEST_F(Png, ADeviceIsWrittenInPlace) {
    for (const char* device : {"null", "full"}) {
        fs::create_symlink(std::string("/dev/") + device, folder_ / device);
    }
    EXPECT_TRUE(write_png(path("null"), picture(8, 8, true)));
    EXPECT_FALSE(write_png(path("full"), picture(64, 64, true)));
    EXPECT_TRUE(fs::is_symlink(folder_ / "null"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "full"));
}

TEST_F(Png, DashIsStandardOutput) {
    const std::string out = path("out.png");
    const pid_t child = fork();
    if (child == 0) {
        const bool good =
            std::freopen(out.c_str(), "wb", stdout) != nullptr && write_png("-", picture(5, 4, true));
        _exit(good ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(same(read_png(out).value(), picture(5, 4, true)));
}

TEST_F(Png, MissingAndForeignFilesAreNamed) {
    EXPECT_EQ(read_png(path("none.png")).error().code, base::Code::not_found);
    std::ofstream(path("text.png")) << "no picture";
    EXPECT_EQ(read_png(path("text.png")).error().code, base::Code::corrupt);
}

TEST_F(Png, EveryTruncationIsRefused) {
    ASSERT_TRUE(write_png(path("a.png"), picture(6, 5, true)));
    const std::string whole = bytes_of(path("a.png"));
    // The last 12 bytes are the end marker, which says nothing about the pixels.
    for (std::size_t cut = 0; cut + 12 < whole.size(); ++cut) {
        std::ofstream(path("cut.png"), std::ios::binary) << whole.substr(0, cut);
        EXPECT_FALSE(read_png(path("cut.png"))) << cut;
    }
}

// A header that claims what the file cannot hold is refused before anything is allocated for it.
TEST_F(Png, AHugeClaimIsRefused) {
    ASSERT_TRUE(write_png(path("a.png"), picture(6, 5, true)));
    std::string bytes = bytes_of(path("a.png"));
    bytes.replace(16, 8, std::string("\0\0\x7f\xff\0\0\x7f\xff", 8));
    const std::string crc("\xc6\x90\x91\x6a", 4);
    bytes.replace(29, 4, crc);
    std::ofstream(path("huge.png"), std::ios::binary) << bytes;
    const auto huge = read_png(path("huge.png"));
    ASSERT_FALSE(huge);
    EXPECT_EQ(huge.error().code, base::Code::too_large) << huge.error().message();
}

TEST_F(Png, FuzzedFilesNeverCrash) {
    ASSERT_TRUE(write_png(path("a.png"), picture(12, 9, false)));
    const std::string whole = bytes_of(path("a.png"));
    std::mt19937 random(3);
    for (int round = 0; round < 500; ++round) {
        std::string bytes = whole;
        for (int edit = 0; edit < 3; ++edit) {
            bytes[random() % bytes.size()] = static_cast<char>(random());
        }
        std::ofstream(path("fuzz.png"), std::ios::binary) << bytes;
        const auto read = read_png(path("fuzz.png"));
        EXPECT_TRUE(!read || !read->empty());
    }
}

// What a note is, and that it changes no pixel.
TEST_F(Png, CarriesANote) {
    const auto image = picture(37, 23, true);
    const std::string note = "camera = \"here\"\n\u03b1 = 1\n";
    ASSERT_TRUE(write_png(path("a.png"), image, note));
    EXPECT_TRUE(is_png(path("a.png")));
    EXPECT_EQ(read_png_note(path("a.png")).value(), note);
    const auto back = read_png(path("a.png"));
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_TRUE(same(*back, image));

    ASSERT_TRUE(write_png(path("b.png"), image));
    EXPECT_EQ(read_png_note(path("b.png")).error().code, base::Code::not_found);
    EXPECT_EQ(read_png_note(path("none.png")).error().code, base::Code::not_found);
    const std::string longest(longest_note, 'x');
    ASSERT_TRUE(write_png(path("c.png"), image, longest));
    EXPECT_EQ(read_png_note(path("c.png")).value(), longest);
}

// A picture cut at every byte has its whole note, or none and an error.
TEST_F(Png, ANoteCutShortIsRefused) {
    const std::string note = "some note";
    ASSERT_TRUE(write_png(path("a.png"), picture(5, 4, true), note));
    const std::string whole = bytes_of(path("a.png"));
    std::size_t found = 0;
    for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
        std::ofstream(path("cut.png"), std::ios::binary) << whole.substr(0, bytes);
        const auto read = read_png_note(path("cut.png"));
        EXPECT_EQ(is_png(path("cut.png")), bytes >= 8);
        if (read) {
            ++found;
            EXPECT_EQ(*read, note);
        } else {
            EXPECT_EQ(read.error().code, base::Code::corrupt) << bytes;
        }
    }
    EXPECT_GT(found, 0U);
    std::size_t damaged = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x40);
        std::ofstream(path("changed.png"), std::ios::binary) << changed;
        const auto read = read_png_note(path("changed.png"));
        damaged += read ? 0U : 1U;
        EXPECT_TRUE(!read || *read == note) << at;
    }
    EXPECT_GT(damaged, note.size());
}

}  // namespace
}  // namespace shearwater::image
