#include "common/fits/axes.h"

#include <algorithm>
#include <cctype>

namespace shearwater::fits {

namespace {

using base::Code;

std::string axis_type(const Hdu& hdu, int axis) {
    std::string type = hdu.header.text("CTYPE", axis).value_or("");
    std::transform(type.begin(), type.end(), type.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return type;
}

// The one of four long axes along which a plane is chosen.
int plane_axis(const Hdu& hdu, const std::vector<int>& axes) {
    const auto named = [&](std::string_view start) {
        return std::find_if(axes.begin(), axes.end(),
                            [&](int axis) { return axis_type(hdu, axis).starts_with(start); });
    };
    for (const std::string_view start : {"STOKES", "POL", "TIME"}) {
        if (const auto found = named(start); found != axes.end()) {
            return *found;
        }
    }
    return axes.back();
}

std::string described(const Hdu& hdu, int axis) {
    const std::string type = base::printable(hdu.header.text("CTYPE", axis).value_or(""), 20);
    return "axis " + std::to_string(axis) + (type.empty() ? "" : " (" + type + ")");
}

base::Status choose_plane(const Hdu& hdu, const std::optional<std::int64_t>& plane, CubeAxes& chosen,
                          const std::string& operation) {
    if (chosen.plane_axis == 0) {
        if (plane.value_or(0) != 0) {
            return base::error(
                Code::invalid_argument, operation,
                "plane " + std::to_string(*plane) + " is asked for, but there is no fourth axis");
        }
        return {};
    }
    chosen.planes = hdu.axes[static_cast<std::size_t>(chosen.plane_axis - 1)];
    chosen.plane = plane.value_or(0);
    const std::string axis = described(hdu, chosen.plane_axis);
    if (chosen.plane < 0 || chosen.plane >= chosen.planes) {
        return base::error(Code::invalid_argument, operation,
                           "plane " + std::to_string(chosen.plane) + " is asked for, but " + axis +
                               " has planes 0 to " + std::to_string(chosen.planes - 1));
    }
    if (!plane) {
        chosen.note = axis + " has " + std::to_string(chosen.planes) + " planes: plane 0 is used";
    }
    return {};
}

}  // namespace

base::Result<CubeAxes> choose_axes(const Hdu& hdu, const std::optional<std::int64_t>& plane,
                                   const std::string& operation) {
    std::vector<int> axes;
    for (std::size_t i = 0; i < hdu.axes.size(); ++i) {
        if (hdu.axes[i] > 1) {
            axes.push_back(static_cast<int>(i) + 1);
        }
    }
    if (hdu.long_axes() < 3) {
        return base::error(Code::unsupported, operation,
                           "not a cube: HDU " + std::to_string(hdu.number) + " is " + hdu.shape() +
                               ", and three axes longer than 1 are needed");
    }
    if (axes.size() > 4) {
        return base::error(Code::unsupported, operation,
                           "not a cube: HDU " + std::to_string(hdu.number) + " is " + hdu.shape() +
                               ", with " + std::to_string(axes.size()) +
                               " axes longer than 1 where 3 or 4 can be used");
    }
    CubeAxes chosen;
    if (axes.size() == 4) {
        chosen.plane_axis = plane_axis(hdu, axes);
        std::erase(axes, chosen.plane_axis);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        chosen.axis[i] = axes[i];
        chosen.n[i] = hdu.axes[static_cast<std::size_t>(axes[i] - 1)];
    }
    if (base::Status status = choose_plane(hdu, plane, chosen, operation); !status) {
        return status.error();
    }
    return chosen;
}

}  // namespace shearwater::fits
