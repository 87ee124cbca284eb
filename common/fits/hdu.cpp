#include "common/fits/hdu.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

namespace shearwater::fits {

namespace {

using base::Code;

constexpr int most_axes = 999;
constexpr std::array<std::int64_t, 6> bitpixes = {8, 16, 32, 64, -32, -64};

std::string where(int number) {
    return number == 0 ? "" : "HDU " + std::to_string(number) + ": ";
}

base::Error corrupt(const std::string& operation, int number, const std::string& detail) {
    return base::error(Code::corrupt, operation, where(number) + detail);
}

std::string as_written(const std::optional<std::int64_t>& value) {
    return value ? " is " + std::to_string(*value) : " is missing or not an integer";
}

// `prefix` is "Z" for what a compressed image was before.
base::Result<int> read_bitpix(const Hdu& hdu, const std::string& prefix, const std::string& operation) {
    const auto value = hdu.header.integer(prefix + "BITPIX");
    if (!value || std::find(bitpixes.begin(), bitpixes.end(), *value) == bitpixes.end()) {
        return corrupt(operation, hdu.number,
                       prefix + "BITPIX" + as_written(value) + "; FITS has 8, 16, 32, 64, -32 and -64");
    }
    return static_cast<int>(*value);
}

base::Result<std::vector<std::int64_t>> read_axes(const Hdu& hdu, const std::string& prefix,
                                                  const std::string& operation) {
    const auto count = hdu.header.integer(prefix + "NAXIS");
    if (!count || *count < 0 || *count > most_axes) {
        return corrupt(operation, hdu.number, prefix + "NAXIS" + as_written(count));
    }
    std::vector<std::int64_t> axes;
    for (int axis = 1; axis <= *count; ++axis) {
        const auto length = hdu.header.integer(prefix + "NAXIS", axis);
        if (!length || *length < 0) {
            return corrupt(operation, hdu.number,
                           prefix + "NAXIS" + std::to_string(axis) + as_written(length));
        }
        axes.push_back(*length);
    }
    return axes;
}

HduKind kind_of(const Header& header, int number, const std::vector<std::int64_t>& axes) {
    const std::string extension = header.text("XTENSION").value_or("");
    if (number == 0 || extension == "IMAGE") {
        const bool groups = header.logical("GROUPS").value_or(false) && !axes.empty() && axes[0] == 0;
        return groups ? HduKind::random_groups : HduKind::image;
    }
    if (extension == "BINTABLE") {
        return header.logical("ZIMAGE").value_or(false) ? HduKind::compressed_image : HduKind::table;
    }
    return extension == "TABLE" ? HduKind::table : HduKind::other;
}

// |BITPIX|/8 * GCOUNT * (PCOUNT + NAXIS1 * NAXIS2 * ...), unset where that does not fit in 63 bits.
std::optional<std::int64_t> claimed_bytes(const Hdu& hdu, int bitpix, const std::vector<std::int64_t>& axes) {
    if (axes.empty()) {
        return 0;
    }
    const std::int64_t parameters = std::max<std::int64_t>(0, hdu.header.integer("PCOUNT").value_or(0));
    const std::int64_t groups = std::max<std::int64_t>(0, hdu.header.integer("GCOUNT").value_or(1));
    const std::size_t first = hdu.kind == HduKind::random_groups ? 1 : 0;
    if (std::find(axes.begin() + static_cast<std::ptrdiff_t>(first), axes.end(), 0) != axes.end() &&
        parameters == 0) {
        return 0;
    }
    std::int64_t bytes = 1;
    for (std::size_t i = first; i < axes.size(); ++i) {
        if (__builtin_mul_overflow(bytes, axes[i], &bytes)) {
            return std::nullopt;
        }
    }
    if (__builtin_add_overflow(bytes, parameters, &bytes) || __builtin_mul_overflow(bytes, groups, &bytes) ||
        __builtin_mul_overflow(bytes, std::int64_t{std::abs(bitpix) / 8}, &bytes) ||
        bytes > std::numeric_limits<std::int64_t>::max() / 2) {
        return std::nullopt;
    }
    return bytes;
}

// The number of a scaling keyword, repaired where it is none.
double scaling(const Header& header, const char* keyword, double usual, std::vector<std::string>& notes) {
    const auto value = header.real(keyword);
    if (!value && header.has(keyword)) {
        notes.push_back(std::string(keyword) + " is not a number and is ignored");
    }
    return value.value_or(usual);
}

bool begins_extension(const Bytes& bytes, std::int64_t offset) {
    constexpr std::string_view start = "XTENSION=";
    std::array<char, start.size()> found{};
    return bytes.read(offset, found) && std::string_view(found.data(), found.size()) == start;
}

}  // namespace

int Hdu::long_axes() const {
    if (std::find(axes.begin(), axes.end(), 0) != axes.end()) {
        return 0;
    }
    return static_cast<int>(std::count_if(axes.begin(), axes.end(), [](std::int64_t n) { return n > 1; }));
}

std::string Hdu::shape() const {
    std::string text;
    for (const std::int64_t length : axes) {
        text += (text.empty() ? "" : " x ") + std::to_string(length);
    }
    return text.empty() ? "nothing" : text;
}

base::Result<std::optional<Hdu>> read_hdu(const Bytes& bytes, std::int64_t offset, int number,
                                          const std::string& operation) {
    if (offset >= bytes.size() || (number > 0 && !begins_extension(bytes, offset))) {
        return std::optional<Hdu>();
    }
    auto header = Header::read(bytes, offset, operation);
    if (!header) {
        return header.error();
    }
    Hdu hdu{.number = number, .header = std::move(*header)};
    const auto bitpix = read_bitpix(hdu, "", operation);
    if (!bitpix) {
        return bitpix.error();
    }
    auto axes = read_axes(hdu, "", operation);
    if (!axes) {
        return axes.error();
    }
    hdu.kind = kind_of(hdu.header, number, *axes);
    const auto data = claimed_bytes(hdu, *bitpix, *axes);
    hdu.bitpix = *bitpix;
    hdu.axes = std::move(*axes);
    if (!data) {
        return corrupt(operation, number, "its " + hdu.shape() + " values are more than any file can hold");
    }
    hdu.data_bytes = *data;
    hdu.next_offset = hdu.header.data_offset() + (*data + block_bytes - 1) / block_bytes * block_bytes;
    return std::optional<Hdu>(std::move(hdu));
}

base::Status check_present(const Hdu& hdu, const Bytes& bytes, const std::string& operation) {
    const std::int64_t present = std::max<std::int64_t>(0, bytes.size() - hdu.header.data_offset());
    if (present >= hdu.data_bytes) {
        return {};
    }
    return corrupt(operation, hdu.number,
                   "the file is cut off: " + std::to_string(hdu.data_bytes - present) + " of " +
                       std::to_string(hdu.data_bytes) + " data bytes are missing");
}

base::Result<Encoding> read_encoding(const Hdu& hdu, const std::string& operation,
                                     std::vector<std::string>& notes) {
    for (const std::string& keyword : hdu.header.contradicted()) {
        if (hdu.kind == HduKind::image && (keyword == "BITPIX" || keyword.starts_with("NAXIS"))) {
            return corrupt(operation, hdu.number, "the header gives more than one shape");
        }
    }
    Encoding encoding{.bitpix = hdu.bitpix};
    encoding.scale = scaling(hdu.header, "BSCALE", 1, notes);
    encoding.zero = scaling(hdu.header, "BZERO", 0, notes);
    if (encoding.scale == 0) {
        notes.push_back("BSCALE is 0: every value is BZERO");
    }
    if (hdu.bitpix > 0) {
        encoding.blank = hdu.header.integer("BLANK");
    } else if (hdu.header.has("BLANK")) {
        notes.push_back("BLANK has no meaning among floating-point values and is ignored");
    }
    return encoding;
}

}  // namespace shearwater::fits
