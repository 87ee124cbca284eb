#include "common/flight/path_toml.h"

#include <fmt/core.h>

#include <filesystem>
#include <sstream>

#include "common/base/text_file.h"
#include "common/document/reader.h"
#include "common/options/drawing_options.h"
#include "common/view/transfer_function_table.h"

namespace shearwater::flight {

namespace {

constexpr std::size_t longest_text = std::size_t{4} << 20;

std::string beside(const std::string& folder, const std::string& path) {
    return std::filesystem::path(path).is_absolute() ? path : (std::filesystem::path(folder) / path).string();
}

// Reads one path.
class PathReader {
  public:
    explicit PathReader(std::string folder) : folder_(std::move(folder)) {}

    Path read(const toml::table& root) {
        reader_.only_keys(root, "the flight path", {"fps", "cube", "key"});
        Path path;
        if (root.contains("fps")) {
            path.fps = static_cast<int>(reader_.whole(root, "fps"));
        }
        reader_.each_table(root, "cube", Path::max_cubes,
                           [&](const toml::table& table) { path.cubes.push_back(cube(table)); });
        Key key;
        reader_.each_table(root, "key", Path::max_keys, [&](const toml::table& table) {
            read_key(table, key);
            path.keys.push_back(key);
        });
        return path;
    }

    const std::string& fault() const { return reader_.fault(); }

  private:
    options::CubeOptions cube(const toml::table& table) {
        reader_.only_keys(table, "a cube",
                          {"path", "hdu", "plane", "range", "percentile", "stretch", "bits", "spacing"});
        options::CubeOptions made;
        made.path = reader_.text(table, "path");
        if (made.path.empty()) {
            reader_.fail(table, "a cube needs its path");
        } else if (!made.path.starts_with("synthetic:")) {
            made.path = beside(folder_, made.path);
        }
        if (table.contains("hdu")) {
            made.hdu = static_cast<int>(reader_.whole(table, "hdu"));
        }
        if (table.contains("plane")) {
            made.plane = reader_.whole(table, "plane");
        }
        if (table.contains("range")) {
            const auto range = reader_.numbers<2>(table, "range");
            made.range.assign(range.begin(), range.end());
        }
        made.percentile = reader_.number_or(table, "percentile", made.percentile);
        if (!(made.percentile >= 1 && made.percentile <= 100)) {
            reader_.wrong(table, "percentile", "between 1 and 100");
        }
        if (table.contains("stretch")) {
            made.stretch = volume::stretch_names[reader_.one_of(table, "stretch", volume::stretch_names)];
        }
        if (table.contains("bits")) {
            made.bits = static_cast<int>(reader_.whole(table, "bits"));
        }
        if (made.bits != 8 && made.bits != 16) {
            reader_.wrong(table, "bits", "8 or 16");
        }
        if (table.contains("spacing")) {
            const auto spacing = reader_.numbers<3>(table, "spacing");
            made.spacing.assign(spacing.begin(), spacing.end());
        }
        if (const auto valid = made.validate(); !valid) {
            reader_.fail(table, valid.error().detail);
        }
        return made;
    }

    // What it does not say stays as the key before has it.
    void read_key(const toml::table& table, Key& key) {
        reader_.only_keys(table, "a key",
                          {"time", "cube", "azimuth", "elevation", "roll", "distance", "target", "projection",
                           "fov", "limits", "stretch", "tf"});
        key.time = reader_.number(table, "time");
        if (table.contains("cube")) {
            const auto from_one = static_cast<std::size_t>(reader_.whole(table, "cube"));
            if (from_one == 0) {
                reader_.wrong(table, "cube", "a number from 1 on");
            }
            if (from_one - 1 != key.cube) {
                key.scaling.reset();
            }
            key.cube = from_one - 1;
        }
        read_scaling(table, key);
        view::Viewpoint& viewpoint = key.viewpoint;
        const auto may_change = [&](std::string_view name, double& value) {
            value = reader_.number_or(table, name, value);
        };
        may_change("azimuth", viewpoint.orbit.azimuth);
        may_change("elevation", viewpoint.orbit.elevation);
        may_change("roll", viewpoint.orbit.roll);
        may_change("distance", viewpoint.orbit.distance);
        may_change("fov", viewpoint.fov);
        if (table.contains("target")) {
            const auto at = reader_.numbers<3>(table, "target");
            viewpoint.orbit.target = {at[0], at[1], at[2]};
        }
        if (table.contains("projection")) {
            viewpoint.projection =
                static_cast<view::Projection>(reader_.one_of(table, "projection", view::projection_names));
        }
        if (const toml::node* node = table.get("tf")) {
            read_tf(*node, table, key.tf);
        }
    }

