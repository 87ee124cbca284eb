#pragma once
// One FITS header as keywords and values. It is read here, before cfitsio sees it, so that what it
// claims is judged first; cfitsio then unpacks compressed pixels.

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"
#include "common/fits/bytes.h"

namespace shearwater::fits {

constexpr std::int64_t block_bytes = 2880;
constexpr std::int64_t card_bytes = 80;

class Header {
  public:
    // The header that begins at `offset`. An error where there is no END card before the file ends,
    // or within 32 MiB.
    static base::Result<Header> read(const Bytes& bytes, std::int64_t offset, const std::string& operation);

    // Where the data that belong to it begin.
    std::int64_t data_offset() const { return data_offset_; }

    // Values by keyword; the first of several cards with the same keyword counts. Unset where the
    // keyword is missing or its value is of another type.
    bool has(std::string_view keyword) const { return values_.contains(keyword); }
    std::optional<std::int64_t> integer(std::string_view keyword) const;
    std::optional<double> real(std::string_view keyword) const;  // integers too
    std::optional<bool> logical(std::string_view keyword) const;
    // As written, without quotes and trailing blanks: print it through base::printable only.
    std::optional<std::string> text(std::string_view keyword) const;

    // Keywords that stand on several cards with different values.
    const std::vector<std::string>& contradicted() const { return contradicted_; }

    std::optional<std::int64_t> integer(std::string_view stem, int number) const;
    std::optional<std::string> text(std::string_view stem, int number) const;

  private:
    void add(std::string_view card);
    std::optional<std::string_view> bare(std::string_view keyword) const;

    std::map<std::string, std::string, std::less<>> values_;  // the value field of the card
    std::vector<std::string> contradicted_;
    std::int64_t data_offset_ = 0;
};

}  // namespace shearwater::fits
