#pragma once
// Which codes occur where.

#include <algorithm>
#include <cstddef>
#include <span>
#include <stop_token>

#include "common/base/workers.h"
#include "renderer/shear/code_volume.h"

namespace shearwater::shear {

// A box's codes, the first of them that of its first voxel, axis 0 adjacent.
template <class Code>
struct CodesOfBox {
    const Code* first;
    volume::Box box;
    std::ptrdiff_t row_stride, plane_stride;
};

// What is to be found out of a grid of edge micro_edge: of its members, of their octants, and of the members
// with one node more on every side, where there is one.
struct Survey {
    CodeGrid& micro_bricks;
    std::span<Octants> octants;
    std::span<CodeRange> reaches;
};

// Of a grid over `own`, a box inside that of the codes, of which nothing is known before; false if stopped
// before it is done.
template <class Code>
bool survey(const CodesOfBox<Code>& codes, const volume::Box& own, const Survey& found,
            base::Workers& workers, const std::stop_token& stop);

extern template bool survey(const CodesOfBox<std::uint8_t>&, const volume::Box&, const Survey&,
                            base::Workers&, const std::stop_token&);
extern template bool survey(const CodesOfBox<std::uint16_t>&, const volume::Box&, const Survey&,
                            base::Workers&, const std::stop_token&);

// Calls each(of a node's grid, of a voxels' grid) with the indices of all pairs of cells that meet, the first
// grid being over a box's nodes of a level and the second over the box.
template <class Each>
void for_cells_reached(const CodeGrid& nodes, int level, const CodeGrid& voxels, const Each& each) {
    const std::int64_t edge = nodes.edge() << level;
    const auto for_all = [](const volume::Index3& first, const volume::Index3& last, const auto& visit) {
        volume::Index3 at;
        for (at[2] = first[2]; at[2] <= last[2]; ++at[2]) {
            for (at[1] = first[1]; at[1] <= last[1]; ++at[1]) {
                for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
                    visit(at);
                }
            }
        }
    };
    const volume::Index3& counts = nodes.counts();
    for_all({0, 0, 0}, {counts[0] - 1, counts[1] - 1, counts[2] - 1}, [&](const volume::Index3& at) {
        volume::Index3 first, last;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int64_t start = (nodes.first(axis) + at[a]) * edge;
            // The outermost nodes may lie outside the box.
            const auto cell_of = [&](std::int64_t voxel) {
                return std::clamp<std::int64_t>(voxel / voxels.edge() - voxels.first(axis), 0,
                                                voxels.counts()[a] - 1);
            };
            first[a] = cell_of(start);
            last[a] = cell_of(start + edge - 1);
        }
        for_all(first, last, [&](const volume::Index3& to) { each(nodes.index(at), voxels.index(to)); });
    });
}

}  // namespace shearwater::shear
