#include "common/fits/world.h"

#include <wcslib/wcs.h>
#include <wcslib/wcsfix.h>
#include <wcslib/wcshdr.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "common/fits/world_types.h"
#include "common/wcs/sample.h"

namespace shearwater::fits {

namespace {

constexpr std::size_t most_world_axes = 12;  // with those of length 1
constexpr int most_parameters = 30;          // PVi_0 to PVi_29, as far as projections have them
constexpr double most_degrees = 100000;      // what goes round more often is no angle
constexpr double largest = 1e60;

struct Free {
    void operator()(wcsprm* prm) const {
        wcsfree(prm);
        delete prm;
    }
};
using Wcs = std::unique_ptr<wcsprm, Free>;

// One axis of the header.
struct Keys {
    WorldType type;
    Unit unit;
    double at = 0, pixel_at = 0, step = 1;  // CRVAL, CRPIX, CDELT, in the header's unit
    bool usable = false;                    // there is something to be known of it
};

std::string key(std::string_view stem, std::size_t axis) {
    return std::string(stem) + std::to_string(axis + 1);
}
std::string key(std::string_view stem, std::size_t axis, std::size_t other) {
    return key(stem, axis) + "_" + std::to_string(other);
}
std::optional<double> number(const Header& header, const std::string& keyword) {
    const auto value = header.real(keyword);
    return value && std::abs(*value) <= largest ? value : std::nullopt;
}

Keys keys_of(const Header& header, std::size_t axis) {
    Keys keys{.unit = unit_of(header.text(key("CUNIT", axis)).value_or(""))};
    const std::string type = header.text(key("CTYPE", axis)).value_or("");
    keys.type = world_type(type, keys.unit);
    if (keys.unit.shown.empty() && keys.type.quantity != Quantity::other) {
        keys.unit = unit_of(si_unit(keys.type.quantity));  // as the standard has it
    }
    keys.at = number(header, key("CRVAL", axis)).value_or(0);
    keys.pixel_at = number(header, key("CRPIX", axis)).value_or(0);
    keys.step = number(header, key("CDELT", axis)).value_or(1);
    // Tables would have to be read from other HDUs.
    keys.usable = !type.empty() && keys.step != 0 && !keys.type.code.ends_with("-TAB");
    const bool odd_unit = keys.unit.quantity != keys.type.quantity;
    const bool odd_angle = keys.type.celestial && std::abs(keys.at * keys.unit.in_si) > most_degrees;
    if (keys.type.celestial && (odd_unit || odd_angle)) {
        keys.usable = false;
    }
    if (!keys.usable || odd_unit) {
        keys.type.code.clear();
    }
    keys.step = keys.step != 0 ? keys.step : 1;
    return keys;
}

// The factor to what wcslib calculates in.
double in_si(const Keys& keys) {
    return keys.type.code.empty() ? 1 : keys.unit.in_si;
}

// PC, CD or CROTA, the first that there is.
void read_matrix(const Header& header, const std::vector<Keys>& keys, wcsprm& prm) {
    const std::size_t n = keys.size();
    const auto any = [&](std::string_view stem) {
        for (std::size_t i = 0; i < n * n; ++i) {
            if (header.has(key(stem, i / n, i % n + 1))) {
                return true;
            }
        }
        return false;
    };
    if (any("PC")) {
        for (std::size_t i = 0; i < n * n; ++i) {
            prm.pc[i] = number(header, key("PC", i / n, i % n + 1)).value_or(i / n == i % n ? 1 : 0);
        }
        prm.altlin = 1;
    } else if (any("CD")) {
        for (std::size_t i = 0; i < n; ++i) {
            bool filled = false;
            for (std::size_t j = 0; j < n; ++j) {
                prm.cd[i * n + j] = in_si(keys[i]) * number(header, key("CD", i, j + 1)).value_or(0);
                filled = filled || prm.cd[i * n + j] != 0;
            }
            prm.cd[i * n + i] = filled ? prm.cd[i * n + i] : prm.cdelt[i];
        }
        prm.altlin = 2;
    } else {
        for (std::size_t i = 0; i < n; ++i) {
            if (const auto angle = number(header, key("CROTA", i));
                angle && std::abs(*angle) <= most_degrees) {
                prm.crota[i] = *angle;
                prm.altlin = 4;
            }
        }
    }
}

void read_parameters(const Header& header, const std::vector<Keys>& keys, wcsprm& prm) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (keys[i].type.code.empty() || keys[i].type.distorted) {
            continue;
        }
        for (std::size_t m = 0; m < most_parameters && prm.npv < prm.npvmax; ++m) {
            if (const auto value = number(header, key("PV", i, m))) {
                prm.pv[prm.npv++] = {static_cast<int>(i) + 1, static_cast<int>(m), *value};
            }
        }
    }
    const auto angle = [&](const char* keyword, double& to) {
        if (const auto value = number(header, keyword); value && std::abs(*value) <= most_degrees) {
            to = *value;
        }
    };
    angle("LONPOLE", prm.lonpole);
    angle("LATPOLE", prm.latpole);
    const auto rest = header.has("RESTFRQ") ? number(header, "RESTFRQ") : number(header, "RESTFREQ");
    prm.restfrq = std::max(0.0, rest.value_or(0));
    prm.restwav = std::max(0.0, number(header, "RESTWAV").value_or(0));
    const auto velref = header.integer("VELREF").value_or(0);
    // A frame from 1 to 7, and 256 more for radio velocities.
    prm.velref = velref > 0 && velref < 512 && velref % 256 <= 7 ? static_cast<int>(velref) : 0;
}

