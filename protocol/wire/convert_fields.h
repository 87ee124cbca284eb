#pragma once
// What the conversions share.

#include <cmath>
#include <string>
#include <utility>

#include "common/base/result.h"
#include "common/view/camera.h"
#include "common/view/factorisation.h"
#include "protocol/wire/header.h"

namespace shearwater::wire {

inline Fault invalid(std::string text) {
    return {pb::REASON_INVALID, std::move(text)};
}
inline Fault invalid(const base::Error& error) {
    return invalid(error.message());
}

inline void set(pb::Vec3& to, const view::Vec3& from) {
    to.set_x(from.x);
    to.set_y(from.y);
    to.set_z(from.z);
}
inline view::Vec3 vec3_from(const pb::Vec3& from) {
    return {from.x(), from.y(), from.z()};
}

inline bool finite(const view::Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

pb::Projection to_wire(view::Projection projection);
Parsed<view::Projection> projection_from(pb::Projection projection);
pb::Classification to_wire(view::Classify classify);
Parsed<view::Classify> classify_from(pb::Classification classification, const char* field);

}  // namespace shearwater::wire
