#include "common/flight/path_toml.h"

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <sstream>

#include "common/base/text_file.h"
#include "common/options/drawing_options.h"
#include "common/view/transfer_function_table.h"

namespace shearwater::flight {

namespace {

constexpr std::size_t longest_text = std::size_t{4} << 20;

std::string beside(const std::string& folder, const std::string& path) {
    return std::filesystem::path(path).is_absolute() ? path : (std::filesystem::path(folder) / path).string();
}

// Reads one document and keeps the first thing found wrong with it.
class Reader {
  public:
    explicit Reader(std::string folder) : folder_(std::move(folder)) {}

    Path read(const toml::table& root) {
        only_keys(root, "the flight path", {"fps", "cube", "key"});
        Path path;
        whole(root, "fps", path.fps);
        each_table(root, "cube", Path::max_cubes,
                   [&](const toml::table& table) { path.cubes.push_back(cube(table)); });
        Key key;
        each_table(root, "key", Path::max_keys, [&](const toml::table& table) {
            read_key(table, key);
            path.keys.push_back(key);
        });
        return path;
    }

    const std::string& fault() const { return fault_; }

  private:
    void fail(std::string what) {
        if (fault_.empty()) {
            fault_ = std::move(what);
        }
    }
    void fail(const toml::node& at, const std::string& what) {
        fail(fmt::format("line {}: {}", at.source().begin.line, what));
    }

    void only_keys(const toml::table& table, std::string_view where,
                   std::initializer_list<std::string_view> known) {
        for (const auto& [key, value] : table) {
            if (std::ranges::find(known, key.str()) == known.end()) {
                fail(fmt::format("line {}: unknown key \"{}\" in {}", key.source().begin.line,
                                 base::printable(key.str(), 40), where));
            }
        }
    }

    template <class Use>
    void each_table(const toml::table& root, std::string_view key, std::size_t most, const Use& use) {
        const toml::node* node = root.get(key);
        if (node == nullptr) {
            return;
        }
        const toml::array* tables = node->as_array();
        if (tables == nullptr || !(tables->empty() || tables->is_array_of_tables())) {
            return fail(*node, fmt::format("write each as [[{}]]", key));
        }
        if (tables->size() > most) {
            return fail(*node, fmt::format("more than {} of [[{}]]", most, key));
        }
        for (const toml::node& table : *tables) {
            if (fault_.empty()) {
                use(*table.as_table());
            }
        }
    }

    void number(const toml::table& table, std::string_view key, double& value) {
        if (const toml::node* node = table.get(key)) {
            if (!node->is_number()) {
                return fail(*node, fmt::format("{} must be a number", key));
            }
            value = node->value<double>().value_or(value);
        }
    }

    template <class Whole>
    void whole(const toml::table& table, std::string_view key, Whole& value) {
        if (const toml::node* node = table.get(key)) {
            const auto read = node->value_exact<std::int64_t>();
            if (!read || *read < 0 || *read > 1'000'000'000) {
                return fail(*node, fmt::format("{} must be a whole number, not below 0", key));
            }
            value = static_cast<Whole>(*read);
        }
    }

    std::vector<double> numbers(const toml::node& node, std::string_view key, std::size_t count) {
        std::vector<double> values;
        if (const toml::array* array = node.as_array()) {
            for (const toml::node& value : *array) {
                if (value.is_number()) {
                    values.push_back(value.value<double>().value_or(0));
                }
            }
            if (values.size() == count && array->size() == count) {
                return values;
            }
        }
        fail(node, fmt::format("{} must be {} numbers", key, count));
        return std::vector<double>(count, 0);
    }

    std::string word(const toml::node& node, std::string_view key,
                     std::initializer_list<std::string_view> known = {}) {
        const auto text = node.value_exact<std::string>();
        if (!text || text->empty()) {
            fail(node, fmt::format("{} must be text", key));
        } else if (known.size() > 0 && std::ranges::find(known, *text) == known.end()) {
            fail(node, fmt::format("{} cannot be \"{}\"", key, base::printable(*text, 40)));
        }
        return text.value_or("");
    }