    void read_scaling(const toml::table& table, Key& key) {
        if (table.contains("limits")) {
            const auto limits = reader_.numbers<2>(table, "limits");
            key.scaling = {limits[0], limits[1], key.scaling.value_or(volume::Scaling{}).stretch};
        }
        if (const toml::node* node = table.get("stretch")) {
            if (!key.scaling) {
                return reader_.fail(*node, "a stretch needs limits");
            }
            key.scaling->stretch =
                static_cast<volume::Stretch>(reader_.one_of(table, "stretch", volume::stretch_names));
        }
    }

    void read_tf(const toml::node& node, const toml::table& table, view::TransferFunction& tf) {
        const toml::table* const pins = node.as_table();
        const std::string file = pins == nullptr ? reader_.text(table, "tf") : std::string();
        if (!fault().empty()) {
            return;
        }
        auto read = pins != nullptr ? view::transfer_function_from_table(*pins, "")
                                    : options::read_transfer_function(beside(folder_, file));
        if (!read) {
            reader_.fail(node, fmt::format("tf: {}", read.error().detail));
        } else if (read->unit != view::Unit::stretched) {
            reader_.fail(node, "tf: a flight's transfer functions are placed by stretched values");
        } else {
            tf = std::move(read->tf);
        }
    }

    std::string folder_;
    document::Reader reader_;
};

toml::table table_of(const options::CubeOptions& cube) {
    toml::table table{
        {"path", cube.path}, {"percentile", cube.percentile}, {"stretch", cube.stretch}, {"bits", cube.bits}};
    if (cube.hdu) {
        table.insert("hdu", *cube.hdu);
    }
    if (cube.plane) {
        table.insert("plane", *cube.plane);
    }
    if (cube.range.size() == 2) {
        table.insert("range", toml::array{cube.range[0], cube.range[1]});
    }
    if (cube.spacing.size() == 3) {
        table.insert("spacing", toml::array{cube.spacing[0], cube.spacing[1], cube.spacing[2]});
    }
    return table;
}

toml::table table_of(const Key& key) {
    const view::Viewpoint& viewpoint = key.viewpoint;
    const view::Orbit& orbit = viewpoint.orbit;
    toml::table table{{"time", key.time},
                      {"cube", static_cast<std::int64_t>(key.cube + 1)},
                      {"azimuth", orbit.azimuth},
                      {"elevation", orbit.elevation},
                      {"roll", orbit.roll},
                      {"distance", orbit.distance},
                      {"target", toml::array{orbit.target.x, orbit.target.y, orbit.target.z}},
                      {"projection", view::projection_names[static_cast<std::size_t>(viewpoint.projection)]},
                      {"fov", viewpoint.fov},
                      {"tf", toml::parse(view::to_toml({.tf = key.tf}))}};
    if (key.scaling) {
        table.insert("limits", toml::array{key.scaling->lo, key.scaling->hi});
        table.insert("stretch", std::string(volume::name(key.scaling->stretch)));
    }
    return table;
}

}  // namespace

base::Result<Path> path_from_toml(std::string_view text, const std::string& source,
                                  const std::string& folder) {
    const std::string operation = fmt::format("read flight path {}", source);
    const auto root = document::parse(text, operation, longest_text);
    if (!root) {
        return root.error();
    }
    PathReader reader(folder);
    Path path = reader.read(*root);
    if (!reader.fault().empty()) {
        return base::error(base::Code::invalid_argument, operation, reader.fault());
    }
    if (const auto valid = validate(path); !valid) {
        return base::error(base::Code::invalid_argument, operation,
                           fmt::format("{}: {}", valid.error().operation, valid.error().detail));
    }
    return path;
}

base::Result<Path> read_path(const std::string& file) {
    const auto text = base::read_text_file(file, longest_text);
    if (!text) {
        return text.error();
    }
    return path_from_toml(*text, file, std::filesystem::path(file).parent_path().string());
}

std::string to_toml(const Path& path) {
    toml::table root{{"fps", path.fps}};
    toml::array cubes, keys;
    for (const options::CubeOptions& cube : path.cubes) {
        cubes.push_back(table_of(cube));
    }
    for (const Key& key : path.keys) {
        keys.push_back(table_of(key));
    }
    if (!cubes.empty()) {
        root.insert("cube", std::move(cubes));
    }
    root.insert("key", std::move(keys));
    std::ostringstream text;
    text << root << "\n";
    return text.str();
}

}  // namespace shearwater::flight
