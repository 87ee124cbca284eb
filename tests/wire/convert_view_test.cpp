#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_finite = std::numeric_limits<double>::quiet_NaN();

template <class T>
void expect_invalid(const Parsed<T>& parsed, std::string_view what) {
    ASSERT_FALSE(parsed) << what;
    EXPECT_EQ(parsed.error().reason, pb::REASON_INVALID) << what;
    EXPECT_FALSE(parsed.error().text.empty()) << what;
}

// A good message with one thing changed must be refused.
template <class M, class From, class Change>
void expect_refused(const M& good, From from, std::string_view what, Change change) {
    M bad = good;
    change(bad);
    expect_invalid(from(bad), what);
}

TEST(ViewConversion, ThereAndBack) {
    View view = view_request();
    for (const view::Quality quality : {view::Quality::draft, view::Quality::normal, view::Quality::high}) {
        view.quality = quality;
        for (const view::Projection projection :
             {view::Projection::perspective, view::Projection::parallel}) {
            view.camera.projection = projection;
            const View back = view_from(to_wire(view)).value();
            EXPECT_EQ(back.revision, view.revision);
            EXPECT_EQ(back.camera, view.camera);
            EXPECT_EQ(back.size, view.size);
            EXPECT_EQ(back.tf, view.tf);
            EXPECT_EQ(back.quality, view.quality);
            EXPECT_EQ(back.deflate, view.deflate);
            EXPECT_EQ(back.level_of_detail, view.level_of_detail);
            EXPECT_EQ(back.sketch, view.sketch);
            EXPECT_EQ(back.classify, view.classify);
            view.level_of_detail = !view.level_of_detail.value_or(false);
            view.sketch = !view.sketch;
            view.classify = view.sketch ? view::Classify::post : view::Classify::pre_integrated;
        }
    }
}

TEST(ViewConversion, LimitsThereAndBack) {
    View view = view_request();
    EXPECT_FALSE(view_from(to_wire(view)).value().scaling);
    for (const auto stretch :
         {volume::Stretch::linear, volume::Stretch::sqrt, volume::Stretch::log, volume::Stretch::asinh}) {
        view.scaling = volume::Scaling{-3.5, 1e30, stretch};
        EXPECT_EQ(view_from(to_wire(view)).value().scaling, view.scaling);
    }
    pb::SetView bad = to_wire(view);
    bad.mutable_scaling()->set_stretch(static_cast<pb::Stretch>(4));
    EXPECT_THAT(view_from(bad).error().text, testing::StartsWith("view.scaling"));
    for (const auto& [lo, hi] : {std::pair{2.0, 1.0}, {not_finite, 1.0}, {0.0, inf}, {-1.7e308, 1.7e308}}) {
        bad = to_wire(view);
        bad.mutable_scaling()->set_lo(lo);
        bad.mutable_scaling()->set_hi(hi);
        EXPECT_THAT(view_from(bad).error().text, testing::StartsWith("view.scaling"));
    }
}

TEST(ViewConversion, PairsAndCropsThereAndBack) {
    View view = view_request();
    const View plain = view_from(to_wire(view)).value();
    EXPECT_FALSE(plain.stereo);
    EXPECT_FALSE(plain.crop);
    EXPECT_EQ(cameras_of(plain), std::vector{view.camera});
    view.camera.slant = {0.25, -0.5};
    view.crop = volume::Box{{1, 2, 3}, {40, 50, 60}};
    for (const view::StereoSettings& stereo :
         {view::StereoSettings{}, view::StereoSettings{0.5, 4, true}, view::StereoSettings{0, 2, false}}) {
        view.stereo = stereo;
        const View back = view_from(to_wire(view)).value();
        EXPECT_EQ(back.camera, view.camera);
        EXPECT_EQ(back.stereo, view.stereo);
        EXPECT_EQ(back.crop, view.crop);
        const auto eyes = view::eyes_of(view.camera, stereo);
        EXPECT_EQ(cameras_of(back), std::vector(eyes.begin(), eyes.end()));
    }
}

