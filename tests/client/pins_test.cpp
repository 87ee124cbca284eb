#include "client/model/pins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace shearwater::model {
namespace {

using view::Blank;
using view::Flat;
using view::Hat;
using view::OpacityPin;
using view::Ramp;

bool valid(const OpacityPin& pin) {
    view::TransferFunction tf = view::default_transfer_function();
    tf.opacity_pins = {pin};
    return view::validate(tf).has_value();
}

std::size_t handle(const OpacityPin& pin, std::string_view wanted) {
    const auto handles = handles_of(pin);
    for (std::size_t i = 0; i < handles.size(); ++i) {
        if (handles[i].name == wanted) {
            return i;
        }
    }
    ADD_FAILURE() << "no handle " << wanted;
    return 0;
}

const OpacityPin all[] = {Ramp{0.2, 0.1, 0.6, 0.5}, Hat{0.5, 0.1, 0.3, 0.4}, Hat{0.5, 0.1, 0.3, 0.4, 0.05},
                          Hat{0.5, 0.2, 0.2, 0.4},  Hat{0.5, 0, 0.2, 0.4},   Flat{0.3},
                          Blank{0.4, 0.45}};

TEST(Pins, NewOnesAreOfTheirShapeWhereTheyWereAskedFor) {
    for (const Shape shape : shapes) {
        for (const double s : {0.0, 0.3, 0.5, 1.0}) {
            const OpacityPin pin = new_pin(shape, s, 0.25);
            EXPECT_TRUE(valid(pin)) << name(shape);
            EXPECT_EQ(shape_of(pin), shape);
            const auto edges = edges_of(pin);
            for (const double edge : edges) {
                EXPECT_GE(edge, -1e-12);
                EXPECT_LE(edge, 1 + 1e-12);
            }
            if (!edges.empty()) {
                EXPECT_LE(edges.front(), s + 1e-12);
                EXPECT_GE(edges.back(), s - 1e-12);
            }
        }
        if (shape != Shape::blank) {
            EXPECT_NEAR(height_at(new_pin(shape, 0.5, 0.25), shape == Shape::ramp ? 0.99 : 0.5), 0.25, 1e-12);
        }
    }
}

TEST(Pins, RetypedTheyKeepTheirExtentAndHeight) {
    for (const OpacityPin& pin : all) {
        for (const Shape shape : shapes) {
            const OpacityPin other = retyped(pin, shape);
            EXPECT_TRUE(valid(other));
            EXPECT_EQ(shape_of(other), shape);
            const auto before = edges_of(pin), after = edges_of(other);
            if (!before.empty() && !after.empty()) {
                EXPECT_NEAR(after.front(), before.front(), 1e-12) << name(shape);
                EXPECT_NEAR(after.back(), before.back(), 1e-12) << name(shape);
            }
        }
        EXPECT_EQ(retyped(pin, shape_of(pin)), pin);
    }
    EXPECT_EQ(std::get<Hat>(retyped(Ramp{0.2, 0.1, 0.6, 0.5}, Shape::triangle)).height, 0.5);
    EXPECT_EQ(std::get<Flat>(retyped(Hat{0.5, 0.1, 0.3, 0.4}, Shape::flat)).height, 0.4);
}

TEST(Pins, HandlesAreWhereTheyAreDragged) {
    for (const OpacityPin& pin : all) {
        const auto handles = handles_of(pin);
        for (std::size_t i = 0; i < handles.size(); ++i) {
            const bool along = handles[i].name != "height";
            const double out = handles[i].name.ends_with("-low") ? -0.01 : 0.01;
            const double s = along ? handles[i].s + out : handles[i].s;
            const OpacityPin moved = dragged(pin, i, s, 0.123);
            EXPECT_TRUE(valid(moved)) << handles[i].name;
            const Handle now = handles_of(moved)[i];
            EXPECT_NEAR(now.s, s, 1e-12) << handles[i].name;
            const bool upwards = handles[i].name == "low" || handles[i].name == "high" ||
                                 handles[i].name == "top" || handles[i].name == "height";
            EXPECT_NEAR(now.height.value_or(-1), upwards ? 0.123 : handles[i].height.value_or(-1), 1e-12);
        }
    }
}

TEST(Pins, EachHandleMovesWhatItIsFor) {
    const Hat hat{0.5, 0.1, 0.3, 0.4};
    const auto drag = [&](std::string_view which, double s, double a) {
        return std::get<Hat>(dragged(hat, handle(hat, which), s, a));
    };
    EXPECT_EQ(drag("top", 0.6, 0.7), (Hat{0.6, 0.1, 0.3, 0.7}));
    EXPECT_NEAR(drag("top-high", 0.6, 0.9).top, 0.2, 1e-12);
    EXPECT_EQ(drag("top-high", 0.6, 0.9).base, 0.3);
    EXPECT_NEAR(drag("top-low", 0.2, 0.9).base, 0.6, 1e-12) << "the base gives way";
    EXPECT_NEAR(drag("base-low", 0.3, 0.9).base, 0.4, 1e-12);
    EXPECT_EQ(drag("base-low", 0.3, 0.9).height, 0.4);
    EXPECT_NEAR(drag("base-high", 0.52, 0).top, 0.04, 1e-12) << "the top gives way";
    EXPECT_EQ(shape_of(drag("top-high", 0.65, 0.4)), Shape::top_hat);
    EXPECT_EQ(shape_of(drag("top-high", 0.5, 0.4)), Shape::triangle);

    const Ramp ramp{0.2, 0.1, 0.6, 0.5};
    EXPECT_EQ(std::get<Ramp>(dragged(ramp, 0, 0.3, 0.2)), (Ramp{0.3, 0.2, 0.6, 0.5}));
    EXPECT_LT(std::get<Ramp>(dragged(ramp, 0, 0.9, 0.2)).x0, 0.6) << "it does not pass the other";
    EXPECT_EQ(std::get<Blank>(dragged(Blank{0.4, 0.5}, 1, 0.1, 0)), (Blank{0.4, 0.4}));
    EXPECT_EQ(std::get<Flat>(dragged(Flat{0.1}, 0, 0.1, 2)), Flat{1});
}

TEST(Pins, AreShiftedAsAWhole) {
    for (const OpacityPin& pin : all) {
        const auto before = edges_of(pin), after = edges_of(shifted(pin, -0.07));
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t i = 0; i < before.size(); ++i) {
            EXPECT_NEAR(after[i], before[i] - 0.07, 1e-12);
        }
    }
}