    options::CubeOptions cube(const toml::table& table) {
        only_keys(table, "a cube",
                  {"path", "hdu", "plane", "range", "percentile", "stretch", "bits", "spacing"});
        options::CubeOptions made;
        if (const toml::node* node = table.get("path")) {
            made.path = word(*node, "path");
            if (!made.path.starts_with("synthetic:")) {
                made.path = beside(folder_, made.path);
            }
        } else {
            fail(table, "a cube needs its path");
        }
        if (table.contains("hdu")) {
            whole(table, "hdu", made.hdu.emplace());
        }
        if (table.contains("plane")) {
            whole(table, "plane", made.plane.emplace());
        }
        if (const toml::node* node = table.get("range")) {
            made.range = numbers(*node, "range", 2);
        }
        number(table, "percentile", made.percentile);
        if (!(made.percentile >= 1 && made.percentile <= 100)) {
            fail(table, "the percentile must lie between 1 and 100");
        }
        if (const toml::node* node = table.get("stretch")) {
            made.stretch = word(*node, "stretch", {"linear", "sqrt", "log", "asinh"});
        }
        whole(table, "bits", made.bits);
        if (made.bits != 8 && made.bits != 16) {
            fail(table, "bits must be 8 or 16");
        }
        if (const toml::node* node = table.get("spacing")) {
            made.spacing = numbers(*node, "spacing", 3);
        }
        if (const auto valid = made.validate(); !valid) {
            fail(table, valid.error().detail);
        }
        return made;
    }

    void read_key(const toml::table& table, Key& key) {
        only_keys(table, "a key",
                  {"time", "cube", "azimuth", "elevation", "roll", "distance", "target", "projection", "fov",
                   "limits", "stretch", "tf"});
        if (!table.contains("time")) {
            fail(table, "a key needs its time");
        }
        number(table, "time", key.time);
        if (const toml::node* node = table.get("cube")) {
            std::size_t from_one = 0;
            whole(table, "cube", from_one);
            if (from_one == 0) {
                fail(*node, "cubes are numbered from 1");
            }
            if (from_one - 1 != key.cube) {
                key.scaling.reset();
            }
            key.cube = from_one - 1;
        }
        read_scaling(table, key);
        view::Viewpoint& viewpoint = key.viewpoint;
        number(table, "azimuth", viewpoint.orbit.azimuth);
        number(table, "elevation", viewpoint.orbit.elevation);
        number(table, "roll", viewpoint.orbit.roll);
        number(table, "distance", viewpoint.orbit.distance);
        number(table, "fov", viewpoint.fov);
        if (const toml::node* node = table.get("target")) {
            const auto at = numbers(*node, "target", 3);
            viewpoint.orbit.target = {at[0], at[1], at[2]};
        }
        if (const toml::node* node = table.get("projection")) {
            viewpoint.projection = word(*node, "projection", {"perspective", "parallel"}) == "parallel"
                                       ? view::Projection::parallel
                                       : view::Projection::perspective;
        }
        if (const toml::node* node = table.get("tf")) {
            read_tf(*node, key.tf);
        }
    }

    void read_scaling(const toml::table& table, Key& key) {
        if (const toml::node* node = table.get("limits")) {
            const auto limits = numbers(*node, "limits", 2);
            key.scaling = {limits[0], limits[1], key.scaling.value_or(volume::Scaling{}).stretch};
        }
        if (const toml::node* node = table.get("stretch")) {
            if (!key.scaling) {
                return fail(*node, "a stretch needs limits");
            }
            const std::string name = word(*node, "stretch");
            const auto stretch = volume::stretch_named(name);
            if (!stretch) {
                return fail(*node, fmt::format("stretch cannot be \"{}\"", base::printable(name, 40)));
            }
            key.scaling->stretch = *stretch;
        }
    }

    void read_tf(const toml::node& node, view::TransferFunction& tf) {
        base::Result<view::AnchoredFunction> read = view::AnchoredFunction{};
        if (const toml::table* table = node.as_table()) {
            read = view::transfer_function_from_table(*table, "");
        } else if (std::string file = word(node, "tf"); !file.empty()) {
            read = options::read_transfer_function(beside(folder_, file));
        }
        if (!read) {
            fail(node, fmt::format("tf: {}", read.error().detail));
        } else if (read->unit != view::Unit::stretched) {
            fail(node, "tf: a flight's transfer functions are placed by stretched values");
        } else {
            tf = std::move(read->tf);
        }
    }

    std::string folder_;
    std::string fault_;
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
    const bool parallel = viewpoint.projection == view::Projection::parallel;
    toml::table table{{"time", key.time},
                      {"cube", static_cast<std::int64_t>(key.cube + 1)},
                      {"azimuth", orbit.azimuth},
                      {"elevation", orbit.elevation},
                      {"roll", orbit.roll},
                      {"distance", orbit.distance},
                      {"target", toml::array{orbit.target.x, orbit.target.y, orbit.target.z}},
                      {"projection", parallel ? "parallel" : "perspective"},
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
    toml::table root;
    try {
        root = toml::parse(text);
    } catch (const toml::parse_error& fault) {
        return base::error(base::Code::corrupt, operation,
                           fmt::format("line {}: {}", fault.source().begin.line, fault.description()));
    }
    Reader reader(folder);
    Path path = reader.read(root);
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
