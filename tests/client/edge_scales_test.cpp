// Round steps, the outline of a box, and where ticks and their labels come to lie.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "client/model/edge_line.h"
#include "client/model/edge_scales.h"
#include "client/model/world_steps.h"
#include "common/view/project.h"

namespace shearwater::model::edge_scales_test {
namespace {

const wcs::Axis ra{.name = "right ascension",
                   .label = "RA",
                   .unit = "deg",
                   .notation = wcs::Notation::hours,
                   .circle = true,
                   .nodes = {2, 1, 1},
                   .values = {0.5, 359.5}};
const wcs::Axis dec{.name = "declination",
                    .label = "Dec",
                    .unit = "deg",
                    .notation = wcs::Notation::degrees,
                    .nodes = {1, 2, 1},
                    .values = {59.5, 60.5}};
const wcs::Axis velocity{
    .name = "velocity", .label = "Vel", .unit = "km/s", .nodes = {1, 1, 2}, .values = {-155, 265}};

TEST(WorldSteps, AreRoundInTheAxisUnit) {
    constexpr double second = 1.0 / 240, arcsecond = 1.0 / 3600;
    for (const auto& [least, step] : {std::pair(0.3, 0.5),
                                      {0.7, 1.0},
                                      {1.0, 1.0},
                                      {3, 5},
                                      {6, 10},
                                      {11, 15},
                                      {16, 30},
                                      {31, 60},
                                      {61, 120},
                                      {700, 900},
                                      {1801, 3600},
                                      {4000, 7200},
                                      {30000, 43200},
                                      {1e9, 43200}}) {
        EXPECT_NEAR(world_step(ra, least * second), step * second, 1e-12) << least;
    }
    for (const auto& [least, step] :
         {std::pair(0.011, 0.02), {20, 30}, {50, 60}, {1900, 3600}, {3700, 7200}, {1e9, 324000}}) {
        EXPECT_NEAR(world_step(dec, least * arcsecond), step * arcsecond, 1e-12) << least;
    }
    for (const auto& [least, step] : {std::pair(0.0003, 0.0005), {0.9, 1.0}, {7, 10}, {42, 50}, {300, 500}}) {
        EXPECT_NEAR(world_step(velocity, least), step, 1e-12) << least;
    }
    wcs::Axis longitude{.circle = true};
    EXPECT_EQ(world_step(longitude, 40), 45);
    EXPECT_EQ(world_step(longitude, 400), 90);
    EXPECT_EQ(world_step(longitude, 3), 5);
}

const view::Lattice lattice{.n = {101, 81, 61}, .spacing = {1, 1, 1.5}};
const view::ImageSize size{900, 600};
const volume::Box whole = volume::whole(lattice.n);

view::Camera camera(double azimuth, double elevation,
                    view::Projection projection = view::Projection::perspective, double distance = 0) {
    const view::Orbit orbit{.azimuth = azimuth, .elevation = elevation, .distance = distance, .target = {}};
    return view::camera_on(orbit, lattice, projection);
}

TEST(Outline, IsASixSidedOneOrAFace) {
    for (const auto projection : {view::Projection::perspective, view::Projection::parallel}) {
        EXPECT_EQ(outline(camera(30, 20, projection), size, lattice, whole).size(), 6U);
        // From +z: the nearest face's four edges, at its last plane.
        const auto face = outline(camera(0, 0, projection), size, lattice, whole);
        ASSERT_EQ(face.size(), 4U);
        for (const Edge& edge : face) {
            EXPECT_NE(edge.along, 2);
            EXPECT_EQ(edge.from.z, 60);
            EXPECT_EQ(edge.to.z, 60);
        }
    }
    EXPECT_TRUE(outline(camera(30, 20, view::Projection::perspective, 5), size, lattice, whole).empty())
        << "inside";
}

TEST(Crossings, LieWhereTheAxisHasTheValue) {
    const Edge edge{.along = 0, .from = {0, 0, 0}, .to = {100, 0, 0}};
    const Part part{.first = 0, .last = 1, .from = {}, .to = {}};
    // RA falls from 2 minutes to -2 minutes.
    EXPECT_NEAR(extent(edge, part, ra, lattice.n), 1, 1e-9);
    const auto found = crossings(edge, part, ra, lattice.n, 0.25, 64);
    ASSERT_EQ(found.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(found[i].t, 0.25 * static_cast<double>(i), 1e-9);
        EXPECT_NEAR(found[i].value, 0.5 - 0.25 * static_cast<double>(i), 1e-9);
    }
    EXPECT_EQ(crossings(edge, part, ra, lattice.n, 1e-9, 64).size(), 64U) << "no more than asked for";
    EXPECT_TRUE(crossings(edge, part, ra, lattice.n, 0, 64).empty());
    EXPECT_TRUE(crossings(edge, part, dec, lattice.n, 0.25, 64).size() <= 1U)
        << "nothing changes along the edge";
    EXPECT_TRUE(crossings(edge, part, wcs::Axis{}, lattice.n, 0.25, 64).empty());
}

ScaleStyle style(double scale = 1) {
    return {.mark = 5 * scale,
            .gap = 4 * scale,
            .size_of =
                [scale](const std::string& text) {
                    return view::Vec2{scale * 7 * static_cast<double>(text.size()), 14 * scale};
                },
            .reserved = {{{0, 512}, {88, 88}}}};
}

std::vector<std::string> texts(const EdgeScale& scale) {
    std::vector<std::string> all;
    for (const EdgeScale::Label& label : scale.labels) {
        all.push_back(label.text);
    }
    return all;
}

TEST(EdgeScales, SayWhatTheHeaderSays) {
    const auto scales = edge_scales(camera(0, 0), size, lattice, whole, {ra, dec, velocity}, style());
    ASSERT_EQ(scales.size(), 2U);
    EXPECT_EQ(scales[0].along, 0);
    EXPECT_THAT(texts(scales[0]),
                testing::ElementsAre("00h02m", "00h01m", "00h00m", "23h59m", "23h58m", "right ascension"));
    EXPECT_TRUE(scales[0].titled);
    EXPECT_EQ(texts(scales[1]).back(), "declination");
    EXPECT_THAT(texts(scales[1]), testing::Contains("+60\u00b000'"));
    // Below and to the left of the face, each label at its mark.
    for (const EdgeScale& scale : scales) {
        ASSERT_GE(scale.labels.size(), 4U);
        for (std::size_t i = 0; i + 1 < scale.labels.size(); ++i) {
            const view::Vec2 middle = scale.labels[i].plate.from + scale.labels[i].plate.size / 2.0;
            const bool beside = std::ranges::any_of(scale.marks, [&](const EdgeScale::Mark& mark) {
                return scale.along == 0 ? std::abs(mark.from.x - middle.x) < 1e-6 &&
                                              mark.to.y > mark.from.y && middle.y > mark.to.y
                                        : std::abs(mark.from.y - middle.y) < 1e-6 &&
                                              mark.to.x < mark.from.x && middle.x < mark.to.x;
            });
            EXPECT_TRUE(beside) << scale.labels[i].text;
        }
    }
    const Part across =
        *part_in_picture({.along = 0, .from = {0, 0, 60}, .to = {100, 0, 60}}, camera(0, 0), size, lattice);
    EXPECT_NEAR(scales[0].marks.front().from.x, across.from.x, 1e-6);
    EXPECT_NEAR(scales[0].marks.back().from.x, across.to.x, 1e-6);
}

TEST(EdgeScales, CountVoxelsWhereTheHeaderSaysNothing) {
    const auto scales = edge_scales(camera(0, 0), size, lattice, {{0, 0, 0}, {4, 80, 60}}, {}, style());
    ASSERT_FALSE(scales.empty());
    for (const EdgeScale& scale : scales) {
        for (const std::string& text : texts(scale)) {
            EXPECT_EQ(text.find('.'), std::string::npos) << text;
        }
    }
}

// Of whatever view: labels lie apart, within the picture, clear of what is reserved and of the box.
TEST(EdgeScales, NothingLiesOverAnything) {
    std::mt19937 random(11);
    const auto within = [&](double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random);
    };
    const wcs::Axes axes{ra, dec, velocity};
    std::size_t labels = 0, titles = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const auto projection = trial % 3 == 0 ? view::Projection::parallel : view::Projection::perspective;
        const view::Camera seen = camera(within(-180, 180), within(-89, 89), projection, within(90, 900));
        const auto scales = edge_scales(seen, size, lattice, whole, axes, style(trial % 2 == 0 ? 1 : 2));
        std::vector<Plate> plates{{{0, 512}, {88, 88}}};
        for (const EdgeScale& scale : scales) {
            titles += scale.titled ? 1 : 0;
            EXPECT_GE(scale.labels.size(), scale.titled ? 2U : 1U) << "marks without values";
            for (const EdgeScale::Label& label : scale.labels) {
                ++labels;
                EXPECT_GE(label.plate.from.x, 0);
                EXPECT_GE(label.plate.from.y, 0);
                EXPECT_LE(label.plate.from.x + label.plate.size.x, size.width);
                EXPECT_LE(label.plate.from.y + label.plate.size.y, size.height);
                for (const Plate& other : plates) {
                    EXPECT_FALSE(label.plate.overlaps(other, 0)) << trial << " " << label.text;
                }
                plates.push_back(label.plate);
            }
        }
        // The box, by many of its points.
        for (int i = 0; i < 400; ++i) {
            view::Vec3 voxel{within(0, 100), within(0, 80), within(0, 60)};
            voxel[i % 3] = i % 2 == 0 ? 0 : static_cast<double>(whole.hi[static_cast<std::size_t>(i % 3)]);
            const view::Projected point = view::project(seen, size, lattice.world_from_voxel(voxel));
            for (std::size_t k = 1; k < plates.size() && point.seen_by(seen); ++k) {
                EXPECT_FALSE(plates[k].overlaps({point.at, {0, 0}}, 0)) << trial;
            }
        }
    }
    EXPECT_GT(labels, 2000U);
    EXPECT_GT(titles, 400U);
}

// From a peer: whatever is valid on the wire ends, with a bounded number of labels.
TEST(EdgeScales, OfAnyValues) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        wcs::Axis odd = trial % 2 == 0 ? ra : velocity;
        odd.nodes = {3, 3, 3};
        odd.values.clear();
        for (int i = 0; i < 27; ++i) {
            const double values[] = {0,
                                     1e-100,
                                     720,
                                     -720,
                                     std::nan(""),
                                     1,
                                     -1e-9,
                                     odd.notation == wcs::Notation::plain ? 1e100 : 5};
            odd.values.push_back(values[random() % std::size(values)]);
        }
        ASSERT_TRUE(wcs::validate(odd, 0));
        for (const EdgeScale& scale :
             edge_scales(camera(30, 20), size, lattice, whole, {odd, odd, odd}, style())) {
            EXPECT_LE(scale.labels.size(), 65U);
        }
    }
}

}  // namespace
}  // namespace shearwater::model::edge_scales_test
