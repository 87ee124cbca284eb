#include "client/model/crop.h"

#include <gtest/gtest.h>

#include "common/view/project.h"

namespace shearwater::model {
namespace {

using volume::Box;

const view::Lattice cut_lattice{{20, 30, 40}, {1, 2, 0.5}};
const view::ImageSize size{300, 200};

TEST(Crop, IsTheWholeCubeUnlessSet) {
    EXPECT_EQ(shown_box({}, cut_lattice), volume::whole(cut_lattice.n));
    const Box box{{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(shown_box(box, cut_lattice), box);
    EXPECT_EQ(shown_box(Box{{1, 2, 3}, {4, 5, 40}}, cut_lattice),
              volume::whole(cut_lattice.n));  // another cube's
}

TEST(Crop, FacesStayInsideTheCubeAndApart) {
    Crop crop;
    move_face(crop, cut_lattice, {0, false}, 7);
    EXPECT_EQ(crop, (Box{{7, 0, 0}, {19, 29, 39}}));
    move_face(crop, cut_lattice, {0, true}, 3);
    EXPECT_EQ(crop, (Box{{7, 0, 0}, {8, 29, 39}}));
    move_face(crop, cut_lattice, {0, false}, 100);
    EXPECT_EQ(crop, (Box{{7, 0, 0}, {8, 29, 39}}));
    move_face(crop, cut_lattice, {2, true}, 1000);
    move_face(crop, cut_lattice, {2, false}, -5);
    move_face(crop, cut_lattice, {1, true}, 10);
    EXPECT_EQ(crop, (Box{{7, 0, 0}, {8, 10, 39}}));
    move_face(crop, cut_lattice, {0, false}, 0);
    move_face(crop, cut_lattice, {0, true}, 19);
    move_face(crop, cut_lattice, {1, true}, 29);
    EXPECT_FALSE(crop) << "all of it is no crop";
}

// A face follows the mouse along its axis, and not across it.
TEST(Crop, FacesAreDraggedAlongTheirAxes) {
    const Box box{{2, 5, 4}, {15, 20, 33}};
    for (const view::Projection projection : {view::Projection::perspective, view::Projection::parallel}) {
        const view::Camera camera = view::camera_on({35, 25, 0, {}}, cut_lattice, projection);
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool upper : {false, true}) {
                const BoxFace face{axis, upper};
                const view::Vec3 middle = middle_of(box, cut_lattice, face);
                view::Vec3 farther = middle;
                farther[axis] += 0.25 * cut_lattice.spacing[axis];
                const view::Vec2 along =
                    view::project(camera, size, farther).at - view::project(camera, size, middle).at;
                EXPECT_NEAR(planes_dragged(box, cut_lattice, face, camera, size, along), 0.25, 0.01);
                EXPECT_NEAR(planes_dragged(box, cut_lattice, face, camera, size, {-along.y, along.x}), 0,
                            0.01);
            }
        }
        // Seen end on, or not at all.
        const view::Camera front = view::camera_on({0, 0, 500, {}}, cut_lattice, view::Projection::parallel);
        EXPECT_EQ(planes_dragged(box, cut_lattice, {2, true}, front, size, {50, 50}), 0);
    }
    const view::Camera beside = view::camera_on({0, 0, 3, {}}, cut_lattice);
    EXPECT_EQ(planes_dragged(box, cut_lattice, {2, true}, beside, size, {50, 50}), 0) << "behind the eye";
}

TEST(Crop, FacesHaveTheirMiddles) {
    const Box box{{0, 10, 4}, {19, 20, 33}};
    const view::Vec3 at = middle_of(box, cut_lattice, {1, true});
    EXPECT_EQ(at, cut_lattice.world_from_voxel({9.5, 20, 18.5}));
    EXPECT_EQ(middle_of(box, cut_lattice, {1, false}), cut_lattice.world_from_voxel({9.5, 10, 18.5}));
}

}  // namespace
}  // namespace shearwater::model
