#include "common/view/bands.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace shearwater::view {
namespace {

Factorisation faces(std::vector<Face> faces) {
    Factorisation f;
    f.faces = std::move(faces);
    return f;
}

Factorisation face(int axis, int width, int height) {
    return faces({{.axis = axis, .width = width, .height = height}});
}

// In order, edge to edge from the first line to the last, each as long as the face.
void expect_to_cover(const Factorisation& f) {
    std::vector<int> lines(f.faces.size());
    std::vector<int> count(f.faces.size());
    int last_face = 0;
    for (const Band& band : bands_of(f)) {
        ASSERT_GE(band.face, last_face);
        last_face = band.face;
        const Face& face = f.faces.at(static_cast<std::size_t>(band.face));
        int& reached = lines[static_cast<std::size_t>(band.face)];
        const Rect along = face.axis == 1 ? Rect{reached, 0, band.rect.x1, face.height}
                                          : Rect{0, reached, face.width, band.rect.y1};
        EXPECT_EQ(band.rect, along);
        EXPECT_FALSE(band.rect.empty());
        reached = face.axis == 1 ? band.rect.x1 : band.rect.y1;
        ++count[static_cast<std::size_t>(band.face)];
    }
    for (std::size_t n = 0; n < f.faces.size(); ++n) {
        EXPECT_EQ(lines[n], f.faces[n].axis == 1 ? f.faces[n].width : f.faces[n].height);
        EXPECT_LE(count[n], Band::most_per_face);
    }
}

TEST(Bands, CoverEveryFaceOnce) {
    std::mt19937 random(3);
    const auto side = [&](int most) { return 1 + static_cast<int>(random() % static_cast<unsigned>(most)); };
    for (int n = 0; n < 2000; ++n) {
        std::vector<Face> six;
        for (int i = 0; i < Factorisation::max_faces; ++i) {
            const int most = n % 2 == 0 ? Factorisation::max_side : 1200;
            six.push_back({.axis = i % 3, .width = side(most), .height = side(most)});
        }
        expect_to_cover(faces(six));
    }
    for (int lines = 1; lines <= Factorisation::max_side; lines += lines < 2000 ? 1 : 97) {
        expect_to_cover(face(2, 1000, lines));
    }
}

// Each but a face's last is large enough, and ends where a renderer's tiles do.
TEST(Bands, AreWorthAMessage) {
    for (const int axis : {0, 1, 2}) {
        for (int n = 1; n < 3000; n += 7) {
            const std::vector<Band> bands = bands_of(face(axis, axis == 1 ? n : 500, axis == 1 ? 500 : n));
            for (std::size_t i = 0; i + 1 < bands.size(); ++i) {
                const int lines = axis == 1 ? bands[i].rect.width() : bands[i].rect.height();
                EXPECT_GE(lines, Band::least_lines);
                EXPECT_EQ(lines % Band::line_step, 0);
                EXPECT_GE(bands[i].rect.area(), Band::least_pixels);
            }
        }
    }
}

TEST(Bands, AreAboutEightOfAnOrdinaryFaceAndOneOfASmallOne) {
    EXPECT_EQ(bands_of(face(2, 520, 520)).size(), 9U);
    EXPECT_EQ(bands_of(face(1, 1040, 800)).size(), 9U);
    EXPECT_EQ(bands_of(face(0, 1500, 1500)).size(), 8U);
    EXPECT_EQ(bands_of(face(2, 300, 64)).size(), 1U);
    EXPECT_EQ(bands_of(face(2, 100, 327)).size(), 1U);
    EXPECT_EQ(bands_of(face(2, 1, Factorisation::max_side)).size(), 1U);
    EXPECT_TRUE(bands_of(faces({})).empty());
}

}  // namespace
}  // namespace shearwater::view
