#include "client/model/recent.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "common/document/reader.h"

namespace shearwater::model {

namespace {

constexpr std::int64_t version = 1;
constexpr std::size_t longest_text = std::size_t{1} << 20;

std::string escaped(std::string_view bytes) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string out;
    for (const char c : bytes) {
        if (c >= ' ' && c <= '~' && c != '%' && c != '"' && c != '\\') {
            out += c;
        } else {
            const auto byte = static_cast<unsigned char>(c);
            out += {'%', digits[byte >> 4], digits[byte & 15]};
        }
    }
    return out;
}

// Nothing where it is not as escaped() writes it.
std::optional<std::string> unescaped(std::string_view text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned byte = static_cast<unsigned char>(text[i]);
        if (text[i] == '%') {
            const char* const from = text.data() + std::min(i + 1, text.size());
            const char* const to = text.data() + std::min(i + 3, text.size());
            const auto [end, failed] = std::from_chars(from, to, byte, 16);
            if (failed != std::errc{} || end != from + 2) {
                return std::nullopt;
            }
            i += 2;
        }
        if (byte == 0) {
            return std::nullopt;
        }
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

std::optional<Recent> recent_from(const toml::table& table) {
    Recent recent;
    for (const auto& [key, value] : table) {
        std::string* const member = key == "name"          ? &recent.name
                                    : key == "secret_file" ? &recent.secret_file
                                                           : nullptr;
        const auto text = value.value_exact<std::string>();
        const auto bytes = text ? unescaped(*text) : std::nullopt;
        if (member == nullptr || !bytes || bytes->size() > RecentList::longest) {
            return std::nullopt;
        }
        *member = *bytes;
    }
    return recent.name.empty() ? std::nullopt : std::optional(recent);
}

}  // namespace

void RecentList::add(Recent recent) {
    if (recent.name.empty() || recent.name.size() > longest || recent.secret_file.size() > longest) {
        return;
    }
    remove(recent.name);
    all_.insert(all_.begin(), std::move(recent));
    all_.resize(std::min(all_.size(), most));
}

void RecentList::remove(std::string_view name) {
    std::erase_if(all_, [&](const Recent& each) { return each.name == name; });
}

// The count stands last: of a text that is cut short something is always missing.
std::string to_toml(const RecentList& list) {
    std::string out =
        "# Where Shearwater's window has been, the last place first. %XX is a byte.\nversion = " +
        std::to_string(version) + "\n";
    for (const Recent& each : list.all()) {
        out += "\n[[recent]]\nname = \"" + escaped(each.name) + "\"\n";
        if (!each.secret_file.empty()) {
            out += "secret_file = \"" + escaped(each.secret_file) + "\"\n";
        }
    }
    return out + "\n[end]\ncount = \"" + std::to_string(list.all().size()) + "\"\n";
}

base::Result<RecentList> recent_from_toml(std::string_view text, const std::string& source) {
    const std::string operation = "read the recent connections in " + base::printable(source);
    const auto refuse = [&](const std::string& what) {
        return base::error(base::Code::corrupt, operation, what);
    };
    const auto parsed = document::parse(text, operation, longest_text);
    if (!parsed) {
        return parsed.error();
    }
    const toml::table& root = *parsed;
    if (root["version"].value_exact<std::int64_t>() != version) {
        return refuse("it is no list of connections that is known here");
    }
    std::vector<Recent> found;
    if (const toml::node* const node = root.get("recent")) {
        const toml::array* const tables = node->as_array();
        if (tables == nullptr) {
            return refuse("\"recent\" should be tables");
        }
        for (const toml::node& each : *tables) {
            const auto recent = each.is_table() ? recent_from(*each.as_table()) : std::nullopt;
            if (!recent) {
                return refuse("line " + std::to_string(each.source().begin.line) + ": not a connection");
            }
            found.push_back(*recent);
        }
    }
    if (root["end"]["count"].value_exact<std::string>() != std::to_string(found.size())) {
        return refuse("it has been cut short");
    }
    RecentList list;
    std::for_each(found.rbegin(), found.rend(), [&](const Recent& each) { list.add(each); });
    return list;
}

}  // namespace shearwater::model
