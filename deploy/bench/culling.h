#pragma once
// What `bench culling` measures of leaving out hidden blocks, each as a table of its own, after the papers'
// (POF 5, OPOF 7). Every voxel counts: there are no levels of detail.

#include <array>
#include <cstdint>
#include <string>

#include "common/culling/settings.h"
#include "deploy/bench/cases.h"
#include "deploy/bench/in_process.h"
#include "deploy/bench/report.h"

namespace shearwater::bench {

struct CullingRun {
    const Case& drawn;
    InProcess& cube;
    deploy::ViewOptions view;  // the path's first
    double threshold;
    std::int64_t block;  // voxels a side
    int frames;
    Report& report;

    culling::Settings settings(culling::Kind kind) const { return {kind, threshold}; }
    culling::BlockGrid grid() const { return culling::BlockGrid(cube.lattice().n, block); }
    culling::Culler culler() const { return {cube.bricks(), cube.lattice().spacing, block}; }
    view::ImageSize size() const { return *view.image_size(); }
    // So many degrees around from the first view.
    view::Factorisation factorisation(double degrees) const;
    view::Camera camera(double degrees) const;
    // "W3, 512x512x512, perspective"
    std::string title() const;
    // A record that says, in JSON, what all of a run's do.
    Record record() const;
};

// From what leaves out the most.
inline constexpr std::array culling_kinds{culling::Kind::opof, culling::Kind::opof_linear,
                                          culling::Kind::pof};
inline const char* name_of(culling::Kind kind) {
    return culling::kind_names[static_cast<std::size_t>(kind)].data();
}

// Blocks that are not transparent throughout.
culling::BlockSet opaque_blocks(const shear::BrickVolume& volume, const shear::Classification& classification,
                                const culling::BlockGrid& grid);
// How many blocks are in both.
std::uint64_t count_of_both(const culling::BlockSet& a, const culling::BlockSet& b);

// Visible blocks of 18 views, 20 degrees apart (POF Figure 4, OPOF Figure 11).
void culling_views(const CullingRun& run);
// What functions take to compute and to keep (POF 5).
void culling_functions(const CullingRun& run);
// Frames with and without (POF Figure 5).
void culling_frames(const CullingRun& run);
// Three settings of a family of two bases (POF Figure 8).
void culling_family(const CullingRun& run);
// What visibility takes to decide.
void culling_pass(const CullingRun& run);
// The same for a cube of 2048^3 voxels that has functions and nothing else, and either projection.
base::Status culling_pass_of_many(const deploy::ViewOptions& view, double threshold, int frames,
                                  base::Workers& workers, Report& report);
// The same shared over renderers, each of which looks at a part of the picture.
base::Status culling_shared(const deploy::ViewOptions& view, double threshold, int frames, Report& report);
// Pictures of a tree while a pin is dragged, with and without: none is to come later for it.
base::Status culling_drag(const Case& drawn, const deploy::ViewOptions& view, double threshold, int frames,
                          int threads, Report& report);
// So many pictures at random with and without; whether none differs by more than it may.
bool culling_check(const CullingRun& run, int pictures);

}  // namespace shearwater::bench
