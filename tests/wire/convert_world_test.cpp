#include "protocol/wire/convert_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "protocol/wire/message.h"
#include "tests/wire/examples.h"

namespace shearwater::wire {
namespace {

wcs::Axes from(const wcs::Axes& axes) {
    pb::CubeDescription description;
    put(axes, *description.mutable_axes());
    return axes_from(description.axes()).value();
}

TEST(WorldConversion, ThereAndBack) {
    EXPECT_EQ(from(test::world_axes()), test::world_axes());
    EXPECT_EQ(from({}), wcs::Axes{});
    wcs::Axes one;
    one[2] = test::world_axes()[2];
    EXPECT_EQ(from(one), one);
    pb::CubeDescription description;
    put({}, *description.mutable_axes());
    EXPECT_EQ(description.ByteSizeLong(), 0U) << "of nothing, nothing is said";
}

TEST(WorldConversion, WhereThereIsNoValueThereIsNone) {
    wcs::Axes axes = test::world_axes();
    axes[2].values[0] = std::numeric_limits<double>::quiet_NaN();
    const wcs::Axes back = from(axes);
    EXPECT_TRUE(std::isnan(back[2].values[0]));
    EXPECT_EQ(back[2].values[1], axes[2].values[1]);
}

TEST(WorldConversion, TheLargestKeepsItsLimit) {
    wcs::Axes axes = test::world_axes();
    for (wcs::Axis& axis : axes) {
        axis.nodes = {33, 1, 33};
        axis.values.assign(wcs::Axis::max_values, 1.5);
    }
    axes[1].nodes = {1, 33, 33};
    pb::CubeDescription description;
    put(axes, *description.mutable_axes());
    EXPECT_EQ(axes_from(description.axes()).value(), axes);
    EXPECT_LT(description.ByteSizeLong(), limit_of(type_of(message(description).body))->body / 8);
}

TEST(WorldConversion, Hostile) {
    const auto refused = [](const char* what, const auto& change) {
        pb::CubeDescription description;
        put(test::world_axes(), *description.mutable_axes());
        change(description);
        const auto axes = axes_from(description.axes());
        ASSERT_FALSE(axes) << what;
        EXPECT_EQ(axes.error().reason, pb::REASON_INVALID);
        EXPECT_EQ(axes.error().text.find("axes: "), 0U) << axes.error().text;
    };
    refused("two", [](auto& d) { d.mutable_axes()->RemoveLast(); });
    refused("four", [](auto& d) { d.add_axes(); });
    refused("nodes missing", [](auto& d) { d.mutable_axes(0)->mutable_nodes()->RemoveLast(); });
    refused("a fourth number of nodes", [](auto& d) { d.mutable_axes(0)->add_nodes(1); });
    refused("no nodes", [](auto& d) { d.mutable_axes(0)->set_nodes(1, 0); });
    refused("many nodes", [](auto& d) { d.mutable_axes(0)->set_nodes(1, 34); });
    refused("any number of nodes", [](auto& d) { d.mutable_axes(0)->set_nodes(1, ~0U); });
    refused("a product that overflows", [](auto& d) {
        for (int a = 0; a < 3; ++a) {
            d.mutable_axes(0)->set_nodes(a, 1U << 22);
        }
    });
    refused("a value more", [](auto& d) { d.mutable_axes(0)->add_values(1); });
    refused("a value less", [](auto& d) { d.mutable_axes(0)->mutable_values()->RemoveLast(); });
    refused("many values", [](auto& d) { d.mutable_axes(2)->mutable_values()->Resize(1 << 20, 1); });
    refused("nothing along itself", [](auto& d) { d.mutable_axes()->SwapElements(0, 2); });
    refused("infinite", [](auto& d) { d.mutable_axes(2)->set_values(0, HUGE_VAL); });
    refused("large", [](auto& d) { d.mutable_axes(2)->set_values(0, -1e200); });
    refused("no angle", [](auto& d) { d.mutable_axes(0)->set_values(0, 1e6); });
    refused("nameless", [](auto& d) { d.mutable_axes(1)->clear_name(); });
    refused("without a label", [](auto& d) { d.mutable_axes(1)->clear_label(); });
    refused("notation", [](auto& d) { d.mutable_axes(1)->set_notation(static_cast<pb::Notation>(3)); });
}

TEST(WorldConversion, WhatIsNotPrintableIsNotTaken) {
    pb::CubeDescription description;
    put(test::world_axes(), *description.mutable_axes());
    description.mutable_axes(2)->set_name(std::string(5000, 'a') + "\x1b[31m");
    description.mutable_axes(2)->set_unit("\xff\x07%n");
    const wcs::Axes axes = axes_from(description.axes()).value();
    EXPECT_LT(axes[2].name.size(), 60U);
    EXPECT_EQ(axes[2].unit.find_first_of("\xff\x07"), std::string::npos);
}

}  // namespace
}  // namespace shearwater::wire
