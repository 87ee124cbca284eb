#pragma once
// A flight past cubes (DVR section 4: scripted flight paths): key frames in time, and what is seen between.
//
//   key 0        key 1                key 2       time ->
//     o------------o--------------------o
//     cube 0       cube 1: a cut; the camera flies on
//
// Between keys the camera's numbers follow monotone cubics through all keys (Fritsch and Carlson 1980):
// smooth, never beyond the keys' own values, and at rest where two keys are alike. The distance does so by
// its logarithm. The transfer function goes from key to key by blend.h, and the limits of values evenly where
// both keys have some and stretch alike. The projection, the cube and else the limits are those of the last
// key before.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cube_options.h"
#include "common/view/transfer_function.h"
#include "common/view/viewpoint.h"

namespace shearwater::flight {

struct Key {
    double time = 0;            // seconds from the flight's begin
    std::size_t cube = 0;       // among the path's
    view::Viewpoint viewpoint;  // azimuth and roll as far as they are to turn: beyond 360 for more than one
    view::TransferFunction tf = view::default_transfer_function();
    std::optional<volume::Scaling> scaling = {};  // of the cube's values; else as whoever loads it has it
    bool operator==(const Key&) const = default;
};

struct Path {
    static constexpr std::size_t max_keys = 4096, max_cubes = 256;
    static constexpr double max_seconds = 24 * 3600;
    static constexpr int max_fps = 240;

    int fps = 25;
    std::vector<options::CubeOptions> cubes;  // none: whatever a server shows
    std::vector<Key> keys;                    // by rising time, the first at 0

    // Frame i is seen at i / fps; the last at, or just before, the last key.
    int frames() const;
};

// At least one key, the first at 0, times rising; every number in range, cubes among the path's.
base::Status validate(const Path& path);

// At a time, which is brought into the flight's: which cube, and what of it when its lattice is known.
std::size_t cube_at(const Path& path, double time);
struct Seen {
    view::Viewpoint viewpoint;
    view::TransferFunction tf;
    std::optional<volume::Scaling> scaling;
};
Seen seen_at(const Path& path, double time, const view::Lattice& lattice);

// What is seen of a cube.
struct Shot {
    view::Camera camera;
    view::TransferFunction tf;
    std::optional<volume::Scaling> scaling = {};  // of its values; else as it was loaded
};
Shot shot_at(const Path& path, double time, const view::Lattice& lattice);

}  // namespace shearwater::flight