TEST(ViewConversion, HostilePairsAndCrops) {
    const auto refused = [](std::string_view what, auto change) {
        View view = view_request();
        view.stereo = view::StereoSettings{1, 2, false};
        view.crop = volume::Box{{1, 2, 3}, {40, 50, 60}};
        expect_refused(to_wire(view), view_from, what, change);
    };
    for (const double value : {not_finite, inf, -inf, -1.0}) {
        refused("separation", [&](pb::SetView& v) { v.mutable_stereo()->set_separation(value); });
        refused("convergence", [&](pb::SetView& v) { v.mutable_stereo()->set_convergence(value); });
    }
    for (const double value : {not_finite, inf, -inf, 11.0}) {
        refused("slant x", [&](pb::SetView& v) { v.mutable_camera()->set_slant_x(value); });
        refused("slant y", [&](pb::SetView& v) { v.mutable_camera()->set_slant_y(value); });
    }
    refused("eyes too far apart", [](pb::SetView& v) { v.mutable_stereo()->set_convergence(1e-9); });
    refused("area of both", [](pb::SetView& v) {  // one alone is allowed
        v.set_width(8192);
        v.set_height(4096);
    });
    refused("crop below 0", [](pb::SetView& v) { v.mutable_crop()->mutable_lo()->set_x(-1); });
    refused("crop upside down", [](pb::SetView& v) { v.mutable_crop()->mutable_lo()->set_y(51); });
    refused("crop too large",
            [](pb::SetView& v) { v.mutable_crop()->mutable_hi()->set_z(std::int64_t{1} << 41); });
}

TEST(ViewConversion, HostileCameras) {
    const auto refused = [](std::string_view what, auto change) {
        View view = view_request();
        view.camera.projection = view::Projection::perspective;
        expect_refused(to_wire(view), view_from, what, change);
    };
    for (const double value : {not_finite, inf, -inf}) {
        refused("eye", [&](pb::SetView& v) { v.mutable_camera()->mutable_eye()->set_y(value); });
        refused("target", [&](pb::SetView& v) { v.mutable_camera()->mutable_target()->set_x(value); });
        refused("up", [&](pb::SetView& v) { v.mutable_camera()->mutable_up()->set_z(value); });
        refused("fov", [&](pb::SetView& v) { v.mutable_camera()->set_fov(value); });
        refused("height", [&](pb::SetView& v) { v.mutable_camera()->set_height(value); });
        refused("parallel height", [&](pb::SetView& v) {
            v.mutable_camera()->set_projection(pb::PARALLEL);
            v.mutable_camera()->set_height(value);
        });
    }
    for (const double fov : {0.0, -30.0, 180.0, 1e9}) {
        refused("fov", [&](pb::SetView& v) { v.mutable_camera()->set_fov(fov); });
    }
    refused("eye on target",
            [](pb::SetView& v) { *v.mutable_camera()->mutable_eye() = v.camera().target(); });
    refused("no camera", [](pb::SetView& v) { v.clear_camera(); });
    refused("no up", [](pb::SetView& v) { v.mutable_camera()->clear_up(); });
    refused("projection",
            [](pb::SetView& v) { v.mutable_camera()->set_projection(static_cast<pb::Projection>(2)); });
}

TEST(ViewConversion, HostileSizesAndChoices) {
    const auto refused = [](std::string_view what, auto change) {
        expect_refused(to_wire(view_request()), view_from, what, change);
    };
    for (const std::uint32_t side : {0U, 8193U, 1U << 16, 1U << 31, 0xFFFFFFFFU}) {
        refused("width", [&](pb::SetView& v) { v.set_width(side); });
        refused("height", [&](pb::SetView& v) { v.set_height(side); });
    }
    refused("area", [](pb::SetView& v) {  // each side is allowed, both together are not
        v.set_width(8192);
        v.set_height(8192);
    });
    for (const int quality : {3, -1, 99}) {
        refused("quality", [&](pb::SetView& v) { v.set_quality(static_cast<pb::Quality>(quality)); });
    }
    for (const int classification : {2, -1, 1 << 30}) {
        refused("classification", [&](pb::SetView& v) {
            v.set_classification(static_cast<pb::Classification>(classification));
        });
    }
    refused("transfer function", [](pb::SetView& v) { v.clear_transfer_function(); });
}

TEST(TransferFunctionConversion, ThereAndBack) {
    EXPECT_EQ(transfer_function_from(to_wire(transfer_function())).value(), transfer_function());
    EXPECT_EQ(transfer_function_from(to_wire(view::default_transfer_function())).value(),
              view::default_transfer_function());
    view::TransferFunction more = transfer_function();
    more.density = 2.5;
    std::get<view::Hat>(more.opacity_pins[1]).lean = -0.03;
    EXPECT_EQ(transfer_function_from(to_wire(more)).value(), more);
    EXPECT_FALSE(to_wire(transfer_function()).has_density()) << "as before where there is none";
}

