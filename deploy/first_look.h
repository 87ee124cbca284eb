#pragma once
// How long a person waits in front of a new cube: for the first picture, and for the one of all voxels.

#include "common/base/result.h"
#include "common/options/cube_options.h"

namespace shearwater::deploy {

struct FirstLook {
    double first = 0;  // seconds from starting the daemons to a picture, of a sketch where one can be made
    double whole = 0;  // to the cube's
    bool sketch = false;
};

// Starts a tree of so many renderers below a server, looks at the cube by its middle view, 512 x 512, and
// ends the tree when the cube is seen. Errors as LocalTree::start and the link have them.
base::Result<FirstLook> first_look(const options::CubeOptions& cube, int renderers, int threads);

}  // namespace shearwater::deploy
