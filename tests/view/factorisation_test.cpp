#include "common/view/factorisation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "common/volume/levels.h"

namespace shearwater::view {
namespace {

using volume::Box;

const Lattice skewed_lattice{{60, 41, 73}, {1, 1.3, 0.7}};

std::vector<Camera> cameras() {
    std::vector<Camera> all;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 60; ++i) {
        const double distance = std::array{0.1, 0.4, 0.8, 3.0, 100.0}[static_cast<std::size_t>(i % 5)];
        const double fov =
            std::array{20.0, 60.0, 100.0, 150.0, 175.0, 179.0}[static_cast<std::size_t>(i / 5 % 6)];
        const Vec3 target(unit(random), unit(random), unit(random));
        all.push_back(camera_on(
            {unit(random) * 360, unit(random) * 180 - 90, distance * skewed_lattice.diagonal(), target},
            skewed_lattice, i % 4 == 3 ? Projection::parallel : Projection::perspective, fov));
    }
    return all;
}

// The face whose principal axis a direction has, or null where the factorisation has none.
const Face* face_of(const Factorisation& f, const Vec3& direction) {
    for (const Face& face : f.faces) {
        const double along = direction[face.axis];
        if (std::abs(along) >= std::abs(direction[face.u_axis()]) &&
            std::abs(along) >= std::abs(direction[face.v_axis()]) && along * face.sign > 0) {
            return &face;
        }
    }
    return nullptr;
}

// Every point of a slice that the picture sees has its pixel in the face, with two more to every side.
TEST(Factorise, CoversTheWholePicture) {
    const ImageSize size{64, 48};
    int seen = 0;
    for (const Camera& camera : cameras()) {
        const Factorisation f = factorise(camera, size, skewed_lattice, {1});
        ASSERT_TRUE(validate(f).has_value());
        const Rays rays = in_voxel_space(rays_of(camera, size), skewed_lattice);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) {
                const Vec3 origin = rays.origin_at(x + 0.5, y + 0.5);
                const Vec3 direction = rays.direction_at(x + 0.5, y + 0.5);
                const Vec3 across = glm::abs(direction);
                const int axis = across.x >= across.y && across.x >= across.z ? 0
                                 : across.y >= across.z                       ? 1
                                                                              : 2;
                for (std::int64_t k = 0; k < skewed_lattice.n[static_cast<std::size_t>(axis)]; k += 7) {
                    const double t = (static_cast<double>(k) - origin[axis]) / direction[axis];
                    const Vec3 p = origin + t * direction;
                    bool inside = t > 0 || f.projection == Projection::parallel;
                    for (int a = 0; a < 3; ++a) {
                        const auto last =
                            static_cast<double>(skewed_lattice.n[static_cast<std::size_t>(a)] - 1);
                        inside = inside && (a == axis || (p[a] >= 0 && p[a] <= last));
                    }
                    if (!inside) {
                        continue;
                    }
                    ++seen;
                    const Face* const face = face_of(f, direction);
                    ASSERT_NE(face, nullptr);
                    const SliceMap map = f.slice_map(*face, static_cast<double>(k));
                    const double i = (p[face->u_axis()] - map.u_offset) / map.u_scale;
                    const double j = (p[face->v_axis()] - map.v_offset) / map.v_scale;
                    ASSERT_TRUE(i > 0.9 && i < face->width - 1.9) << i << " of " << face->width;
                    ASSERT_TRUE(j > 0.9 && j < face->height - 1.9) << j << " of " << face->height;
                }
            }
        }
    }
    EXPECT_GT(seen, 100000);
}

