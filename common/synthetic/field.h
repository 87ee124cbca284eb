#pragma once
// Values by formula: what a cube without a file holds. The same voxel has the same value whichever box
// it is asked for in.

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "common/base/result.h"
#include "common/volume/box.h"

namespace shearwater::synthetic {

class Field {
  public:
    virtual ~Field() = default;
    // Fills `out` with the voxels of planes lo to hi (both included) of `box`, axis 0 fastest. From
    // several threads at once.
    virtual void fill(const volume::Box& box, std::span<float> out) const = 0;
};

struct Kind {
    std::string_view name;
    std::string_view description;
    bool bytes;  // whole numbers from 0 to 255 say it well
};

// "slab", "ball", "random", "random-bytes" and "noise-sources".
std::span<const Kind> kinds();

// The named field over a cube of n voxels. Errors: no such name, or an axis of fewer than 2 voxels or
// more than 2^20.
base::Result<std::unique_ptr<const Field>> make_field(std::string_view name, const volume::Index3& n,
                                                      std::uint64_t seed);

}  // namespace shearwater::synthetic
