#include <fmt/core.h>
#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "common/view/transfer_function_table.h"

namespace shearwater::view {

namespace {

// A file longer than this is no transfer function of at most max_pins pins.
constexpr std::size_t longest_text = std::size_t{1} << 20;

// Reads one document and keeps the first thing found wrong with it.
class Reader {
  public:
    AnchoredFunction read(const toml::table& root) {
        only_keys(root, "the transfer function",
                  {"colourmap", "colour", "opacity", "background", "density", "scale"});
        AnchoredFunction function;
        TransferFunction& tf = function.tf;
        function.unit = unit(root);
        function.own_colours = root.get("colour") != nullptr;
        tf.colour_pins = colours(root);
        each_table(root, "opacity", [&](const toml::table& table) { tf.opacity_pins.push_back(pin(table)); });
        if (const toml::node* node = root.get("background")) {
            tf.background = rgb(*node, "background");
        }
        if (root.get("density") != nullptr) {
            tf.density = number(root, "density");
        }
        return function;
    }

    const std::string& fault() const { return fault_; }

  private:
    void fail(std::string what) {
        if (fault_.empty()) {
            fault_ = std::move(what);
        }
    }

    void only_keys(const toml::table& table, std::string_view where,
                   std::initializer_list<std::string_view> known) {
        for (const auto& [key, value] : table) {
            if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
                fail(fmt::format("line {}: unknown key \"{}\" in {}", key.source().begin.line,
                                 base::printable(key.str(), 40), where));
            }
        }
    }

    // Calls `use` with each table of [[key]], stopping at the first fault and before too many.
    template <class Use>
    void each_table(const toml::table& root, std::string_view key, const Use& use) {
        const toml::node* node = root.get(key);
        if (node == nullptr) {
            return;
        }
        const toml::array* tables = node->as_array();
        if (tables == nullptr || !(tables->empty() || tables->is_array_of_tables())) {
            return fail(fmt::format("line {}: write {} pins as [[{}]]", node->source().begin.line, key, key));
        }
        if (tables->size() > TransferFunction::max_pins) {
            return fail(fmt::format("more than {} {} pins", TransferFunction::max_pins, key));
        }
        for (const toml::node& table : *tables) {
            if (fault_.empty()) {
                use(*table.as_table());
            }
        }
    }

    Unit unit(const toml::table& root) {
        const toml::node* node = root.get("scale");
        if (node == nullptr) {
            return Unit::stretched;
        }
        const toml::table* table = node->as_table();
        if (table == nullptr) {
            fail(fmt::format("line {}: write the scale as [scale]", node->source().begin.line));
            return Unit::stretched;
        }
        only_keys(*table, "the scale", {"unit"});
        const auto text = (*table)["unit"].value_exact<std::string>();
        const auto unit = text ? unit_named(*text) : std::nullopt;
        if (!unit) {
            fail(fmt::format("line {}: unit must be stretched, value, percentile or sigma",
                             table->source().begin.line));
        }
        return unit.value_or(Unit::stretched);
    }

    std::vector<ColourPin> colours(const toml::table& root) {
        std::vector<ColourPin> pins;
        each_table(root, "colour", [&](const toml::table& table) {
            only_keys(table, "a colour pin", {"at", "rgb"});
            const toml::node* triple = table.get("rgb");
            pins.push_back({number(table, "at"), triple != nullptr ? rgb(*triple, "rgb") : Rgb{}});
            if (triple == nullptr) {
                missing(table, "rgb");
            }
        });
        const toml::node* name = root.get("colourmap");
        if (name == nullptr && pins.empty()) {
            return colour_map("inferno").value();
        }
        return name != nullptr ? named_map(*name, !pins.empty()) : pins;
    }

    std::vector<ColourPin> named_map(const toml::node& node, bool has_pins) {
        if (has_pins) {
            fail("give a colourmap or colour pins, not both");
            return {};
        }
        const auto name = node.value_exact<std::string>();
        if (!name) {
            fail(fmt::format("line {}: colourmap must be a name", node.source().begin.line));
            return {};
        }
        auto pins = colour_map(*name);
        if (!pins) {
            fail(pins.error().detail);
            return {};
        }
        return std::move(pins.value());
    }

    OpacityPin pin(const toml::table& table) {
        const auto kind = table["kind"].value_exact<std::string>();
        if (!kind) {
            missing(table, "kind");
            return Flat{};
        }
        if (*kind == "ramp") {
            only_keys(table, "a ramp", {"kind", "x0", "a0", "x1", "a1"});
            return Ramp{number(table, "x0"), number(table, "a0"), number(table, "x1"), number(table, "a1")};
        }
        if (*kind == "hat") {
            only_keys(table, "a hat", {"kind", "centre", "top", "base", "height", "lean"});
            return Hat{number(table, "centre"), number(table, "top"), number(table, "base"),
                       number(table, "height"), table.get("lean") != nullptr ? number(table, "lean") : 0};
        }
        if (*kind == "flat") {
            only_keys(table, "a flat", {"kind", "height"});
            return Flat{number(table, "height")};
        }
        if (*kind == "blank") {
            only_keys(table, "a blank", {"kind", "lo", "hi"});
            return Blank{number(table, "lo"), number(table, "hi")};
        }
        fail(fmt::format("line {}: unknown kind \"{}\" (known: ramp, hat, flat, blank)",
                         table.source().begin.line, base::printable(*kind, 40)));
        return Flat{};
    }

