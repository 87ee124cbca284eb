#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/document/number_text.h"
#include "common/document/reader.h"
#include "common/view/transfer_function_table.h"

namespace shearwater::view {

namespace {

using document::number_text;

// A file longer than this is no transfer function of at most max_pins pins.
constexpr std::size_t longest_text = std::size_t{1} << 20;

// Reads one function's table.
class FunctionReader {
  public:
    AnchoredFunction read(const toml::table& root) {
        reader_.only_keys(root, "the transfer function",
                          {"colourmap", "colour", "opacity", "background", "density", "scale"});
        AnchoredFunction function;
        TransferFunction& tf = function.tf;
        function.unit = unit(root);
        function.own_colours = root.contains("colour");
        tf.colour_pins = colours(root);
        reader_.each_table(root, "opacity", TransferFunction::max_pins,
                           [&](const toml::table& table) { tf.opacity_pins.push_back(pin(table)); });
        if (root.contains("background")) {
            tf.background = rgb(root, "background");
        }
        tf.density = reader_.number_or(root, "density", tf.density);
        return function;
    }

    const std::string& fault() const { return reader_.fault(); }

  private:
    Unit unit(const toml::table& root) {
        if (!root.contains("scale")) {
            return Unit::stretched;
        }
        const toml::table& table = reader_.section(root, "scale");
        reader_.only_keys(table, "the scale", {"unit"});
        const auto unit = unit_named(reader_.text(table, "unit"));
        if (!unit) {
            reader_.wrong(table, "unit", "stretched, value, percentile or sigma");
        }
        return unit.value_or(Unit::stretched);
    }

    std::vector<ColourPin> colours(const toml::table& root) {
        std::vector<ColourPin> pins;
        reader_.each_table(root, "colour", TransferFunction::max_pins, [&](const toml::table& table) {
            reader_.only_keys(table, "a colour pin", {"at", "rgb"});
            pins.push_back({reader_.number(table, "at"), rgb(table, "rgb")});
        });
        if (!root.contains("colourmap")) {
            return pins.empty() ? colour_map("inferno").value() : pins;
        }
        if (!pins.empty()) {
            reader_.fail("give a colourmap or colour pins, not both");
            return {};
        }
        auto named = colour_map(reader_.text(root, "colourmap"));
        if (!named) {
            reader_.fail(named.error().detail);
            return {};
        }
        return std::move(named.value());
    }

    OpacityPin pin(const toml::table& table) {
        const auto number = [&](std::string_view key) { return reader_.number(table, key); };
        const std::string kind = reader_.text(table, "kind");
        if (kind == "ramp") {
            reader_.only_keys(table, "a ramp", {"kind", "x0", "a0", "x1", "a1"});
            return Ramp{number("x0"), number("a0"), number("x1"), number("a1")};
        }
        if (kind == "hat") {
            reader_.only_keys(table, "a hat", {"kind", "centre", "top", "base", "height", "lean"});
            return Hat{number("centre"), number("top"), number("base"), number("height"),
                       reader_.number_or(table, "lean", 0)};
        }
        if (kind == "flat") {
            reader_.only_keys(table, "a flat", {"kind", "height"});
            return Flat{number("height")};
        }
        if (kind == "blank") {
            reader_.only_keys(table, "a blank", {"kind", "lo", "hi"});
            return Blank{number("lo"), number("hi")};
        }
        reader_.fail(table, fmt::format("unknown kind \"{}\" (known: ramp, hat, flat, blank)",
                                        base::printable(kind, 40)));
        return Flat{};
    }

    Rgb rgb(const toml::table& table, std::string_view key) {
        const auto triple = reader_.numbers<3>(table, key);
        if (std::ranges::any_of(triple, [](double channel) { return !(channel >= 0 && channel <= 255); })) {
            reader_.wrong(table, key, "3 numbers, 0 to 255");
        }
        return {triple[0] / 255, triple[1] / 255, triple[2] / 255};
    }

    document::Reader reader_;
};

// A channel's byte where it is one, else what gives the same channel when divided by 255.
std::string channel_text(double channel) {
    const double whole = std::round(channel * 255);
    return whole / 255 == channel ? fmt::format("{}", static_cast<int>(whole)) : number_text(channel * 255);
}

std::string rgb_text(const Rgb& rgb) {
    return fmt::format("[{}, {}, {}]", channel_text(rgb.r), channel_text(rgb.g), channel_text(rgb.b));
}

std::string pin_text(const Ramp& p) {
    return fmt::format("kind = \"ramp\"\nx0 = {}\na0 = {}\nx1 = {}\na1 = {}\n", number_text(p.x0),
                       number_text(p.a0), number_text(p.x1), number_text(p.a1));
}
std::string pin_text(const Hat& p) {
    return fmt::format("kind = \"hat\"\ncentre = {}\ntop = {}\nbase = {}\nheight = {}\n",
                       number_text(p.centre), number_text(p.top), number_text(p.base),
                       number_text(p.height)) +
           (p.lean != 0 ? fmt::format("lean = {}\n", number_text(p.lean)) : "");
}
std::string pin_text(const Flat& p) {
    return fmt::format("kind = \"flat\"\nheight = {}\n", number_text(p.height));
}
std::string pin_text(const Blank& p) {
    return fmt::format("kind = \"blank\"\nlo = {}\nhi = {}\n", number_text(p.lo), number_text(p.hi));
}

}  // namespace

base::Result<AnchoredFunction> transfer_function_from_toml(std::string_view text, std::string_view source) {
    const std::string operation = fmt::format("read transfer function {}", source);
    const auto root = document::parse(text, operation, longest_text);
    if (!root) {
        return root.error();
    }
    return transfer_function_from_table(*root, operation);
}

base::Result<AnchoredFunction> transfer_function_from_table(const toml::table& table,
                                                            const std::string& operation) {
    FunctionReader reader;
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
        out += fmt::format("density = {}\n", number_text(tf.density));
    }
    if (function.unit != Unit::stretched) {
        out += fmt::format("\n[{}scale]\nunit = \"{}\"\n", in, name(function.unit));
    }
    if (!named) {
        for (const ColourPin& pin : tf.colour_pins) {
            out += fmt::format("\n[[{}colour]]\nat = {}\nrgb = {}\n", in, number_text(pin.at),
                               rgb_text(pin.rgb));
        }
    }
    for (const OpacityPin& pin : tf.opacity_pins) {
        out +=
            fmt::format("\n[[{}opacity]]\n", in) + std::visit([](const auto& p) { return pin_text(p); }, pin);
    }
    return within.empty() ? out : fmt::format("[{}]\n", within) + out;
}

}  // namespace shearwater::view