TEST(TransferFunctionConversion, Hostile) {
    const auto refused = [](std::string_view what, auto change) {
        expect_refused(to_wire(transfer_function()), transfer_function_from, what, change);
    };
    for (const double value : {not_finite, inf, -inf}) {
        refused("ramp x0", [&](auto& t) { t.mutable_opacity_pins(0)->mutable_ramp()->set_x0(value); });
        refused("ramp x1", [&](auto& t) { t.mutable_opacity_pins(0)->mutable_ramp()->set_x1(value); });
        refused("ramp a0", [&](auto& t) { t.mutable_opacity_pins(0)->mutable_ramp()->set_a0(value); });
        refused("ramp a1", [&](auto& t) { t.mutable_opacity_pins(0)->mutable_ramp()->set_a1(value); });
        refused("hat centre", [&](auto& t) { t.mutable_opacity_pins(1)->mutable_hat()->set_centre(value); });
        refused("hat top", [&](auto& t) { t.mutable_opacity_pins(1)->mutable_hat()->set_top(value); });
        refused("hat base", [&](auto& t) { t.mutable_opacity_pins(1)->mutable_hat()->set_base(value); });
        refused("hat height", [&](auto& t) { t.mutable_opacity_pins(1)->mutable_hat()->set_height(value); });
        refused("flat", [&](auto& t) { t.mutable_opacity_pins(2)->mutable_flat()->set_height(value); });
        refused("blank lo", [&](auto& t) { t.mutable_opacity_pins(3)->mutable_blank()->set_lo(value); });
        refused("blank hi", [&](auto& t) { t.mutable_opacity_pins(3)->mutable_blank()->set_hi(value); });
        refused("colour at", [&](auto& t) { t.mutable_colour_pins(1)->set_at(value); });
        refused("colour", [&](auto& t) { t.mutable_colour_pins(1)->mutable_colour()->set_g(value); });
        refused("background", [&](auto& t) { t.mutable_background()->set_b(value); });
    }
    for (const double value : {not_finite, inf, -inf, 0.0, -1.0, 1e9}) {
        refused("density", [&](auto& t) { t.set_density(value); });
    }
    for (const double value : {not_finite, inf, -inf, 0.2, -0.2}) {
        refused("hat lean", [&](auto& t) { t.mutable_opacity_pins(1)->mutable_hat()->set_lean(value); });
    }
    refused("opacity of 2", [](auto& t) { t.mutable_opacity_pins(2)->mutable_flat()->set_height(2); });
    refused("a pin of no kind", [](auto& t) { t.add_opacity_pins(); });
    refused("colours out of order", [](auto& t) { t.mutable_colour_pins(0)->set_at(0.75); });
    refused("no colours", [](auto& t) { t.clear_colour_pins(); });
    refused("opacity pins", [](auto& t) {
        while (t.opacity_pins_size() <= 256) {
            t.add_opacity_pins()->mutable_flat()->set_height(0.5);
        }
    });
    refused("colour pins", [](auto& t) {
        while (t.colour_pins_size() <= 256) {
            t.add_colour_pins()->set_at(1);
        }
    });
}

TEST(FactorisationConversion, ThereAndBack) {
    view::Factorisation f = factorisation();
    const auto expect_same = [&] {
        const view::Factorisation back = factorisation_from(to_wire(f)).value();
        EXPECT_EQ(back.projection, f.projection);
        EXPECT_EQ(back.lattice.n, f.lattice.n);
        EXPECT_EQ(back.lattice.spacing, f.lattice.spacing);
        EXPECT_EQ(back.eye, f.eye);
        EXPECT_EQ(back.direction, f.direction);
        EXPECT_EQ(back.classify, f.classify);
        EXPECT_EQ(back.faces, f.faces);
    };
    expect_same();
    f.classify = view::Classify::pre_integrated;
    expect_same();
    f.projection = view::Projection::parallel;
    f.faces.pop_back();
    expect_same();
    f.faces.clear();
    expect_same();
    f.crop = volume::Box{{1, 0, 2}, {9, 5, 4}};
    EXPECT_EQ(factorisation_from(to_wire(f)).value(), f);
}

TEST(FactorisationConversion, WhatTheHeadMakesIsTaken) {
    const view::Lattice lattice{{64, 100, 33}, {1, 2, 0.5}};
    for (const double azimuth : {0.0, 30.0, 135.0}) {
        for (const view::Projection projection :
             {view::Projection::perspective, view::Projection::parallel}) {
            const view::Camera camera =
                view::camera_on({.azimuth = azimuth, .elevation = 20}, lattice, projection, 90);
            const view::Factorisation f = view::factorise(camera, {64, 64}, lattice, {1});
            EXPECT_EQ(factorisation_from(to_wire(f)).value().faces, f.faces);
        }
    }
}

