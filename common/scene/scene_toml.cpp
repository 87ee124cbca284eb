#include <fmt/format.h>

#include <array>

#include "common/document/number_text.h"
#include "common/document/reader.h"
#include "common/scene/scene.h"
#include "common/view/transfer_function_table.h"

namespace shearwater::scene {

namespace {

using document::number_text;

constexpr std::size_t longest_text = std::size_t{1} << 20;
constexpr int version = 1;

constexpr std::array<std::string_view, 2> classifications{"post", "pre-integrated"};
constexpr std::array<std::string_view, 4> qualities{"auto", "draft", "normal", "high"};
constexpr std::array<std::string_view, 2> swaps{"no", "yes"};
constexpr std::array<std::string_view, 3> levels{"server", "on", "off"};

void read_camera(document::Reader& reader, const toml::table& table, Scene& scene) {
    reader.only_keys(table, "[camera]",
                     {"azimuth", "elevation", "roll", "distance", "target", "fov", "size", "projection"});
    view::Orbit& orbit = scene.viewpoint.orbit;
    orbit.azimuth = reader.number(table, "azimuth");
    orbit.elevation = reader.number(table, "elevation");
    orbit.roll = reader.number(table, "roll");
    orbit.distance = reader.number(table, "distance");
    const auto target = reader.numbers<3>(table, "target");
    orbit.target = {target[0], target[1], target[2]};
    scene.viewpoint.fov = reader.number(table, "fov");
    const auto size = reader.numbers<2>(table, "size");
    const auto pixels = [&](double side) {  // out of range stays out of range
        return side >= 1 && side <= 1e6 ? static_cast<int>(side) : 0;
    };
    scene.size = {pixels(size[0]), pixels(size[1])};
    scene.viewpoint.projection =
        static_cast<view::Projection>(reader.one_of(table, "projection", view::projection_names));
}

void read_drawing(document::Reader& reader, const toml::table& table, Scene& scene) {
    reader.only_keys(
        table, "[drawing]",
        {"quality", "target_rate", "classify", "level_of_detail", "culling", "culling_threshold"});
    const std::size_t quality = reader.one_of(table, "quality", qualities);
    if (quality > 0) {
        scene.quality = static_cast<view::Quality>(quality - 1);
    }
    scene.target_rate = reader.number(table, "target_rate");
    scene.classify = static_cast<view::Classify>(reader.one_of(table, "classify", classifications));
    const std::size_t level = reader.one_of(table, "level_of_detail", levels);
    if (level > 0) {
        scene.level_of_detail = level == 1;
    }
    scene.culling.kind = static_cast<culling::Kind>(reader.one_of(table, "culling", culling::kind_names));
    scene.culling.threshold = reader.number(table, "culling_threshold");
}

void read_crop(document::Reader& reader, const toml::table& table, Scene& scene) {
    reader.only_keys(table, "[crop]", {"first", "last"});
    const auto first = reader.numbers<3>(table, "first");
    const auto last = reader.numbers<3>(table, "last");
    volume::Box& box = scene.crop.emplace();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto plane = [](double voxel) {  // out of range stays out of range
            return voxel >= 0 && voxel <= 1e9 ? static_cast<std::int64_t>(voxel) : std::int64_t{-1};
        };
        box.lo[axis] = plane(first[axis]);
        box.hi[axis] = plane(last[axis]);
    }
}

void read_values(document::Reader& reader, const toml::table& table, Scene& scene) {
    reader.only_keys(table, "[values]", {"limits", "stretch"});
    const auto limits = reader.numbers<2>(table, "limits");
    const auto stretch = reader.one_of(table, "stretch", volume::stretch_names);
    scene.scaling = {limits[0], limits[1], static_cast<volume::Stretch>(stretch)};
}

void read_stereo(document::Reader& reader, const toml::table& table, Scene& scene) {
    reader.only_keys(table, "[stereo]", {"mode", "separation", "convergence", "swap"});
    Pair& pair = scene.stereo.emplace();
    pair.mode = static_cast<image::StereoMode>(reader.one_of(table, "mode", image::stereo_mode_names));
    pair.eyes.separation = reader.number(table, "separation");
    pair.eyes.convergence = reader.number(table, "convergence");
    pair.eyes.swap = reader.one_of(table, "swap", swaps) == 1;
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : base::printable(text, 200)) {
        out += c == '"' || c == '\\' ? std::string{'\\', c} : std::string{c};
    }
    return out + "\"";
}

}  // namespace

