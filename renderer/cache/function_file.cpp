#include "renderer/cache/function_file.h"

#include <bit>
#include <type_traits>
#include <variant>

namespace shearwater::cache {

namespace {

constexpr std::string_view magic = "SWOF";
constexpr std::size_t checksum_bytes = 8;

template <class Number>
void put(std::string& to, Number number) {
    if constexpr (std::is_same_v<Number, double>) {
        put(to, std::bit_cast<std::uint64_t>(number));
    } else {
        auto rest = static_cast<std::uint64_t>(number);
        for (std::size_t byte = 0; byte < sizeof(Number); ++byte, rest >>= 8) {
            to += static_cast<char>(rest & 255);
        }
    }
}

void put(std::string& to, const view::OpacityPin& pin) {
    put(to, static_cast<std::uint32_t>(pin.index()));
    const auto all = [&](auto... numbers) { (put(to, numbers), ...); };
    if (const auto* ramp = std::get_if<view::Ramp>(&pin)) {
        all(ramp->x0, ramp->a0, ramp->x1, ramp->a1);
    } else if (const auto* hat = std::get_if<view::Hat>(&pin)) {
        all(hat->centre, hat->top, hat->base, hat->height);
    } else if (const auto* flat = std::get_if<view::Flat>(&pin)) {
        all(flat->height);
    } else if (const auto* blank = std::get_if<view::Blank>(&pin)) {
        all(blank->lo, blank->hi);
    }
}

std::string head_of(std::string_view name, std::size_t codes) {
    std::string head(magic);
    put(head, version);
    put(head, std::uint64_t{name.size()});
    head += name;
    put(head, std::uint64_t{codes});
    return head;
}

}  // namespace

std::string name_of(const Content& content) {
    std::string name;
    const auto all = [&](auto... numbers) { (put(name, numbers), ...); };
    all(std::uint64_t{content.origin.path.size()});
    name += content.origin.path;
    all(content.origin.bytes, content.origin.modified, content.origin.hdu, content.origin.plane);
    for (std::size_t a = 0; a < 3; ++a) {
        all(content.n[a], content.box.lo[a], content.box.hi[a]);
    }
    const volume::Mapping& mapping = content.mapping;
    all(mapping.lo, mapping.hi, static_cast<std::uint32_t>(mapping.stretch), mapping.bits);
    const culling::FunctionKey& key = content.key;
    all(content.block_edge, content.side, static_cast<std::uint32_t>(key.footprint), key.level);
    put(name, key.basis.shape);
    all(std::uint64_t{key.basis.blanks.size()});
    for (const view::Blank& blank : key.basis.blanks) {
        all(blank.lo, blank.hi);
    }
    return name;
}

// Fowler, Noll and Vo's, 64 bits, the second way (FNV-1a).
std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t sum = 0xcbf29ce484222325;
    for (const char byte : bytes) {
        sum = (sum ^ static_cast<std::uint8_t>(byte)) * 0x100000001b3;
    }
    return sum;
}

std::size_t file_size(std::string_view name, std::size_t codes) {
    return head_of(name, codes).size() + codes + checksum_bytes;
}

std::string file_of(std::string_view name, const culling::FunctionTable& table) {
    std::string file = head_of(name, table.codes.size());
    file.append(table.codes.begin(), table.codes.end());
    put(file, checksum(file));
    return file;
}

std::optional<std::vector<std::uint8_t>> codes_from(std::string_view file, std::string_view name,
                                                    std::size_t codes) {
    const std::string head = head_of(name, codes);
    if (file.size() != head.size() + codes + checksum_bytes || !file.starts_with(head)) {
        return std::nullopt;
    }
    std::string sum;
    put(sum, checksum(file.substr(0, file.size() - checksum_bytes)));
    if (!file.ends_with(sum)) {
        return std::nullopt;
    }
    const std::string_view body = file.substr(head.size(), codes);
    return std::vector<std::uint8_t>(body.begin(), body.end());
}

}  // namespace shearwater::cache
