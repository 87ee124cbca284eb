#include "common/document/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shearwater::document {

base::Result<toml::table> parse(std::string_view text, const std::string& operation, std::size_t most_bytes) {
    if (text.size() > most_bytes) {
        return base::error(base::Code::too_large, operation, fmt::format("more than {} bytes", most_bytes));
    }
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& fault) {
        return base::error(base::Code::corrupt, operation,
                           fmt::format("line {}: {}", fault.source().begin.line, fault.description()));
    }
}

void Reader::fail(std::string what) {
    if (fault_.empty()) {
        fault_ = std::move(what);
    }
}

void Reader::fail(const toml::node& at, std::string_view what) {
    fail(fmt::format("line {}: {}", at.source().begin.line, what));
}

void Reader::wrong(const toml::table& table, std::string_view key, std::string_view wanted) {
    if (const toml::node* const node = table.get(key)) {
        fail(*node, fmt::format("{} should be {}", key, wanted));
    } else {
        fail(table, fmt::format("{} is missing; it should be {}", key, wanted));
    }
}

void Reader::only_keys(const toml::table& table, std::string_view where,
                       std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : table) {
        if (std::ranges::find(known, key.str()) == known.end()) {
            fail(fmt::format("line {}: unknown key \"{}\" in {}", key.source().begin.line,
                             base::printable(key.str(), 40), where));
        }
    }
}

const toml::table& Reader::section(const toml::table& root, std::string_view key) {
    const toml::node* const node = root.get(key);
    if (node == nullptr || !node->is_table()) {
        fail(fmt::format("the section [{}] is missing", key));
        return nothing_;
    }
    return *node->as_table();
}

double Reader::number(const toml::table& table, std::string_view key) {
    const toml::node* const node = table.get(key);
    const double value = node != nullptr && node->is_number() ? node->value<double>().value_or(NAN) : NAN;
    if (!std::isfinite(value)) {
        wrong(table, key, "a number");
        return 0;
    }
    return value;
}

void Reader::read_numbers(const toml::table& table, std::string_view key, std::span<double> values) {
    const toml::node* const node = table.get(key);
    const toml::array* const array = node != nullptr ? node->as_array() : nullptr;
    bool fine = array != nullptr && array->size() == values.size();
    for (std::size_t i = 0; fine && i < values.size(); ++i) {
        const toml::node& value = *array->get(i);
        values[i] = value.is_number() ? value.value<double>().value_or(NAN) : NAN;
        fine = std::isfinite(values[i]);
    }
    if (!fine) {
        wrong(table, key, fmt::format("{} numbers", values.size()));
        std::ranges::fill(values, 0);
    }
}

std::int64_t Reader::whole(const toml::table& table, std::string_view key) {
    const toml::node* const node = table.get(key);
    const auto value = node != nullptr ? node->value_exact<std::int64_t>() : std::nullopt;
    if (!value || *value < 0 || *value > 1'000'000'000) {
        wrong(table, key, "a whole number, not below 0");
        return 0;
    }
    return *value;
}

std::string Reader::text(const toml::table& table, std::string_view key) {
    const auto text = table[key].value_exact<std::string>();
    if (!text) {
        wrong(table, key, "text");
    }
    return text.value_or("");
}

std::size_t Reader::one_of(const toml::table& table, std::string_view key,
                           std::span<const std::string_view> words) {
    const auto word = table[key].value_exact<std::string>();
    const auto found = word ? std::ranges::find(words, *word) : words.end();
    if (found == words.end()) {
        wrong(table, key,
              fmt::format("one of {}{}", fmt::join(words, ", "),
                          word ? fmt::format(", not \"{}\"", base::printable(*word, 40)) : ""));
        return 0;
    }
    return static_cast<std::size_t>(found - words.begin());
}

const toml::array* Reader::tables(const toml::table& root, std::string_view key, std::size_t most) {
    const toml::node* const node = root.get(key);
    if (node == nullptr) {
        return nullptr;
    }
    const toml::array* const all = node->as_array();
    if (all == nullptr || !(all->empty() || all->is_array_of_tables())) {
        fail(*node, fmt::format("write each {} as [[{}]]", key, key));
        return nullptr;
    }
    if (all->size() > most) {
        fail(*node, fmt::format("more than {} of [[{}]]", most, key));
        return nullptr;
    }
    return all;
}

}  // namespace shearwater::document
