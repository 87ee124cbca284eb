#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/view/transfer_function.h"

namespace shearwater::view {

namespace {

// The published tables (van der Walt & Smith 2015; Nunez, Anderton & Renslow 2018; Mikhailov 2019;
// Moreland 2009) at 33 equal steps as 0xrrggbb; linear between. The whole tables lie within 3 / 255 of
// that, and within 6 at the dark end of cividis, which bends there.
using Samples = std::array<unsigned, 33>;
constexpr Samples viridis = {0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086,
                             0x3f4989, 0x3b528b, 0x375a8d, 0x33638d, 0x2f6a8e, 0x2c728e, 0x297a8e,
                             0x26818e, 0x23898e, 0x21908c, 0x1f988b, 0x1f9f88, 0x21a685, 0x28ae80,
                             0x31b57b, 0x3ebc74, 0x4cc26c, 0x5dc963, 0x6ece58, 0x82d34c, 0x96d83f,
                             0xabdc32, 0xc0df24, 0xd5e21a, 0xeae51a, 0xfde725};
constexpr Samples inferno = {0x000004, 0x040312, 0x0b0724, 0x150b37, 0x210c4a, 0x2e0a5a, 0x3c0965,
                             0x4a0c6b, 0x57106d, 0x63146e, 0x70196e, 0x7d1e6d, 0x89226a, 0x962766,
                             0xa32b61, 0xaf315c, 0xbb3755, 0xc63e4d, 0xd14644, 0xdb4f3b, 0xe35932,
                             0xeb6528, 0xf1711e, 0xf67f14, 0xf98d0a, 0xfb9c06, 0xfcab0f, 0xfbba1f,
                             0xf9ca32, 0xf5d949, 0xf2e865, 0xf3f586, 0xfcffa4};
constexpr Samples magma = {0x000004, 0x030311, 0x0a0822, 0x130d33, 0x1d1146, 0x28115a, 0x36106a,
                           0x430f76, 0x50127c, 0x5d177f, 0x691c81, 0x762181, 0x822681, 0x8f2a81,
                           0x9c2e7f, 0xa9327d, 0xb63779, 0xc33b75, 0xcf4170, 0xdb486a, 0xe65163,
                           0xee5c5e, 0xf5695c, 0xf9785d, 0xfb8761, 0xfd9668, 0xfea571, 0xfeb47b,
                           0xfec387, 0xfed194, 0xfde0a2, 0xfceeb0, 0xfcfdbf};
constexpr Samples plasma = {0x0d0887, 0x220690, 0x310596, 0x3f049c, 0x4c02a1, 0x5901a5, 0x6600a7,
                            0x7201a8, 0x7e03a8, 0x8909a6, 0x9511a2, 0x9f1a9c, 0xa92396, 0xb22c8e,
                            0xbb3587, 0xc33e80, 0xcb4778, 0xd25071, 0xd9596a, 0xe06263, 0xe66c5c,
                            0xeb7555, 0xf07f4f, 0xf48a48, 0xf89441, 0xfb9f3a, 0xfdab33, 0xfeb72d,
                            0xfdc328, 0xfcd025, 0xf9dd25, 0xf5eb27, 0xf0f921};
constexpr Samples cividis = {0x00224e, 0x00285b, 0x002e6a, 0x043371, 0x1a386f, 0x273e6e, 0x32436d,
                             0x3b496c, 0x434e6c, 0x4b546c, 0x52596d, 0x5a5f6e, 0x61656f, 0x686a71,
                             0x6f7073, 0x757676, 0x7c7b78, 0x848179, 0x8b8778, 0x938d78, 0x9b9376,
                             0xa39a75, 0xaba072, 0xb3a670, 0xbbad6c, 0xc3b469, 0xccba64, 0xd4c15f,
                             0xddc958, 0xe6d051, 0xefd748, 0xf8df3c, 0xfee838};
constexpr Samples turbo = {0x30123b, 0x392a73, 0x4040a1, 0x4456c7, 0x466be3, 0x467ff6, 0x4293ff,
                           0x37a7fa, 0x29bbec, 0x1dcdd8, 0x18dcc3, 0x1ee8b0, 0x31f299, 0x4cf97e,
                           0x6bfd64, 0x8aff4d, 0xa3fd3c, 0xb8f735, 0xcced34, 0xdee037, 0xedd03a,
                           0xf8c03a, 0xfdae35, 0xfe982c, 0xfb8022, 0xf56817, 0xec520f, 0xe04009,
                           0xd23105, 0xc02302, 0xac1701, 0x950d01, 0x7a0403};
constexpr Samples coolwarm = {0x3b4cc0, 0x445acc, 0x4d68d7, 0x5775e1, 0x6282ea, 0x6c8ef1, 0x779af7,
                              0x82a5fb, 0x8db0fe, 0x98b9ff, 0xa3c2fe, 0xaec9fc, 0xb8d0f9, 0xc2d5f4,
                              0xccd9ee, 0xd5dbe6, 0xdddddd, 0xe5d8d1, 0xecd3c5, 0xf1ccb9, 0xf4c4ad,
                              0xf7bba0, 0xf7b194, 0xf7a687, 0xf49a7b, 0xf18d6f, 0xec7f63, 0xe57058,
                              0xde604d, 0xd55042, 0xcb3e38, 0xc0282f, 0xb40426};

std::vector<ColourPin> from_samples(const Samples& samples) {
    std::vector<ColourPin> pins;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const auto channel = [&](int shift) { return ((samples[i] >> shift) & 0xff) / 255.0; };
        pins.push_back({static_cast<double>(i) / static_cast<double>(samples.size() - 1),
                        {channel(16), channel(8), channel(0)}});
    }
    return pins;
}

// Green 2011 (arXiv:1108.5083), with its default start, rotations, hue and gamma: brightness rises
// steadily while the hue turns.
std::vector<ColourPin> cubehelix() {
    constexpr double start = 0.5, rotations = -1.5, hue = 1;
    constexpr int steps = 32;
    std::vector<ColourPin> pins;
    for (int i = 0; i <= steps; ++i) {
        const double level = static_cast<double>(i) / steps;
        const double angle = 2 * std::numbers::pi * (start / 3 + 1 + rotations * level);
        const double amplitude = hue * level * (1 - level) / 2;
        const auto channel = [&](double cosine, double sine) {
            const double v = level + amplitude * (cosine * std::cos(angle) + sine * std::sin(angle));
            return std::clamp(v, 0.0, 1.0);
        };
        pins.push_back(
            {level, {channel(-0.14861, 1.78277), channel(-0.29227, -0.90649), channel(1.97294, 0.0)}});
    }
    return pins;
}

// The four that DS9 calls so; its channels bend at places of their own, here all put together.
std::vector<ColourPin> grey() {
    return {{0, {0, 0, 0}}, {1, {1, 1, 1}}};
}
std::vector<ColourPin> heat() {
    return {{0, {0, 0, 0}}, {0.34, {1, 0.34, 0}}, {0.65, {1, 0.65, 0}}, {0.98, {1, 0.98, 1}}, {1, {1, 1, 1}}};
}
std::vector<ColourPin> cool() {
    const auto red = [](double s) {
        return s < 0.29 ? 0 : s < 0.76 ? (s - 0.29) / 4.7 : 0.1 + (s - 0.76) / 0.24 * 0.9;
    };
    const auto green = [](double s) { return std::clamp((s - 0.22) / 0.74, 0.0, 1.0); };
    const auto blue = [](double s) { return std::min(s / 0.53, 1.0); };
    std::vector<ColourPin> pins;
    for (const double s : {0.0, 0.22, 0.29, 0.53, 0.76, 0.96, 1.0}) {
        pins.push_back({s, {red(s), green(s), blue(s)}});
    }
    return pins;
}
std::vector<ColourPin> rainbow() {
    return {{0, {1, 0, 1}},   {0.2, {0, 0, 1}}, {0.4, {0, 1, 1}},
            {0.6, {0, 1, 0}}, {0.8, {1, 1, 0}}, {1, {1, 0, 0}}};
}

struct NamedMap {
    std::string_view name;
    std::vector<ColourPin> (*pins)();
};
constexpr std::array<NamedMap, 12> maps = {{
    {"viridis", [] { return from_samples(viridis); }},
    {"inferno", [] { return from_samples(inferno); }},
    {"magma", [] { return from_samples(magma); }},
    {"plasma", [] { return from_samples(plasma); }},
    {"cividis", [] { return from_samples(cividis); }},
    {"turbo", [] { return from_samples(turbo); }},
    {"cubehelix", cubehelix},
    {"grey", grey},
    {"heat", heat},
    {"cool", cool},
    {"rainbow", rainbow},
    {"coolwarm", [] { return from_samples(coolwarm); }},
}};

std::vector<ColourPin> reversed(std::vector<ColourPin> pins) {
    std::reverse(pins.begin(), pins.end());
    for (ColourPin& pin : pins) {
        pin.at = 1 - pin.at;
    }
    return pins;
}

std::string all_names() {
    std::string names;
    for (const NamedMap& map : maps) {
        names += (names.empty() ? "" : " ") + std::string(map.name);
    }
    return names;
}

}  // namespace

std::vector<std::string> colour_map_names() {
    std::vector<std::string> names;
    names.reserve(maps.size());
    for (const NamedMap& map : maps) {
        names.emplace_back(map.name);
    }
    return names;
}

base::Result<std::vector<ColourPin>> colour_map(std::string_view name) {
    const bool backwards = name.ends_with("-r");
    const std::string_view plain = backwards ? name.substr(0, name.size() - 2) : name;
    const auto found =
        std::find_if(maps.begin(), maps.end(), [&](const NamedMap& map) { return map.name == plain; });
    if (found == maps.end()) {
        return base::error(base::Code::not_found, "find colour map",
                           "no colour map \"" + base::printable(name, 40) + "\"; there are " + all_names() +
                               ", reversed with -r");
    }
    return backwards ? reversed(found->pins()) : found->pins();
}

std::string colour_map_name(const std::vector<ColourPin>& pins) {
    for (const NamedMap& map : maps) {
        const std::vector<ColourPin> these = map.pins();
        if (these == pins) {
            return std::string(map.name);
        }
        if (reversed(these) == pins) {
            return std::string(map.name) + "-r";
        }
    }
    return {};
}

}  // namespace shearwater::view