// Ready to be asked; nothing where wcslib can make nothing of it.
Wcs set_up(const Header& header, const std::vector<Keys>& keys) {
    // wcsini knows by this that nothing has been allocated yet.
    Wcs wcs(new wcsprm{});
    wcs->flag = -1;
    const auto n = static_cast<int>(keys.size());
    if (wcsini(1, n, wcs.get()) != 0) {
        return nullptr;
    }
    for (std::size_t i = 0; i < keys.size(); ++i) {
        wcs->crpix[i] = keys[i].pixel_at;
        wcs->crval[i] = keys[i].at * in_si(keys[i]);
        wcs->cdelt[i] = keys[i].step * in_si(keys[i]);
        const std::string& code = keys[i].type.code;
        code.copy(wcs->ctype[i], code.size());
        if (!code.empty()) {
            si_unit(keys[i].type.quantity).copy(wcs->cunit[i], 8);
        }
    }
    read_matrix(header, keys, *wcs);
    read_parameters(header, keys, *wcs);
    // Types of before the standard: RA---NCP, VELO-LSR.
    if (spcfix(wcs.get()) > 0 || celfix(wcs.get()) > 0 || wcsset(wcs.get()) != 0) {
        return nullptr;
    }
    return wcs;
}

// As much as wcslib makes something of: without what cannot be used of the sky, or of the spectrum. There the
// formulas are linear at best.
Wcs set_up_what_can_be(const Header& header, std::vector<Keys>& keys) {
    const auto without = [](std::vector<Keys> some, bool sky, bool spectrum) {
        for (Keys& axis : some) {
            if ((sky && axis.type.celestial) || (spectrum && axis.type.spectral)) {
                // A sky that is not projected is none; a spectrum may be linear.
                axis.usable =
                    axis.usable && !axis.type.celestial && axis.type.code.find('-') == std::string::npos;
                axis.type.code.clear();
            }
        }
        return some;
    };
    if (Wcs whole = set_up(header, keys)) {
        return whole;
    }
    for (const auto& [sky, spectrum] : {std::pair(false, true), {true, false}, {true, true}}) {
        std::vector<Keys> some = without(keys, sky, spectrum);
        if (Wcs wcs = set_up(header, some)) {
            keys = std::move(some);
            return wcs;
        }
    }
    return nullptr;
}

// Which axis of the header changes most along each of the cube's, all three once.
std::array<std::size_t, 3> most_along(const wcsprm& prm, const CubeAxes& axes) {
    std::array<std::size_t, 3> own{};
    for (std::size_t a = 0; a < 3; ++a) {
        own[a] = static_cast<std::size_t>(axes.axis[a] - 1);
    }
    if (prm.lin.unity != 0 || prm.lin.piximg == nullptr) {
        return own;
    }
    const auto n = static_cast<std::size_t>(prm.naxis);
    const auto share = [&](std::size_t world, std::size_t pixel) {
        double all = 0;
        for (const std::size_t other : own) {
            all += std::abs(prm.lin.piximg[world * n + other]);
        }
        return all > 0 ? std::abs(prm.lin.piximg[world * n + pixel]) / all : 0;
    };
    std::array<std::size_t, 3> order{0, 1, 2}, best = order;
    double most = -1;
    do {
        double sum = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            sum += share(own[order[a]], own[a]);
        }
        if (sum > most + 1e-6) {
            most = sum;
            best = order;
        }
    } while (std::ranges::next_permutation(order).found);
    return {own[best[0]], own[best[1]], own[best[2]]};
}

