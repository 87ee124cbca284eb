#pragma once
// Reading TOML documents that people write and programs keep: what is found wrong first is told with the
// line it is on.

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace shearwater::document {

// Errors: too_large, beyond so many bytes; corrupt, not TOML. `operation` is what they say was done.
base::Result<toml::table> parse(std::string_view text, const std::string& operation, std::size_t most_bytes);

// Takes values out of tables. Each function goes on after a fault, with a value of no meaning: fault() is
// to be asked at the end.
class Reader {
  public:
    // Empty where all is well.
    const std::string& fault() const { return fault_; }
    void fail(std::string what);
    void fail(const toml::node& at, std::string_view what);

    void only_keys(const toml::table& table, std::string_view where,
                   std::initializer_list<std::string_view> known);

    // What has to be there. Numbers are finite.
    const toml::table& section(const toml::table& root, std::string_view key);
    double number(const toml::table& table, std::string_view key);
    template <std::size_t N>
    std::array<double, N> numbers(const toml::table& table, std::string_view key);
    std::int64_t whole(const toml::table& table, std::string_view key);  // not below 0, at most 1e9
    std::string text(const toml::table& table, std::string_view key);
    // The place of the text among such words.
    std::size_t one_of(const toml::table& table, std::string_view key,
                       std::span<const std::string_view> words);

    // What may be missing.
    double number_or(const toml::table& table, std::string_view key, double otherwise) {
        return table.contains(key) ? number(table, key) : otherwise;
    }
    // Calls `use` with each table of [[key]], up to the first fault.
    template <class Use>
    void each_table(const toml::table& root, std::string_view key, std::size_t most, const Use& use);

    // Says that a key is missing, or that it should be something else.
    void wrong(const toml::table& table, std::string_view key, std::string_view wanted);

  private:
    void read_numbers(const toml::table& table, std::string_view key, std::span<double> values);
    // Null where there is none of that key, or something else than tables, or more than so many.
    const toml::array* tables(const toml::table& root, std::string_view key, std::size_t most);

    std::string fault_;
    toml::table nothing_;
};

template <std::size_t N>
std::array<double, N> Reader::numbers(const toml::table& table, std::string_view key) {
    std::array<double, N> values{};
    read_numbers(table, key, values);
    return values;
}

template <class Use>
void Reader::each_table(const toml::table& root, std::string_view key, std::size_t most, const Use& use) {
    if (const toml::array* const all = tables(root, key, most)) {
        for (const toml::node& each : *all) {
            if (fault_.empty()) {
                use(*each.as_table());
            }
        }
    }
}

}  // namespace shearwater::document
