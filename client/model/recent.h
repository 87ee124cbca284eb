#pragma once
// Where a person has been: the connections that came about, the last one first, and the file they are kept
// in. No secrets: of those only in which files they are.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/result.h"

namespace shearwater::model {

struct Recent {
    std::string name;         // of a place, to be typed again. Any bytes but 0
    std::string secret_file;  // absolute; empty: none was named
    bool operator==(const Recent&) const = default;
};

class RecentList {
  public:
    static constexpr std::size_t most = 12;
    static constexpr std::size_t longest = 4096;  // bytes of a name; longer ones are not kept

    // To the front, in the place of what has its name.
    void add(Recent recent);
    void remove(std::string_view name);
    std::span<const Recent> all() const { return all_; }

  private:
    std::vector<Recent> all_;
};

// Printable ASCII: other bytes are written %XX.
std::string to_toml(const RecentList& list);
// corrupt: not such a file, or one cut short.
base::Result<RecentList> recent_from_toml(std::string_view text, const std::string& source);

}  // namespace shearwater::model