std::vector<double> ask(wcsprm& prm, const CubeAxes& axes, std::size_t world,
                        std::span<const wcs::Place> places) {
    const auto n = static_cast<std::size_t>(prm.naxis);
    const std::size_t count = places.size();
    std::vector<double> pixels(n * count, 1), image(n * count), worlds(n * count), phi(count), theta(count);
    std::vector<int> faults(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t a = 0; a < 3; ++a) {
            pixels[i * n + static_cast<std::size_t>(axes.axis[a] - 1)] = places[i][a] + 1;
        }
        if (axes.plane_axis > 0) {
            pixels[i * n + static_cast<std::size_t>(axes.plane_axis - 1)] =
                static_cast<double>(axes.plane + 1);
        }
    }
    std::vector<double> values(count, std::nan(""));
    constexpr int some_invalid = 8;
    const int status = wcsp2s(&prm, static_cast<int>(count), prm.naxis, pixels.data(), image.data(),
                              phi.data(), theta.data(), worlds.data(), faults.data());
    if (status != 0 && status != some_invalid) {
        return values;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if ((faults[i] >> world & 1) == 0 && std::isfinite(worlds[i * n + world])) {
            values[i] = worlds[i * n + world];
        }
    }
    return values;
}

wcs::Axis axis_of(wcsprm& prm, const CubeAxes& axes, const Keys& keys, std::size_t world, int along) {
    const bool by_wcslib = !keys.type.code.empty();
    wcs::Axis axis{.name = keys.type.name,
                   .label = keys.type.label,
                   .unit = keys.unit.shown,
                   .notation = keys.type.notation,
                   .circle = keys.type.circle};
    const double header_unit = by_wcslib ? 1 : keys.unit.in_si;
    const auto in_si_at = [&](std::span<const wcs::Place> places) {
        std::vector<double> values = ask(prm, axes, world, places);
        for (double& value : values) {
            value *= header_unit;
            // Offsets about the Sun's middle go both ways.
            if (keys.type.celestial && !axis.circle && std::abs(value) > 180) {
                value -= 360 * std::round(value / 360);
            }
        }
        return values;
    };
    // A circle is in degrees.
    Unit unit = unit_of("deg");
    if (!axis.circle && axis.notation == wcs::Notation::plain) {
        const std::array<wcs::Place, 2> ends{
            wcs::Place{}, wcs::Place{static_cast<double>(axes.n[0] - 1), static_cast<double>(axes.n[1] - 1),
                                     static_cast<double>(axes.n[2] - 1)}};
        const std::vector<double> values = in_si_at(ends);
        unit = unit_to_show(keys.unit, std::fmax(std::abs(values[0]), std::abs(values[1])));
    }
    axis.unit = unit.shown;
    const bool filled = wcs::sample(axis, along, axes.n, [&](std::span<const wcs::Place> places) {
        std::vector<double> values = in_si_at(places);
        for (double& value : values) {
            value /= unit.in_si;
        }
        return values;
    });
    return filled && wcs::validate(axis, along) ? axis : wcs::Axis{};
}

}  // namespace

wcs::Axes read_world(const Header& header, const std::vector<std::int64_t>& lengths, const CubeAxes& axes,
                     std::vector<std::string>& notes) {
    const std::int64_t stated = header.integer("WCSAXES").value_or(0);
    const std::size_t count = std::max(
        lengths.size(), static_cast<std::size_t>(std::clamp<std::int64_t>(stated, 0, most_world_axes)));
    if (count > most_world_axes) {
        notes.emplace_back("the header's world coordinates have too many axes to be used");
        return {};
    }
    std::vector<Keys> keys;
    for (std::size_t i = 0; i < count; ++i) {
        keys.push_back(keys_of(header, i));
    }
    if (std::ranges::none_of(keys, &Keys::usable)) {
        return {};
    }
    const Wcs prm = set_up_what_can_be(header, keys);
    if (prm == nullptr) {
        notes.emplace_back("the header's world coordinates cannot be used");
        return {};
    }
    wcs::Axes result;
    const std::array<std::size_t, 3> worlds = most_along(*prm, axes);
    for (std::size_t a = 0; a < 3; ++a) {
        const Keys& axis = keys[worlds[a]];
        if (axis.usable) {
            result[a] = axis_of(*prm, axes, axis, worlds[a], static_cast<int>(a));
        }
        if (!result[a].known() && (axis.type.celestial || axis.type.spectral)) {
            notes.push_back("the header's " + axis.type.name + " cannot be used");
        }
    }
    if (std::ranges::any_of(keys, [](const Keys& axis) { return axis.usable && axis.type.distorted; })) {
        notes.emplace_back("distortions are left out of the world coordinates");
    }
    return result;
}

}  // namespace shearwater::fits