base::Result<Scene> scene_from_toml(std::string_view text, std::string_view source) {
    const std::string operation = fmt::format("read session {}", source);
    const auto parsed = document::parse(text, operation, longest_text);
    if (!parsed) {
        return parsed.error();
    }
    const toml::table& root = *parsed;
    const auto refuse = [&](std::string what) {
        return base::error(base::Code::invalid_argument, operation, std::move(what));
    };
    const auto written = root["version"].value_exact<std::int64_t>();
    if (!written) {
        return refuse("it has no version, and is no session");
    }
    if (*written != version) {
        return refuse(fmt::format("it is of version {}, and {} is known", *written, version));
    }
    document::Reader reader;
    reader.only_keys(
        root, "the session",
        {"version", "cube", "drawing", "values", "crop", "stereo", "transfer_function", "camera"});
    Scene scene;
    scene.cube = reader.text(root, "cube");
    read_drawing(reader, reader.section(root, "drawing"), scene);
    if (root.contains("values")) {
        read_values(reader, reader.section(root, "values"), scene);
    }
    if (root.contains("crop")) {
        read_crop(reader, reader.section(root, "crop"), scene);
    }
    if (root.contains("stereo")) {
        read_stereo(reader, reader.section(root, "stereo"), scene);
    }
    read_camera(reader, reader.section(root, "camera"), scene);
    const toml::table& pins = reader.section(root, "transfer_function");
    if (!reader.fault().empty()) {
        return refuse(reader.fault());
    }
    auto tf = view::transfer_function_from_table(pins, operation);
    if (!tf) {
        return tf.error();
    }
    if (tf->unit != view::Unit::stretched) {
        return refuse("its transfer function is placed by other than stretched values");
    }
    scene.tf = std::move(tf->tf);
    if (const auto valid = validate(scene); !valid) {
        return refuse(valid.error().detail);
    }
    return scene;
}

// The projection stands last, in quotes: of a text that is cut short something is always missing.
std::string to_toml(const Scene& scene) {
    const view::Orbit& orbit = scene.viewpoint.orbit;
    const std::size_t quality = scene.quality ? static_cast<std::size_t>(*scene.quality) + 1 : 0;
    const std::size_t level = scene.level_of_detail ? (*scene.level_of_detail ? 1 : 2) : 0;
    std::string out = fmt::format("# A session of Shearwater's window.\nversion = {}\ncube = {}\n", version,
                                  quoted(scene.cube));
    out += fmt::format(
        "\n[drawing]\nquality = \"{}\"\ntarget_rate = {}\nclassify = \"{}\"\nlevel_of_detail = \"{}\"\n"
        "culling = \"{}\"\nculling_threshold = {}\n",
        qualities[quality], number_text(scene.target_rate),
        classifications[static_cast<std::size_t>(scene.classify)], levels[level],
        culling::kind_names[static_cast<std::size_t>(scene.culling.kind)],
        number_text(scene.culling.threshold));
    if (scene.scaling) {
        out +=
            fmt::format("\n[values]\nlimits = [{}, {}]\nstretch = \"{}\"\n", number_text(scene.scaling->lo),
                        number_text(scene.scaling->hi), volume::name(scene.scaling->stretch));
    }
    if (scene.crop) {
        const auto& [lo, hi] = *scene.crop;
        out += fmt::format("\n[crop]\nfirst = [{}]\nlast = [{}]\n", fmt::join(lo, ", "), fmt::join(hi, ", "));
    }
    if (scene.stereo) {
        const view::StereoSettings& eyes = scene.stereo->eyes;
        out += fmt::format(
            "\n[stereo]\nmode = \"{}\"\nseparation = {}  # 0: a thirtieth of the convergence\n"
            "convergence = {}  # 0: as far as the target\nswap = \"{}\"\n",
            image::stereo_mode_names[static_cast<std::size_t>(scene.stereo->mode)],
            number_text(eyes.separation), number_text(eyes.convergence), swaps[eyes.swap ? 1 : 0]);
    }
    out += "\n" + view::to_toml({.tf = scene.tf}, "transfer_function");
    out += fmt::format(
        "\n[camera]\nazimuth = {}\nelevation = {}\nroll = {}\ndistance = {}  # 0: all of the cube is seen\n"
        "target = [{}, {}, {}]\nfov = {}\nsize = [{}, {}]\nprojection = \"{}\"\n",
        number_text(orbit.azimuth), number_text(orbit.elevation), number_text(orbit.roll),
        number_text(orbit.distance), number_text(orbit.target.x), number_text(orbit.target.y),
        number_text(orbit.target.z), number_text(scene.viewpoint.fov), scene.size.width, scene.size.height,
        view::projection_names[static_cast<std::size_t>(scene.viewpoint.projection)]);
    return out;
}

}  // namespace shearwater::scene