TEST(Factorise, GivesTheResolutionAskedFor) {
    const ImageSize size{300, 200};
    const Camera camera = camera_on({0, 0}, Lattice{{50, 50, 50}});
    const Factorisation one = factorise(camera, size, Lattice{{50, 50, 50}}, {1});
    ASSERT_EQ(one.faces.size(), 1U);
    // The picture plane is parallel to the slices: a pixel is a pixel.
    EXPECT_NEAR(one.faces[0].pitch.x, 2 * std::tan(15 * M_PI / 180) / 200, 1e-9);
    const Factorisation fine = factorise(camera, size, Lattice{{50, 50, 50}}, {1.5});
    EXPECT_NEAR(fine.faces[0].pitch.y * 1.5, one.faces[0].pitch.y, 1e-9);
    EXPECT_EQ(sampling(Quality::draft), (Sampling{0.5, 0}));
    EXPECT_EQ(sampling(Quality::normal), (Sampling{1, 0, false, true}));
    EXPECT_EQ(sampling(Quality::high), (Sampling{1.5, -1}));
}

TEST(Factorise, NeverExceedsItsLimits) {
    for (const Camera& camera : cameras()) {
        for (const ImageSize& size : {ImageSize{8192, 4096}, {1, 8192}, {8192, 1}, {1, 1}}) {
            EXPECT_TRUE(validate(factorise(camera, size, skewed_lattice, {1.5})).has_value()) << size.width;
        }
    }
    const Lattice thin{{2, 100000, 2}, {1e-3, 1e-3, 1e3}};
    for (const double distance : {1e-6, 1.0, 1e9}) {
        EXPECT_TRUE(
            validate(factorise(camera_on({33, 21, distance}, thin), {512, 512}, thin, {1})).has_value());
    }
}

TEST(Factorise, LeavesOutFacesThatSeeNothing) {
    Camera away = camera_on({}, skewed_lattice);
    away.target = 2.0 * away.eye;
    EXPECT_TRUE(factorise(away, {64, 64}, skewed_lattice, {1}).faces.empty());
    const Camera inside = camera_on({30, 20, 5}, skewed_lattice, Projection::perspective, 170);
    EXPECT_GE(factorise(inside, {64, 64}, skewed_lattice, {1}).faces.size(), 5U);
    EXPECT_EQ(factorise(camera_on({}, skewed_lattice, Projection::parallel), {64, 64}, skewed_lattice, {1})
                  .faces.size(),
              1U);
}

TEST(Step, IsTheDistanceBetweenTwoSlicesAlongTheRay) {
    for (const Camera& camera : cameras()) {
        const Factorisation f = factorise(camera, {64, 64}, skewed_lattice, {1});
        for (const Face& face : f.faces) {
            const auto at = [&](double k) {
                const SliceMap map = f.slice_map(face, k);
                Vec3 p;
                p[face.axis] = k;
                p[face.u_axis()] = map.u_offset + map.u_scale * 7;
                p[face.v_axis()] = map.v_offset + map.v_scale * 3;
                return skewed_lattice.world_from_voxel(p);
            };
            EXPECT_NEAR(f.step(face, 7, 3) / glm::length(at(11) - at(10)), 1, 1e-6);
        }
    }
}

TEST(PixelsBetween, DealsOutEveryPixelOnce) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int n = 0; n < 2000; ++n) {
        const double offset = 50 * unit(random);
        const double scale = unit(random) * std::pow(10.0, 3 * unit(random) - 2);
        std::vector<double> planes{-20, -3, 0, 7, 7.5, 31};
        int covered = 0;
        for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
            const bool closed = i + 2 == planes.size();
            const PixelRange part = pixels_between(offset, scale, planes[i], planes[i + 1], closed, 200);
            for (int pixel = 0; pixel < 200; ++pixel) {
                const double u = offset + scale * pixel;
                const bool inside = planes[i] <= u && (closed ? u <= planes[i + 1] : u < planes[i + 1]);
                ASSERT_EQ(inside, part.first <= pixel && pixel < part.last);
            }
            covered += std::max(part.last - part.first, 0);
        }
        const PixelRange all = pixels_between(offset, scale, -20, 31, true, 200);
        EXPECT_EQ(covered, std::max(all.last - all.first, 0));
    }
    EXPECT_TRUE(pixels_between(5, 0, 6, 7, false, 10).empty());
}

