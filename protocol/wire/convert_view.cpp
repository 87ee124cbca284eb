// Cameras, transfer functions and a client's request made of them.

#include "protocol/wire/convert.h"
#include "protocol/wire/convert_culling.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

Parsed<view::Quality> quality_from(pb::Quality quality) {
    switch (quality) {
        case pb::QUALITY_NORMAL:
            return view::Quality::normal;
        case pb::QUALITY_DRAFT:
            return view::Quality::draft;
        case pb::QUALITY_HIGH:
            return view::Quality::high;
        default:
            return invalid("view.quality: unknown");
    }
}

// Finite is all that is asked of it here: what else a camera needs depends on the picture's size.
Parsed<view::Camera> camera_from(const pb::Camera& camera) {
    const auto projection = projection_from(camera.projection());
    if (!projection) {
        return projection.error();
    }
    const view::Camera from{.eye = vec3_from(camera.eye()),
                            .target = vec3_from(camera.target()),
                            .up = vec3_from(camera.up()),
                            .projection = *projection,
                            .fov = camera.fov(),
                            .height = camera.height(),
                            .slant = {camera.slant_x(), camera.slant_y()}};
    if (!finite(from.eye) || !finite(from.target) || !finite(from.up) || !std::isfinite(from.fov) ||
        !std::isfinite(from.height) || !std::isfinite(from.slant.x) || !std::isfinite(from.slant.y)) {
        return invalid("camera: finite numbers are wanted");
    }
    return from;
}

void set(pb::Colour& to, const view::Rgb& from) {
    to.set_r(from.r);
    to.set_g(from.g);
    to.set_b(from.b);
}
view::Rgb colour_from(const pb::Colour& from) {
    return {from.r(), from.g(), from.b()};
}

void set(pb::OpacityPin& to, const view::Ramp& ramp) {
    to.mutable_ramp()->set_x0(ramp.x0);
    to.mutable_ramp()->set_a0(ramp.a0);
    to.mutable_ramp()->set_x1(ramp.x1);
    to.mutable_ramp()->set_a1(ramp.a1);
}
void set(pb::OpacityPin& to, const view::Hat& hat) {
    to.mutable_hat()->set_centre(hat.centre);
    to.mutable_hat()->set_top(hat.top);
    to.mutable_hat()->set_base(hat.base);
    to.mutable_hat()->set_height(hat.height);
    to.mutable_hat()->set_lean(hat.lean);
}
void set(pb::OpacityPin& to, const view::Flat& flat) {
    to.mutable_flat()->set_height(flat.height);
}
void set(pb::OpacityPin& to, const view::Blank& blank) {
    to.mutable_blank()->set_lo(blank.lo);
    to.mutable_blank()->set_hi(blank.hi);
}

Parsed<view::OpacityPin> opacity_pin_from(const pb::OpacityPin& pin) {
    switch (pin.pin_case()) {
        case pb::OpacityPin::kRamp:
            return view::Ramp{pin.ramp().x0(), pin.ramp().a0(), pin.ramp().x1(), pin.ramp().a1()};
        case pb::OpacityPin::kHat:
            return view::Hat{pin.hat().centre(), pin.hat().top(), pin.hat().base(), pin.hat().height(),
                             pin.hat().lean()};
        case pb::OpacityPin::kFlat:
            return view::Flat{pin.flat().height()};
        case pb::OpacityPin::kBlank:
            return view::Blank{pin.blank().lo(), pin.blank().hi()};
        case pb::OpacityPin::PIN_NOT_SET:
            break;
    }
    return invalid("transfer_function.opacity_pins: a pin of an unknown kind");
}

