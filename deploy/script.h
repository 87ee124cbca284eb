#pragma once
// What a client without a window asks for, picture by picture.

#include <functional>
#include <optional>

#include "common/base/result.h"
#include "common/flight/path.h"
#include "common/image/image.h"
#include "common/view/anchored_function.h"
#include "deploy/view_options.h"

namespace shearwater::deploy {

// What of a cube pictures of it depend on.
struct KnownCube {
    view::Lattice lattice;
    std::optional<view::ValueScale> scale;  // where the script's unit needs it
};

struct Script {
    int pictures = 1;
    // Views asked for and not yet seen, once the first picture has come: while a window is turned the server
    // has the next before the last is there.
    int in_flight = 1;
    // What its transfer functions are placed by: by other than s, the cube's values are waited for.
    view::Unit unit = view::Unit::stretched;
    // What picture `index` shows.
    std::function<base::Result<flight::Shot>(int index, const KnownCube& cube)> shot;
    // Takes the pictures as they come, each once. None: only the last is of interest.
    std::function<base::Status(int index, const image::Image<image::Rgba8>& picture)> keep;
};

// One camera, some pictures; `turn` degrees of azimuth from one to the next.
Script script_of(const ViewOptions& view, const view::AnchoredFunction& function, int pictures = 1,
                 double turn = 0, int in_flight = 1);

}  // namespace shearwater::deploy