TEST(WindowOf, HoldsEveryPixelThatReachesTheBox) {
    const Box box{{10, 5, 20}, {31, 33, 49}};
    for (const Camera& camera : cameras()) {
        const Factorisation f = factorise(camera, {64, 48}, skewed_lattice, {1});
        for (const Face& face : f.faces) {
            const Rect window = window_of(f, face, box);
            const auto w = static_cast<std::size_t>(face.axis);
            const SliceRange slices = slices_in_front(f, face, box.lo[w], box.hi[w]);
            for (std::int64_t k = slices.first; k <= slices.last; ++k) {
                const SliceMap map = f.slice_map(face, static_cast<double>(k));
                const auto range = [&](int axis, double offset, double scale, int count) {
                    const auto a = static_cast<std::size_t>(axis);
                    return pixels_between(offset, scale, static_cast<double>(box.lo[a]),
                                          static_cast<double>(box.hi[a]), true, count);
                };
                const PixelRange u = range(face.u_axis(), map.u_offset, map.u_scale, face.width);
                const PixelRange v = range(face.v_axis(), map.v_offset, map.v_scale, face.height);
                if (!u.empty() && !v.empty()) {
                    ASSERT_TRUE(window.x0 <= u.first && u.last <= window.x1);
                    ASSERT_TRUE(window.y0 <= v.first && v.last <= window.y1);
                }
            }
        }
    }
}

TEST(SlicesInFront, StopAtTheEye) {
    Factorisation f{.lattice = skewed_lattice, .eye = {10.5, 20, 1e18}};
    EXPECT_EQ(slices_in_front(f, {.axis = 0, .sign = 1}, 0, 59), (SliceRange{11, 59}));
    EXPECT_EQ(slices_in_front(f, {.axis = 0, .sign = -1}, 0, 59), (SliceRange{0, 10}));
    EXPECT_EQ(slices_in_front(f, {.axis = 1, .sign = 1}, 0, 40), (SliceRange{21, 40}));
    EXPECT_EQ(slices_in_front(f, {.axis = 1, .sign = -1}, 0, 40), (SliceRange{0, 19}));
    EXPECT_TRUE(slices_in_front(f, {.axis = 2, .sign = 1}, 0, 72).empty());
    EXPECT_EQ(slices_in_front(f, {.axis = 2, .sign = -1}, 0, 72), (SliceRange{0, 72}));
}

TEST(SlicesInFront, MayLieHalfAVoxelApart) {
    Factorisation f{.lattice = skewed_lattice, .eye = {10.5, 20.25, 1e18}, .slice_exponent = -1};
    EXPECT_EQ(slices_in_front(f, {.axis = 0, .sign = 1}, 0, 59), (SliceRange{22, 118}));
    EXPECT_EQ(slices_in_front(f, {.axis = 0, .sign = -1}, 5, 59), (SliceRange{10, 20}));
    EXPECT_EQ(slices_in_front(f, {.axis = 1, .sign = 1}, 0, 40), (SliceRange{41, 80}));
    EXPECT_EQ(slices_in_front(f, {.axis = 1, .sign = -1}, 0, 40), (SliceRange{0, 40}));
    EXPECT_EQ(f.slice_place(41), 20.5);
    const Face face{.axis = 1, .width = 1, .height = 1, .pitch = {1, 1}};
    EXPECT_EQ(f.step(face, 0, 0), 0.5 * Factorisation{.lattice = skewed_lattice}.step(face, 0, 0));
}

// By walking over all slices: the fewest voxels from pixel to pixel where a face's pixels see the cube, but
// for those that only the warp's filter asks for.
double least_voxels_per_pixel(const Factorisation& f) {
    constexpr int margin = 3;
    double least = std::numeric_limits<double>::infinity();
    for (const Face& face : f.faces) {
        const auto last = [&](int axis) { return static_cast<double>(f.lattice.n[axis] - 1); };
        const SliceRange slices = slices_in_front(f, face, 0, f.lattice.n[face.axis] - 1);
        for (std::int64_t k = slices.first; k <= slices.last; ++k) {
            const SliceMap map = f.slice_map(face, static_cast<double>(k));
            const PixelRange u =
                pixels_between(map.u_offset, map.u_scale, 0, last(face.u_axis()), true, face.width);
            const PixelRange v =
                pixels_between(map.v_offset, map.v_scale, 0, last(face.v_axis()), true, face.height);
            if (std::max(u.first, margin) < std::min(u.last, face.width - margin) &&
                std::max(v.first, margin) < std::min(v.last, face.height - margin)) {
                least = std::min({least, std::abs(map.u_scale), std::abs(map.v_scale)});
            }
        }
    }
    return least;
}