Parsed<std::optional<view::StereoSettings>> stereo_from(const pb::SetView& view, const view::Camera& camera,
                                                        const view::ImageSize& size) {
    if (!view.has_stereo()) {
        return std::optional<view::StereoSettings>();
    }
    const view::StereoSettings stereo{view.stereo().separation(), view.stereo().convergence(),
                                      view.stereo().swap()};
    if (const auto status = view::validate(stereo, camera, size); !status) {
        return invalid(status.error());
    }
    return std::optional(stereo);
}

Parsed<std::optional<volume::Box>> crop_from(const pb::SetView& view) {
    if (!view.has_crop()) {
        return std::optional<volume::Box>();
    }
    const auto crop = box_from(view.crop());
    if (!crop) {
        return crop.error();
    }
    return std::optional(*crop);
}

Parsed<std::optional<volume::Scaling>> optional_scaling_from(const pb::SetView& view) {
    if (!view.has_scaling()) {
        return std::optional<volume::Scaling>();
    }
    const auto scaling = scaling_from(view.scaling());
    if (!scaling) {
        return invalid("view.scaling: " + scaling.error().text);
    }
    return std::optional(*scaling);
}

}  // namespace

pb::Projection to_wire(view::Projection projection) {
    return projection == view::Projection::parallel ? pb::PARALLEL : pb::PERSPECTIVE;
}

Parsed<view::Projection> projection_from(pb::Projection projection) {
    switch (projection) {
        case pb::PERSPECTIVE:
            return view::Projection::perspective;
        case pb::PARALLEL:
            return view::Projection::parallel;
        default:
            return invalid("projection: unknown");
    }
}

pb::Classification to_wire(view::Classify classify) {
    return classify == view::Classify::pre_integrated ? pb::CLASSIFICATION_PRE_INTEGRATED
                                                      : pb::CLASSIFICATION_POST;
}

Parsed<view::Classify> classify_from(pb::Classification classification, const char* field) {
    switch (classification) {
        case pb::CLASSIFICATION_POST:
            return view::Classify::post;
        case pb::CLASSIFICATION_PRE_INTEGRATED:
            return view::Classify::pre_integrated;
        default:
            return invalid(std::string(field) + ": unknown");
    }
}

pb::Quality to_wire(view::Quality quality) {
    switch (quality) {
        case view::Quality::draft:
            return pb::QUALITY_DRAFT;
        case view::Quality::high:
            return pb::QUALITY_HIGH;
        case view::Quality::normal:
            break;
    }
    return pb::QUALITY_NORMAL;
}

pb::Camera to_wire(const view::Camera& camera) {
    pb::Camera to;
    set(*to.mutable_eye(), camera.eye);
    set(*to.mutable_target(), camera.target);
    set(*to.mutable_up(), camera.up);
    to.set_projection(to_wire(camera.projection));
    to.set_fov(camera.fov);
    to.set_height(camera.height);
    to.set_slant_x(camera.slant.x);
    to.set_slant_y(camera.slant.y);
    return to;
}

pb::TransferFunction to_wire(const view::TransferFunction& tf) {
    pb::TransferFunction to;
    for (const view::OpacityPin& pin : tf.opacity_pins) {
        std::visit([&](const auto& kind) { set(*to.add_opacity_pins(), kind); }, pin);
    }
    for (const view::ColourPin& pin : tf.colour_pins) {
        pb::ColourPin& colour_pin = *to.add_colour_pins();
        colour_pin.set_at(pin.at);
        set(*colour_pin.mutable_colour(), pin.rgb);
    }
    set(*to.mutable_background(), tf.background);
    if (tf.density != 1) {
        to.set_density(tf.density);
    }
    return to;
}

