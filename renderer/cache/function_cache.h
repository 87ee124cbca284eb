#pragma once
// A folder of opacity functions that have been computed, for the next time that somebody looks at the same
// cube. Several renderers may share it: files are put in their place whole, and a broken one is as good as
// none. What cannot be read or written is logged, and no more.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/base/result.h"
#include "renderer/cache/function_file.h"

namespace shearwater::cache {

// Where functions are kept unless somebody says where: $XDG_CACHE_HOME/shearwater/functions or
// ~/.cache/shearwater/functions; none where neither is known.
std::optional<std::string> default_folder();

// A cube that can be opened by its path, as it is now.
Origin origin_of(const std::string& path, int hdu, std::int64_t plane);

class FunctionCache {
  public:
    static constexpr std::uint64_t default_bytes = std::uint64_t{1} << 30;

    // Of at most so many bytes: those longest unused go first. `log` is told, in a line, what went wrong; it
    // may be called from any thread that uses the cache.
    FunctionCache(std::string folder, std::function<void(const std::string&)> log,
                  std::uint64_t most_bytes = default_bytes);

    // The functions of all of a content's blocks, if they are there and whole.
    std::optional<culling::FunctionTable> find(const Content& content) const;
    void keep(const Content& content, const culling::FunctionTable& table) const;

  private:
    std::string path_of(const std::string& name) const;
    base::Status write(const std::string& path, const std::string& file) const;
    void drop_oldest() const;

    std::string folder_;
    std::function<void(const std::string&)> log_;
    std::uint64_t most_bytes_;
};

}  // namespace shearwater::cache
