#pragma once
// What lies around a sub-volume, coarsely: the codes that occur in octants of 4^3 cells of voxels, on the
// cube's grid, that are not wholly its own. Whoever asks what lines gather that leave it needs no more.

#include <cstdint>
#include <vector>

#include "common/base/workers.h"
#include "common/volume/box.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::shear {

class Halo {
  public:
    static constexpr std::int64_t octant = CodeVolume::octant_edge;
    static constexpr std::int64_t width = 5;  // octants

    Halo() = default;
    // Of a box of a cube of n voxels, as far as the voxels go that pass.
    Halo(const volume::Box& box, const volume::Box& passing, const volume::Index3& n);

    // Takes in the planes [first, end) of voxels, all that pass; in their order.
    void add(const CodeVolume& voxels, std::int64_t first, std::int64_t end, base::Workers& workers);

    // Octants, hi not included: all that there are, and those that are the sub-volume's own and not told of.
    const volume::Box& octants() const { return octants_; }
    const volume::Box& own() const { return own_; }
    // The leading bytes of the codes of one: from 0 where one is blank, min > max where nothing is known.
    const OctantRange& at(const volume::Index3& where) const { return ranges_[index(where)]; }
    std::size_t bytes() const { return ranges_.size() * sizeof(OctantRange); }

  private:
    std::size_t index(const volume::Index3& at) const {
        return static_cast<std::size_t>(
            ((at[2] - octants_.lo[2]) * octants_.cells(1) + at[1] - octants_.lo[1]) * octants_.cells(0) +
            at[0] - octants_.lo[0]);
    }
    template <class Code>
    void add_row(const CodeVolume& voxels, std::int64_t z, std::int64_t octant_y, std::int64_t octant_z);

    volume::Box octants_, own_;
    std::vector<OctantRange> ranges_;
};

}  // namespace shearwater::shear
