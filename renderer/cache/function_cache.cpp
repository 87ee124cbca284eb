#include "renderer/cache/function_cache.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "common/culling/block_grid.h"
#include "common/culling/direction_grid.h"

namespace shearwater::cache {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view extension = ".opacity";
// Of files on their way, which somebody may have left behind.
constexpr std::string_view unfinished = ".part";
constexpr std::chrono::hours abandoned{1};

culling::FunctionTable empty_table(const Content& content) {
    const culling::BlockGrid grid(content.n, content.block_edge);
    return {.blocks = grid.blocks_of(content.box), .side = content.side, .codes = {}};
}

std::size_t codes_of(const Content& content) {
    return empty_table(content).block_count() *
           static_cast<std::size_t>(culling::DirectionGrid(content.side).cells());
}

std::string last_error() {
    return std::strerror(errno);
}

}  // namespace

std::optional<std::string> default_folder() {
    const auto known = [](const char* name) -> std::optional<fs::path> {
        const char* const value = std::getenv(name);
        return value != nullptr && *value == '/' ? std::optional<fs::path>(value) : std::nullopt;
    };
    auto folder = known("XDG_CACHE_HOME");
    if (!folder) {
        folder = known("HOME");
        if (!folder) {
            return std::nullopt;
        }
        *folder /= ".cache";
    }
    return (*folder / "shearwater" / "functions").string();
}

Origin origin_of(const std::string& path, int hdu, std::int64_t plane) {
    Origin origin{.path = path, .hdu = hdu, .plane = plane};
    std::error_code none;
    const auto bytes = fs::file_size(path, none);
    if (!none) {
        origin.path = fs::absolute(path, none).string();
        origin.bytes = bytes;
        origin.modified =
            static_cast<std::int64_t>(fs::last_write_time(path, none).time_since_epoch().count());
    }
    return origin;
}

FunctionCache::FunctionCache(std::string folder, std::function<void(const std::string&)> log,
                             std::uint64_t most_bytes)
    : folder_(std::move(folder)), log_(std::move(log)), most_bytes_(most_bytes) {}

std::string FunctionCache::path_of(const std::string& name) const {
    std::string digits;
    for (std::uint64_t sum = checksum(name), n = 0; n < 16; ++n, sum >>= 4) {
        digits += "0123456789abcdef"[sum & 15];
    }
    return (fs::path(folder_) / (digits + std::string(extension))).string();
}

std::optional<culling::FunctionTable> FunctionCache::find(const Content& content) const {
    const std::string name = name_of(content);
    const std::string path = path_of(name);
    std::error_code failure;
    if (!fs::is_regular_file(path, failure)) {
        return std::nullopt;
    }
    const std::size_t codes = codes_of(content), size = file_size(name, codes);
    std::string file;
    if (fs::file_size(path, failure) == size && !failure) {
        file.resize(size);
        std::ifstream in(path, std::ios::binary);
        if (!in.read(file.data(), static_cast<std::streamsize>(size))) {
            file.clear();
        }
    }
    auto read = codes_from(file, name, codes);
    if (!read) {
        log_("opacity functions in " + path + " cannot be used: broken, or of something else");
        return std::nullopt;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), failure);
    culling::FunctionTable table = empty_table(content);
    table.codes = *std::move(read);
    return table;
}

void FunctionCache::keep(const Content& content, const culling::FunctionTable& table) const {
    const std::string name = name_of(content);
    const std::string file = file_of(name, table);
    if (file.size() > most_bytes_) {
        return;
    }
    if (const auto written = write(path_of(name), file); !written) {
        log_(written.error().message());
        return;
    }
    drop_oldest();
}

base::Status FunctionCache::write(const std::string& path, const std::string& file) const {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    const std::string part =
        path + "." + std::to_string(::getpid()) + "." + std::to_string(now) + std::string(unfinished);
    std::error_code failure;
    fs::create_directories(folder_, failure);
    errno = 0;
    std::ofstream out(part, std::ios::binary);
    out.write(file.data(), static_cast<std::streamsize>(file.size()));
    out.close();
    if (!out) {
        const std::string why = last_error();
        fs::remove(part, failure);
        return base::error(base::Code::io, "keep opacity functions in " + folder_, why);
    }
    fs::rename(part, path, failure);
    if (failure) {
        const std::string why = failure.message();
        fs::remove(part, failure);
        return base::error(base::Code::io, "keep opacity functions in " + folder_, why);
    }
    return {};
}

void FunctionCache::drop_oldest() const {
    struct Kept {
        fs::file_time_type used;
        fs::path path;
        std::uint64_t bytes;
    };
    std::vector<Kept> all;
    std::uint64_t bytes = 0;
    std::error_code failure;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator at(folder_, failure), end; !failure && at != end; at.increment(failure)) {
        std::error_code gone;  // somebody else may have dropped it
        const fs::path path = at->path();
        const auto used = fs::last_write_time(path, gone);
        const auto size = gone ? 0 : fs::file_size(path, gone);
        if (gone) {
            continue;
        }
        if (path.extension() == unfinished && now - used > abandoned) {
            fs::remove(path, gone);
        } else if (path.extension() == extension) {
            all.push_back({used, path, size});
            bytes += size;
        }
    }
    std::ranges::sort(all, {}, &Kept::used);
    for (const Kept& oldest : all) {
        if (bytes <= most_bytes_) {
            return;
        }
        fs::remove(oldest.path, failure);
        bytes -= oldest.bytes;
    }
}

}  // namespace shearwater::cache
