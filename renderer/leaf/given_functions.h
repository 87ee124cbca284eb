#pragma once
// Which functions of all of the cube's blocks the leaf has been given, by the head's numbers of them.

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/culling/function_store.h"
#include "protocol/wire/convert_culling.h"

namespace shearwater::leaf {

class GivenFunctions {
  public:
    static constexpr std::size_t most = 64;

    // A piece of them: taken unless one before it is lost, or there are too many. The first of a key's takes
    // the place of what there was of that key.
    bool take(const wire::GivenFunctions& given);
    // Whether all of each of these has been taken.
    bool has(std::span<const std::uint64_t> numbers) const;
    // Keeps these only. Returns the others' keys, of which nothing is known any more.
    std::vector<culling::FunctionKey> keep(std::span<const std::uint64_t> numbers);

  private:
    struct Taken {
        culling::FunctionKey key;
        int directions, all;
    };
    std::map<std::uint64_t, Taken> taken_;
};

}  // namespace shearwater::leaf