TEST(Pins, NumbersAreTypedOneByOne) {
    for (const OpacityPin& pin : all) {
        const auto fields = fields_of(pin);
        for (std::size_t i = 0; i < fields.size(); ++i) {
            EXPECT_NEAR(field(with_field(pin, i, field(pin, i)), i), field(pin, i), 1e-12);
            const double wanted = field(pin, i) + 0.003;
            const OpacityPin changed = with_field(pin, i, wanted);
            EXPECT_TRUE(valid(changed));
            EXPECT_NEAR(field(changed, i), wanted, 1e-12) << fields[i].name;
            for (std::size_t j = 0; j < fields.size(); ++j) {
                const bool may_give_way = shape_of(pin) == Shape::top_hat || shape_of(pin) == Shape::triangle;
                if (j != i && !may_give_way) {
                    EXPECT_NEAR(field(changed, j), field(pin, j), 1e-12) << fields[i].name << fields[j].name;
                }
            }
        }
    }
    // A hat's feet and shoulders stay in order.
    const Hat pushed = std::get<Hat>(with_field(Hat{0.5, 0.1, 0.3, 0.4}, 0, 0.58));
    EXPECT_NEAR(field(pushed, 1), 0.58, 1e-12);
    EXPECT_NEAR(field(pushed, 2), 0.58, 1e-12);
    EXPECT_NEAR(field(pushed, 3), 0.65, 1e-12);
}

TEST(Pins, WhateverIsDoneToThemTheyStayValid) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> share(-0.5, 1.5);
    const double hostile[] = {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -1e300,
                              1e300,
                              -1e6,
                              0};
    for (OpacityPin pin : all) {
        for (int i = 0; i < 3000; ++i) {
            const bool is_hostile = random() % 8 == 0;
            const double s = is_hostile ? hostile[random() % 6] : share(random);
            const double a = is_hostile ? hostile[random() % 6] : share(random);
            switch (random() % 4) {
                case 0:
                    pin = dragged(pin, random() % handles_of(pin).size(), s, a);
                    break;
                case 1:
                    pin = shifted(pin, s - 0.5);
                    break;
                case 2:
                    pin = with_field(pin, random() % fields_of(pin).size(), s);
                    break;
                default:
                    pin = retyped(pin, shapes[random() % shapes.size()]);
            }
            ASSERT_TRUE(valid(pin)) << i;
        }
    }
}

}  // namespace
}  // namespace shearwater::model
