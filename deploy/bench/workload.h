#pragma once
// What is drawn, and from where: the same for every renderer that is compared.
//   W1  independent values 0 to 255, opacity 0.001 throughout: every sample counts, none can be skipped
//   W2  noise and sources, transparent up to 80 and rising to 0.3 at 255: nearly all can be skipped
//   W3  the same cube, opacity 0.05 up to 80 and rising to 0.3: rays end early

#include <string>
#include <vector>

#include "common/options/cube_options.h"
#include "common/view/transfer_function.h"
#include "deploy/view_options.h"

namespace shearwater::bench {

struct Workload {
    std::string name;
    std::string field;  // of synthetic::kinds()
    view::TransferFunction tf;

    // As a cube of so many voxels along each axis, shown from 0 to 255.
    options::CubeOptions cube(std::int64_t edge) const;
};

const std::vector<std::string>& workload_names();
// One of those names.
Workload workload(const std::string& name);

// The paths of a cube's pictures: 2.4 edges away, 20 degrees above, ten steps of 36 degrees around.
struct Path {
    static constexpr double first_azimuth = 10;
    static constexpr double turn = 36;
    static constexpr double elevation = 20;
    static constexpr double fov = 30;
    static constexpr double edges_away = 2.4;
};
// The first view of it. In a parallel projection the cube's middle is as large as in perspective.
deploy::ViewOptions first_view(std::int64_t edge);

}  // namespace shearwater::bench