TEST(Factorise, ChoosesTheLevelWhoseVoxelsAreNearestToAPixel) {
    const Lattice large{{1000, 300, 1600}, {1, 1.3, 0.7}};
    std::array<int, volume::max_level + 1> chosen{};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 300; ++i) {
        const double distance = 0.3 * std::pow(40, unit(random)) * large.diagonal();
        const Camera camera = camera_on({unit(random) * 360, unit(random) * 180 - 90, distance}, large,
                                        i % 3 == 0 ? Projection::parallel : Projection::perspective, 40,
                                        large.diagonal() * 2 * unit(random));
        const Factorisation f = factorise(camera, {160, 120}, large, {.level_of_detail = true});
        ASSERT_TRUE(validate(f).has_value());
        Factorisation exact = f;
        exact.slice_exponent = 0;
        EXPECT_EQ(exact, factorise(camera, {160, 120}, large, {}));
        const double least = least_voxels_per_pixel(exact);
        if (f.faces.empty() || std::isinf(least)) {
            continue;
        }
        EXPECT_LE(f.level() == 0 ? 0 : f.slice_pitch(), std::sqrt(2) * least) << i;
        EXPECT_TRUE(f.level() == volume::max_level || f.slice_pitch() > 0.97 * least / std::sqrt(2))
            << i << ": " << least;
        ++chosen.at(static_cast<std::size_t>(f.level()));
    }
    for (const int times : chosen) {
        EXPECT_GT(times, 3);
    }
}

TEST(Factorise, KeepsToTheLevelsThatTheCubeHas) {
    const Lattice small{{64, 20, 33}};
    const Camera far = camera_on({30, 20, 1e5}, small);
    EXPECT_EQ(factorise(far, {64, 64}, small, {.level_of_detail = true}).slice_exponent, 1);
    EXPECT_EQ(factorise(far, {64, 64}, small, {.slice_exponent = -1}).slice_exponent, -1);
    const Camera near = camera_on({30, 20, 20}, small);
    EXPECT_EQ(
        factorise(near, {64, 64}, small, {.slice_exponent = -1, .level_of_detail = true}).slice_exponent, -1);
    EXPECT_EQ(factorise(near, {64, 64}, small, {.level_of_detail = true}).slice_exponent, 0);
    EXPECT_TRUE(sampling(Quality::draft, true).level_of_detail);
    EXPECT_FALSE(sampling(Quality::high, false).level_of_detail);
    EXPECT_EQ(sampling(Quality::high).classify, Classify::post);
    for (const Classify classify : {Classify::post, Classify::pre_integrated}) {
        EXPECT_EQ(factorise(near, {64, 64}, small, sampling(Quality::draft, true, classify)).classify,
                  classify);
    }
}

TEST(Factorise, TakesTwoSlicesAVoxelWhereVoxelsSpanMoreThanAPixel) {
    const Lattice cube{{64, 64, 64}};
    const auto exponent = [&](double height, Quality quality) {
        const Camera camera = camera_on({0, 0}, cube, Projection::parallel, 30, height);
        return factorise(camera, {100, 100}, cube, sampling(quality, true)).slice_exponent;
    };
    // 0.81 and 0.79 voxels a pixel of the picture.
    EXPECT_EQ(exponent(81, Quality::normal), 0);
    EXPECT_EQ(exponent(79, Quality::normal), -1);
    EXPECT_GE(exponent(79, Quality::draft), 0);
    EXPECT_EQ(exponent(81, Quality::high), -1);
    // The nearest corner alone counts for little.
    for (const double azimuth : {10.0, 46.0, 82.0, 118.0}) {
        const Camera whole = camera_on({azimuth, 20, 2.4 * 64}, cube);
        EXPECT_EQ(factorise(whole, {64, 64}, cube, sampling(Quality::normal)).slice_exponent, 0) << azimuth;
    }
    const Camera within = camera_on({0, 0, 3}, cube);
    EXPECT_EQ(factorise(within, {100, 100}, cube, sampling(Quality::normal)).slice_exponent, -1);
}

