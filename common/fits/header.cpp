#include "common/fits/header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace shearwater::fits {

namespace {

constexpr std::int64_t longest_header = std::int64_t{32} << 20;

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

bool is_end(std::string_view card) {
    return card.starts_with("END") && trimmed(card.substr(3)).empty();
}

}  // namespace

base::Result<Header> Header::read(const Bytes& bytes, std::int64_t offset, const std::string& operation) {
    Header header;
    std::array<char, block_bytes> block{};
    for (std::int64_t at = offset;; at += block_bytes) {
        const std::int64_t present = std::min(block_bytes, bytes.size() - at);
        if (present <= 0 || at - offset >= longest_header) {
            return base::error(base::Code::corrupt, operation,
                               "the header has no END: the file is cut off in it");
        }
        if (!bytes.read(at, std::span(block).first(static_cast<std::size_t>(present)))) {
            return base::error(base::Code::io, operation, "the header cannot be read");
        }
        const std::string_view cards(block.data(), static_cast<std::size_t>(present));
        for (std::size_t first = 0; first + card_bytes <= cards.size(); first += card_bytes) {
            const std::string_view card = cards.substr(first, card_bytes);
            if (is_end(card)) {
                header.data_offset_ = at + block_bytes;
                return header;
            }
            header.add(card);
        }
    }
}

void Header::add(std::string_view card) {
    if (card.substr(8, 2) != "= ") {
        return;
    }
    const std::string_view name = card.substr(0, 8);
    const std::string keyword(name.substr(0, name.find_last_not_of(' ') + 1));
    const auto [known, is_new] = values_.try_emplace(keyword, card.substr(10));
    if (!is_new && known->second != card.substr(10)) {
        contradicted_.push_back(keyword);
    }
}

// The value without its comment, for all but strings.
std::optional<std::string_view> Header::bare(std::string_view keyword) const {
    const auto found = values_.find(keyword);
    if (found == values_.end()) {
        return std::nullopt;
    }
    const std::string_view field = found->second;
    return trimmed(field.substr(0, field.find('/')));
}

std::optional<std::int64_t> Header::integer(std::string_view keyword) const {
    std::string_view digits = bare(keyword).value_or("");
    if (digits.starts_with('+')) {
        digits.remove_prefix(1);
    }
    std::int64_t value = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc{} || end != digits.data() + digits.size()) {
        return std::nullopt;
    }
    return value;
}

std::optional<double> Header::real(std::string_view keyword) const {
    std::string digits(bare(keyword).value_or(""));
    std::replace(digits.begin(), digits.end(), 'D', 'E');
    const std::size_t sign = digits.starts_with('+') ? 1 : 0;
    double value = 0;
    const char* const last = digits.data() + digits.size();
    const auto [end, fault] = std::from_chars(digits.data() + sign, last, value);
    if (fault != std::errc{} || end != last || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

std::optional<bool> Header::logical(std::string_view keyword) const {
    const std::string_view value = bare(keyword).value_or("");
    if (value != "T" && value != "F") {
        return std::nullopt;
    }
    return value == "T";
}

std::optional<std::string> Header::text(std::string_view keyword) const {
    const auto found = values_.find(keyword);
    if (found == values_.end()) {
        return std::nullopt;
    }
    const std::string_view field = trimmed(found->second);
    if (!field.starts_with('\'')) {
        return std::nullopt;
    }
    std::string value;
    for (std::size_t i = 1; i < field.size(); ++i) {
        if (field[i] == '\'') {
            if (i + 1 == field.size() || field[i + 1] != '\'') {
                break;
            }
            ++i;  // a doubled quote stands for one
        }
        value += field[i];
    }
    value.erase(value.find_last_not_of(' ') + 1);
    return value;
}

std::optional<std::int64_t> Header::integer(std::string_view stem, int number) const {
    return integer(std::string(stem) + std::to_string(number));
}

std::optional<std::string> Header::text(std::string_view stem, int number) const {
    return text(std::string(stem) + std::to_string(number));
}

}  // namespace shearwater::fits
