// Factorisations and their faces.

#include "common/volume/levels.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {
namespace {

pb::Face to_wire(const view::Face& face) {
    pb::Face to;
    to.set_axis(static_cast<std::uint32_t>(face.axis));
    to.set_sign(face.sign);
    to.set_width(static_cast<std::uint32_t>(face.width));
    to.set_height(static_cast<std::uint32_t>(face.height));
    to.set_origin_u(face.origin.x);
    to.set_origin_v(face.origin.y);
    to.set_pitch_u(face.pitch.x);
    to.set_pitch_v(face.pitch.y);
    return to;
}

Parsed<view::Face> face_from(const pb::Face& face) {
    constexpr auto max_side = static_cast<std::uint32_t>(view::Factorisation::max_side);
    if (face.axis() > 2) {
        return invalid("face.axis: 0, 1 or 2 is wanted");
    }
    if (face.sign() != 1 && face.sign() != -1) {
        return invalid("face.sign: 1 or -1 is wanted");
    }
    if (face.width() == 0 || face.height() == 0 || face.width() > max_side || face.height() > max_side) {
        return invalid("face: width and height of 1 to " + std::to_string(max_side) + " are wanted");
    }
    if (!std::isfinite(face.origin_u()) || !std::isfinite(face.origin_v()) ||
        !std::isfinite(face.pitch_u()) || !std::isfinite(face.pitch_v())) {
        return invalid("face: a finite origin and pitch are wanted");
    }
    return view::Face{.axis = static_cast<int>(face.axis()),
                      .sign = face.sign(),
                      .width = static_cast<int>(face.width()),
                      .height = static_cast<int>(face.height()),
                      .origin = {face.origin_u(), face.origin_v()},
                      .pitch = {face.pitch_u(), face.pitch_v()}};
}

Parsed<std::vector<view::Face>> faces_from(const pb::Factorisation& factorisation) {
    if (factorisation.faces_size() > view::Factorisation::max_faces) {
        return invalid("factorisation.faces: more than six");
    }
    std::vector<view::Face> faces;
    std::int64_t area = 0;
    for (const pb::Face& face : factorisation.faces()) {
        const auto from = face_from(face);
        if (!from) {
            return from.error();
        }
        area += std::int64_t{from->width} * from->height;
        faces.push_back(*from);
    }
    if (area > view::Factorisation::max_area) {
        return invalid("factorisation.faces: too many pixels in all");
    }
    return faces;
}

}  // namespace

pb::Factorisation to_wire(const view::Factorisation& factorisation) {
    pb::Factorisation to;
    to.set_projection(to_wire(factorisation.projection));
    *to.mutable_lattice() = to_wire(factorisation.lattice);
    set(*to.mutable_eye(), factorisation.eye);
    set(*to.mutable_direction(), factorisation.direction);
    to.set_slice_exponent(factorisation.slice_exponent);
    to.set_classification(to_wire(factorisation.classify));
    if (factorisation.opaque != view::opaque_enough) {
        to.set_opaque(factorisation.opaque);
    }
    for (const view::Face& face : factorisation.faces) {
        *to.add_faces() = to_wire(face);
    }
    if (factorisation.crop) {
        *to.mutable_crop() = to_wire(*factorisation.crop);
    }
    return to;
}

Parsed<view::Factorisation> factorisation_from(const pb::Factorisation& factorisation) {
    const auto projection = projection_from(factorisation.projection());
    if (!projection) {
        return projection.error();
    }
    const auto lattice = lattice_from(factorisation.lattice());
    if (!lattice) {
        return lattice.error();
    }
    if (factorisation.slice_exponent() < -1 || factorisation.slice_exponent() > volume::max_level) {
        return invalid("factorisation.slice_exponent: -1 to " + std::to_string(volume::max_level) +
                       " is wanted");
    }
    const auto classify = classify_from(factorisation.classification(), "factorisation.classification");
    if (!classify) {
        return classify.error();
    }
    auto faces = faces_from(factorisation);
    if (!faces) {
        return faces.error();
    }
    view::Factorisation from{.projection = *projection,
                             .lattice = *lattice,
                             .eye = vec3_from(factorisation.eye()),
                             .direction = vec3_from(factorisation.direction()),
                             .slice_exponent = factorisation.slice_exponent(),
                             .classify = *classify,
                             .opaque =
                                 factorisation.opaque() == 0 ? view::opaque_enough : factorisation.opaque(),
                             .faces = std::move(*faces)};
    if (!finite(from.eye) || !finite(from.direction)) {
        return invalid("factorisation: a finite eye and direction are wanted");
    }
    if (factorisation.has_crop()) {
        const auto crop = box_from(factorisation.crop());
        if (!crop) {
            return crop.error();
        }
        from.crop = *crop;
    }
    if (const auto status = view::validate(from); !status) {
        return invalid(status.error());
    }
    return from;
}

}  // namespace shearwater::wire