// What lies beside a box is not kept of coarser ones.
TEST(Factorise, PreIntegratesOnTheFinerLevels) {
    const Lattice large{{2048, 2048, 2048}};
    const auto far = [&](Classify classify) {
        return factorise(camera_on({30, 20, 1e5}, large), {64, 64}, large,
                         {.level_of_detail = true, .classify = classify});
    };
    EXPECT_EQ(far(Classify::post).level(), volume::max_level);
    Factorisation f = far(Classify::pre_integrated);
    EXPECT_EQ(f.level(), volume::max_margin_level);
    EXPECT_TRUE(validate(f).has_value());
    ++f.slice_exponent;
    EXPECT_TRUE(validate(f).has_error());
}

TEST(ValidateFactorisation, RefusesWhatAPeerMayMakeUp) {
    const Factorisation good = factorise(camera_on({}, skewed_lattice), {64, 64}, skewed_lattice, {1});
    const auto fails = [&](const auto& spoil) {
        Factorisation bad = good;
        spoil(bad);
        return validate(bad).has_error();
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(fails([](Factorisation&) {}));
    EXPECT_TRUE(fails([](Factorisation& f) { f.lattice.n[1] = 1; }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.lattice.n = {1LL << 40, 1LL << 40, 2}; }));
    EXPECT_TRUE(fails([&](Factorisation& f) { f.lattice.spacing.x = nan; }));
    EXPECT_TRUE(fails([&](Factorisation& f) { f.eye.z = nan; }));
    EXPECT_FALSE(fails([](Factorisation& f) { f.slice_exponent = 1; }));
    for (const int exponent : {-2, 2, 6, 1000}) {  // the skewed_lattice has one level but its voxels
        EXPECT_TRUE(fails([&](Factorisation& f) { f.slice_exponent = exponent; })) << exponent;
    }
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces.resize(7, f.faces[0]); }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces[0].axis = 3; }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces[0].sign = 0; }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces[0].width = 16385; }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces[0].height = 0; }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces[0].pitch.x = 0; }));
    EXPECT_TRUE(fails([&](Factorisation& f) { f.faces[0].origin.y = nan; }));
    EXPECT_TRUE(fails([](Factorisation& f) { f.faces[0].width = f.faces[0].height = 16384; }));
    EXPECT_TRUE(fails([](Factorisation& f) {
        f.projection = Projection::parallel;
        f.direction = {0, 0, 0};
    }));
}

TEST(Rects, MeetAndJoin) {
    const Rect a{0, 0, 10, 5};
    EXPECT_EQ(intersection(a, {5, 2, 20, 3}), (Rect{5, 2, 10, 3}));
    EXPECT_TRUE(intersection(a, {10, 0, 20, 5}).empty());
    EXPECT_EQ(bounding(a, {12, -3, 13, 1}), (Rect{0, -3, 13, 5}));
    EXPECT_EQ(bounding(a, {50, 50, 50, 60}), a);
    EXPECT_EQ(bounding({}, a), a);
    EXPECT_EQ((Rect{0, 0, 100000, 100000}).area(), 10000000000);
}

// Cuts a box at random, again and again.
void cut(std::mt19937& random, const Box& box, int levels, std::vector<Box>& leaves) {
    const auto axis = static_cast<std::size_t>(random() % 3);
    if (levels == 0 || box.cells(static_cast<int>(axis)) < 2) {
        leaves.push_back(box);
        return;
    }
    const auto at =
        box.lo[axis] + 1 +
        static_cast<std::int64_t>(random() % static_cast<unsigned>(box.cells(static_cast<int>(axis)) - 1));
    Box low = box, high = box;
    low.hi[axis] = high.lo[axis] = at;
    cut(random, low, levels - 1, leaves);
    cut(random, high, levels - 1, leaves);
}