Parsed<view::TransferFunction> transfer_function_from(const pb::TransferFunction& tf) {
    constexpr auto max_pins = static_cast<int>(view::TransferFunction::max_pins);
    if (tf.opacity_pins_size() > max_pins || tf.colour_pins_size() > max_pins) {
        return invalid("transfer_function: at most " + std::to_string(max_pins) + " pins of a kind");
    }
    view::TransferFunction from;
    for (const pb::OpacityPin& pin : tf.opacity_pins()) {
        const auto opacity_pin = opacity_pin_from(pin);
        if (!opacity_pin) {
            return opacity_pin.error();
        }
        from.opacity_pins.push_back(*opacity_pin);
    }
    for (const pb::ColourPin& pin : tf.colour_pins()) {
        from.colour_pins.push_back({.at = pin.at(), .rgb = colour_from(pin.colour())});
    }
    from.background = colour_from(tf.background());
    from.density = tf.has_density() ? tf.density() : 1;
    if (const auto status = view::validate(from); !status) {
        return invalid(status.error());
    }
    return from;
}

std::vector<view::Camera> cameras_of(const View& view) {
    if (!view.stereo) {
        return {view.camera};
    }
    const auto eyes = view::eyes_of(view.camera, *view.stereo);
    return {eyes.begin(), eyes.end()};
}

pb::SetView to_wire(const View& view) {
    pb::SetView to;
    to.set_revision(view.revision);
    *to.mutable_camera() = to_wire(view.camera);
    to.set_width(static_cast<std::uint32_t>(view.size.width));
    to.set_height(static_cast<std::uint32_t>(view.size.height));
    *to.mutable_transfer_function() = to_wire(view.tf);
    to.set_quality(to_wire(view.quality));
    to.set_deflate(view.deflate);
    if (view.level_of_detail) {
        to.set_exact(!*view.level_of_detail);
    }
    to.set_sketch(view.sketch);
    to.set_classification(to_wire(view.classify));
    if (view.culling != culling::Settings()) {
        *to.mutable_culling() = to_wire(view.culling);
    }
    if (view.stereo) {
        to.mutable_stereo()->set_separation(view.stereo->separation);
        to.mutable_stereo()->set_convergence(view.stereo->convergence);
        to.mutable_stereo()->set_swap(view.stereo->swap);
    }
    if (view.crop) {
        *to.mutable_crop() = to_wire(*view.crop);
    }
    if (view.scaling) {
        *to.mutable_scaling() = to_wire(*view.scaling);
    }
    return to;
}

Parsed<View> view_from(const pb::SetView& view) {
    constexpr std::uint32_t any_int = 1U << 30;
    const auto camera = camera_from(view.camera());
    if (!camera) {
        return camera.error();
    }
    if (view.width() > any_int || view.height() > any_int) {
        return invalid("view: the picture is too large");
    }
    const view::ImageSize size{.width = static_cast<int>(view.width()),
                               .height = static_cast<int>(view.height())};
    if (const auto status = view::validate(*camera, size); !status) {
        return invalid(status.error());
    }
    auto tf = transfer_function_from(view.transfer_function());
    if (!tf) {
        return tf.error();
    }
    const auto quality = quality_from(view.quality());
    if (!quality) {
        return quality.error();
    }
    const auto classify = classify_from(view.classification(), "view.classification");
    if (!classify) {
        return classify.error();
    }
    const auto culling = view.has_culling() ? culling_from(view.culling()) : culling::Settings();
    if (!culling) {
        return culling.error();
    }
    const auto stereo = stereo_from(view, *camera, size);
    if (!stereo) {
        return stereo.error();
    }
    const auto crop = crop_from(view);
    if (!crop) {
        return crop.error();
    }
    const auto scaling = optional_scaling_from(view);
    if (!scaling) {
        return scaling.error();
    }
    return View{.revision = view.revision(),
                .camera = *camera,
                .size = size,
                .tf = std::move(*tf),
                .quality = *quality,
                .deflate = view.deflate(),
                .level_of_detail = view.has_exact() ? std::optional(!view.exact()) : std::nullopt,
                .sketch = view.sketch(),
                .classify = *classify,
                .culling = *culling,
                .stereo = *stereo,
                .crop = *crop,
                .scaling = *scaling};
}

}  // namespace shearwater::wire