    void missing(const toml::table& table, std::string_view key) {
        fail(fmt::format("line {}: {} is missing or not what it should be", table.source().begin.line, key));
    }

    double number(const toml::table& table, std::string_view key) {
        const toml::node* node = table.get(key);
        if (node == nullptr || !node->is_number()) {
            missing(table, key);
            return 0;
        }
        const double value = node->value<double>().value_or(0);
        if (!std::isfinite(value)) {
            missing(table, key);
        }
        return value;
    }

    Rgb rgb(const toml::node& node, std::string_view key) {
        const toml::array* triple = node.as_array();
        if (triple == nullptr || triple->size() != 3) {
            fail(fmt::format("line {}: {} must be three numbers, 0 to 255", node.source().begin.line, key));
            return {};
        }
        const auto channel = [&](std::size_t i) {
            const toml::node& value = *triple->get(i);
            const double v = value.is_number() ? value.value<double>().value_or(-1) : -1;
            if (!(v >= 0 && v <= 255)) {
                fail(fmt::format("line {}: {} must be three numbers, 0 to 255", node.source().begin.line,
                                 key));
            }
            return v / 255;
        };
        return {channel(0), channel(1), channel(2)};
    }

    std::string fault_;
};

// The shortest text that reads back as the same number.
std::string text(double value) {
    std::string digits = fmt::format("{}", value);
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

// A channel's byte where it is one, else what gives the same channel when divided by 255.
std::string channel_text(double channel) {
    const double whole = std::round(channel * 255);
    return whole / 255 == channel ? fmt::format("{}", static_cast<int>(whole)) : text(channel * 255);
}

std::string rgb_text(const Rgb& rgb) {
    return fmt::format("[{}, {}, {}]", channel_text(rgb.r), channel_text(rgb.g), channel_text(rgb.b));
}

std::string pin_text(const Ramp& p) {
    return fmt::format("kind = \"ramp\"\nx0 = {}\na0 = {}\nx1 = {}\na1 = {}\n", text(p.x0), text(p.a0),
                       text(p.x1), text(p.a1));
}
std::string pin_text(const Hat& p) {
    return fmt::format("kind = \"hat\"\ncentre = {}\ntop = {}\nbase = {}\nheight = {}\n", text(p.centre),
                       text(p.top), text(p.base), text(p.height)) +
           (p.lean != 0 ? fmt::format("lean = {}\n", text(p.lean)) : "");
}
std::string pin_text(const Flat& p) {
    return fmt::format("kind = \"flat\"\nheight = {}\n", text(p.height));
}
std::string pin_text(const Blank& p) {
    return fmt::format("kind = \"blank\"\nlo = {}\nhi = {}\n", text(p.lo), text(p.hi));
}

}  // namespace

base::Result<AnchoredFunction> transfer_function_from_toml(std::string_view text, std::string_view source) {
    const std::string operation = fmt::format("read transfer function {}", source);
    if (text.size() > longest_text) {
        return base::error(base::Code::too_large, operation, "more than 1 MiB");
    }
    toml::table root;
    try {
        root = toml::parse(text);
    } catch (const toml::parse_error& fault) {
        return base::error(base::Code::corrupt, operation,
                           fmt::format("line {}: {}", fault.source().begin.line, fault.description()));
    }
    return transfer_function_from_table(root, operation);
}

base::Result<AnchoredFunction> transfer_function_from_table(const toml::table& table,
                                                            const std::string& operation) {
    Reader reader;
    AnchoredFunction function = reader.read(table);
    if (!reader.fault().empty()) {
        return base::error(base::Code::invalid_argument, operation, reader.fault());
    }
    if (function.unit == Unit::stretched) {  // else when it is put on a scale
        if (const auto valid = validate(function.tf); !valid) {
            return base::error(base::Code::invalid_argument, operation, valid.error().detail);
        }
    }
    return function;
}

std::string to_toml(const AnchoredFunction& function, const std::string& within) {
    const std::string in = within.empty() ? "" : within + ".";
    const TransferFunction& tf = function.tf;
    const std::string map = colour_map_name(tf.colour_pins);
    const bool named = !map.empty() && (function.unit == Unit::stretched || !function.own_colours);
    std::string out = named ? fmt::format("colourmap = \"{}\"\n", map) : "";
    if (tf.background != Rgb{}) {
        out += fmt::format("background = {}\n", rgb_text(tf.background));
    }
    if (tf.density != 1) {
        out += fmt::format("density = {}\n", text(tf.density));
    }
    if (function.unit != Unit::stretched) {
        out += fmt::format("\n[{}scale]\nunit = \"{}\"\n", in, name(function.unit));
    }
    if (!named) {
        for (const ColourPin& pin : tf.colour_pins) {
            out += fmt::format("\n[[{}colour]]\nat = {}\nrgb = {}\n", in, text(pin.at), rgb_text(pin.rgb));
        }
    }
    for (const OpacityPin& pin : tf.opacity_pins) {
        out +=
            fmt::format("\n[[{}opacity]]\n", in) + std::visit([](const auto& p) { return pin_text(p); }, pin);
    }
    return within.empty() ? out : fmt::format("[{}]\n", within) + out;
}

}  // namespace shearwater::view