// Along random rays, the boxes met come in the order given.
TEST(VisibilityOrder, IsFrontToBackAlongEveryRay) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 1);
    int pairs = 0;
    for (const Camera& camera : cameras()) {
        Factorisation f = factorise(camera, {32, 32}, skewed_lattice, {1});
        std::vector<Box> boxes;
        cut(random, volume::whole(skewed_lattice.n), 5, boxes);
        std::shuffle(boxes.begin(), boxes.end(), random);
        const std::vector<int> order = visibility_order(f, boxes);
        ASSERT_EQ(order.size(), boxes.size());
        std::vector<int> rank(boxes.size(), -1);
        for (std::size_t i = 0; i < order.size(); ++i) {
            rank[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
        }
        for (int n = 0; n < 200; ++n) {
            const Vec3 through(59 * unit(random), 40 * unit(random), 72 * unit(random));
            const bool perspective = f.projection == Projection::perspective;
            const Vec3 direction = perspective ? through - f.eye : f.direction;
            const Vec3 origin = perspective ? f.eye : through - 1000.0 * direction;
            std::vector<std::pair<double, int>> met;
            for (std::size_t b = 0; b < boxes.size(); ++b) {
                double t0 = 0, t1 = 1e300;
                for (int a = 0; a < 3; ++a) {
                    const double p =
                        (static_cast<double>(boxes[b].lo[static_cast<std::size_t>(a)]) - origin[a]) /
                        direction[a];
                    const double q =
                        (static_cast<double>(boxes[b].hi[static_cast<std::size_t>(a)]) - origin[a]) /
                        direction[a];
                    t0 = std::max(t0, std::min(p, q));
                    t1 = std::min(t1, std::max(p, q));
                }
                if (t1 - t0 > 1e-6 * (1 + t1)) {
                    met.emplace_back(0.5 * (t0 + t1), static_cast<int>(b));
                }
            }
            std::sort(met.begin(), met.end());
            for (std::size_t i = 0; i + 1 < met.size(); ++i) {
                ASSERT_LT(rank[static_cast<std::size_t>(met[i].second)],
                          rank[static_cast<std::size_t>(met[i + 1].second)]);
                ++pairs;
            }
        }
    }
    EXPECT_GT(pairs, 10000);
}

// Three beams in a ring hide one another: no order is right, but one is given.
TEST(VisibilityOrder, EndsForARingOfBoxes) {
    const Factorisation f{
        .projection = Projection::parallel, .lattice = skewed_lattice, .direction = {1, 1, 1}};
    const std::vector<Box> ring{
        {{0, 0, 10}, {30, 10, 20}}, {{10, 0, 0}, {20, 30, 10}}, {{0, 10, 0}, {10, 20, 30}}};
    EXPECT_EQ(visibility_order(f, ring).size(), 3U);
    EXPECT_EQ(visibility_order(f, {ring[0], ring[0]}).size(), 2U);
    EXPECT_TRUE(visibility_order(f, {}).empty());
}

// Of a rectangle every pixel is in another or in just one of what that leaves over.
TEST(Rects, LeaveOverWhatIsNotInBoth) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> at(-2, 7);
    for (int trial = 0; trial < 500; ++trial) {
        const Rect whole{at(random), at(random), at(random), at(random)};
        const Rect part{at(random), at(random), at(random), at(random)};
        const auto contains = [](const Rect& rect, int x, int y) {
            return rect.x0 <= x && x < rect.x1 && rect.y0 <= y && y < rect.y1;
        };
        const auto left = left_over(whole, part);
        for (int y = -2; y < 8; ++y) {
            for (int x = -2; x < 8; ++x) {
                const auto in = std::ranges::count_if(left, [&](const Rect& r) { return contains(r, x, y); });
                EXPECT_EQ(in, contains(whole, x, y) && !contains(part, x, y) ? 1 : 0)
                    << trial << ": " << x << ", " << y;
            }
        }
    }
}

}  // namespace
}  // namespace shearwater::view