TEST(FactorisationConversion, TakesTheLevelsThatACubeHas) {
    view::Factorisation f = factorisation();
    f.lattice.n = {20, 1024, 7};
    for (f.slice_exponent = -1; f.slice_exponent <= 5; ++f.slice_exponent) {
        EXPECT_EQ(factorisation_from(to_wire(f)).value(), f);
    }
    for (const int exponent : {-2, 6, 1000}) {
        f.slice_exponent = exponent;
        expect_invalid(factorisation_from(to_wire(f)), "slice_exponent");
    }
    f.lattice.n = {20, 512, 7};
    f.slice_exponent = 5;
    expect_invalid(factorisation_from(to_wire(f)), "slice_exponent");
}

TEST(FactorisationConversion, Hostile) {
    const auto refused = [](std::string_view what, auto change) {
        expect_refused(to_wire(factorisation()), factorisation_from, what, change);
    };
    for (const double value : {not_finite, inf, -inf}) {
        refused("eye", [&](pb::Factorisation& f) { f.mutable_eye()->set_x(value); });
        refused("direction", [&](pb::Factorisation& f) { f.mutable_direction()->set_z(value); });
        refused("spacing",
                [&](pb::Factorisation& f) { f.mutable_lattice()->mutable_spacing()->set_y(value); });
        refused("origin_u", [&](pb::Factorisation& f) { f.mutable_faces(0)->set_origin_u(value); });
        refused("origin_v", [&](pb::Factorisation& f) { f.mutable_faces(0)->set_origin_v(value); });
        refused("pitch_u", [&](pb::Factorisation& f) { f.mutable_faces(1)->set_pitch_u(value); });
        refused("pitch_v", [&](pb::Factorisation& f) { f.mutable_faces(1)->set_pitch_v(value); });
    }
    for (const int exponent : {-2, 4, 6, 1000}) {  // this cube has three levels besides its voxels
        refused("slice_exponent", [&](pb::Factorisation& f) { f.set_slice_exponent(exponent); });
    }
    for (const int classification : {2, -1, 1 << 30}) {
        refused("classification", [&](pb::Factorisation& f) {
            f.set_classification(static_cast<pb::Classification>(classification));
        });
    }
    for (const double opaque : {-0.5, 1.0, 2.0, not_finite, inf}) {
        refused("opaque", [&](pb::Factorisation& f) { f.set_opaque(opaque); });
    }
    refused("projection", [](pb::Factorisation& f) { f.set_projection(static_cast<pb::Projection>(7)); });
    refused("lattice", [](pb::Factorisation& f) { f.clear_lattice(); });
    for (const std::uint32_t axis : {3U, 0xFFFFFFFFU}) {
        refused("axis", [&](pb::Factorisation& f) { f.mutable_faces(0)->set_axis(axis); });
    }
    for (const std::int32_t sign : {0, 2, -2, std::numeric_limits<std::int32_t>::min()}) {
        refused("sign", [&](pb::Factorisation& f) { f.mutable_faces(0)->set_sign(sign); });
    }
    for (const std::uint32_t side : {0U, 16385U, 1U << 31, 0xFFFFFFFFU}) {
        refused("width", [&](pb::Factorisation& f) { f.mutable_faces(0)->set_width(side); });
        refused("height", [&](pb::Factorisation& f) { f.mutable_faces(1)->set_height(side); });
    }
    refused("area of one", [](pb::Factorisation& f) {
        f.mutable_faces(0)->set_width(16384);
        f.mutable_faces(0)->set_height(16384);
    });
    refused("area of both", [](pb::Factorisation& f) {
        for (pb::Face& face : *f.mutable_faces()) {
            face.set_width(16384);
            face.set_height(4097);
        }
    });
    refused("crop outside the cube", [](pb::Factorisation& f) {
        *f.mutable_crop() = to_wire(volume::Box{{0, 0, 0}, {1, 1, 1 << 20}});
    });
    refused("crop of no thickness", [](pb::Factorisation& f) {
        *f.mutable_crop() = to_wire(volume::Box{{0, 1, 0}, {1, 1, 1}});
    });
    refused("seven faces", [](pb::Factorisation& f) {
        while (f.faces_size() < 7) {
            *f.add_faces() = f.faces(0);
        }
    });
}

}  // namespace
}  // namespace shearwater::wire::test
