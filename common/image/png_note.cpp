#include "common/image/png_note.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>

#include "common/base/check.h"
#include "common/image/file.h"
#include "common/image/png.h"

namespace shearwater::image {

namespace {

constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t header_chunk = 8 + 13 + 4;
// Keyword, not compressed, no language and no translation of the keyword.
constexpr std::string_view begins{"Shearwater\0\0\0\0\0", 15};
constexpr std::string_view type = "iTXt";

void append_word(std::vector<std::uint8_t>& to, std::uint32_t word) {
    for (const int shift : {24, 16, 8, 0}) {
        to.push_back(static_cast<std::uint8_t>(word >> shift));
    }
}

std::uint32_t word_at(const std::uint8_t* at) {
    return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 | at[3];
}

std::uint32_t checksum(std::string_view text) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
}

bool read_exactly(std::FILE* file, void* to, std::size_t bytes) {
    return std::fread(to, 1, bytes, file) == bytes;
}

bool begins_as_png(std::FILE* file) {
    std::array<std::uint8_t, signature.size()> first{};
    return read_exactly(file, first.data(), first.size()) && first == signature;
}

}  // namespace

void put_png_note(std::vector<std::uint8_t>& png, const std::string& note) {
    base::check(note.size() <= longest_note && png.size() >= signature.size() + header_chunk,
                "a note for a whole picture");
    std::string typed(type);
    typed.append(begins).append(note);
    std::vector<std::uint8_t> chunk;
    append_word(chunk, static_cast<std::uint32_t>(typed.size() - type.size()));
    chunk.insert(chunk.end(), typed.begin(), typed.end());
    append_word(chunk, checksum(typed));
    png.insert(png.begin() + signature.size() + header_chunk, chunk.begin(), chunk.end());
}

bool is_png(const std::string& path) {
    const File file(std::fopen(path.c_str(), "rb"));
    return file && begins_as_png(file.get());
}

base::Result<std::string> read_png_note(const std::string& path) {
    const std::string operation = "read the note of picture " + path;
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        return base::error(errno == ENOENT ? base::Code::not_found : base::Code::io, operation,
                           std::generic_category().message(errno));
    }
    const auto corrupt = [&](const char* what) { return base::error(base::Code::corrupt, operation, what); };
    if (!begins_as_png(file.get())) {
        return corrupt("not a PNG file");
    }
    std::array<std::uint8_t, 8> head{};
    while (read_exactly(file.get(), head.data(), head.size())) {
        const std::uint32_t length = word_at(head.data());
        const std::string_view is(reinterpret_cast<const char*>(head.data()) + 4, 4);
        if (length > INT32_MAX) {
            return corrupt("a chunk longer than chunks can be");
        }
        if (is == "IEND") {
            return base::error(base::Code::not_found, operation, "the picture carries none");
        }
        if (is == type && length >= begins.size() && length <= begins.size() + longest_note) {
            std::string typed(is);
            typed.resize(type.size() + length);
            std::array<std::uint8_t, 4> sum{};
            if (!read_exactly(file.get(), typed.data() + type.size(), length) ||
                !read_exactly(file.get(), sum.data(), sum.size())) {
                return corrupt("the file ends within it");
            }
            if (std::string_view(typed).substr(type.size(), begins.size()) == begins) {
                return checksum(typed) == word_at(sum.data())
                           ? base::Result<std::string>(typed.substr(type.size() + begins.size()))
                           : corrupt("it is damaged");
            }
        } else if (std::fseek(file.get(), static_cast<long>(length) + 4, SEEK_CUR) != 0) {
            break;
        }
    }
    return corrupt("the file ends before the picture does");
}

}  // namespace shearwater::image
