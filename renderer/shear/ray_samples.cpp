#include "renderer/shear/ray_samples.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/check.h"
#include "renderer/shear/face_plan.h"
#include "renderer/shear/kernel.h"

namespace shearwater::shear {

namespace {

// The code of the ray's sample on slice k, interpolated by definition between the corners of its cell.
template <class Code>
float code_of(const CodeVolume& voxels, const FacePlan& plan, std::int64_t k) {
    const view::SliceMap& map = plan.slice_plan(k).map;
    const std::array axes{plan.fast_axis(), plan.slow_axis(), plan.face().axis};
    const double place = plan.node_place(k);
    // The kernel's rounding to whole cell_steps says which cell it is.
    const auto cell = [&](double at, int axis) {
        const auto a = static_cast<std::size_t>(axis);
        return std::clamp(static_cast<std::int64_t>(at * cell_steps + 0.5) / cell_steps, voxels.box().lo[a],
                          voxels.box().hi[a] - 1);
    };
    const std::int64_t fast = cell(map.u_offset, axes[0]), slow = cell(map.v_offset, axes[1]);
    const auto plane = static_cast<std::int64_t>(std::floor(place));
    const bool between = place != std::floor(place);
    std::array<std::array<Code, 4>, 2> corners{};
    for (std::size_t n = 0; n < 8; ++n) {
        const std::size_t deep = n / 4;
        volume::Index3 at{};
        at[static_cast<std::size_t>(axes[0])] = fast + static_cast<std::int64_t>(n % 2);
        at[static_cast<std::size_t>(axes[1])] = slow + static_cast<std::int64_t>(n / 2 % 2);
        at[static_cast<std::size_t>(axes[2])] = plane + static_cast<std::int64_t>(between ? deep : 0);
        corners[deep][n % 4] = voxels.codes<Code>()[voxels.offset(at)];
    }
    Slab<Code> slab{.fast_first = fast,
                    .slow_first = slow,
                    .fast_cells = 1,
                    .slow_cells = 1,
                    .stride = 2,
                    .ahead = {},
                    .fast_pixel = 0,
                    .slow_pixel = 0,
                    .blanks = true,
                    .between_nodes = true,
                    .faint = false,
                    .count = 1,
                    .slices = {}};
    slab.slices[0] = {.voxels = corners[0].data(),
                      .next = between ? corners[1].data() : nullptr,
                      .fast_offset = map.u_offset,
                      .fast_scale = map.u_scale,
                      .slow_offset = map.v_offset,
                      .slow_scale = map.v_scale,
                      .pixels = {0, 0, 1, 1},
                      .lengths = nullptr};
    return sample_by_definition(slab, slab.slices[0], 0, 0);
}

double extinction_of(float code, const OpacityTable& table) {
    const float at = code * table.nodes_per_code();
    const OpacityTable::Node* const node = table.nodes() + static_cast<int>(at);
    const float fraction = at - std::floor(at);
    return static_cast<double>(node[0].extinction + fraction * (node[1].extinction - node[0].extinction));
}

template <class Code>
std::vector<view::RaySample> sample(const BrickVolume& volume, const OpacityTable& table,
                                    const view::Factorisation& ray) {
    constexpr double no_light = 40;  // of optical depth
    std::vector<view::RaySample> samples;
    const FacePlan plan(volume, ray, 0);
    if (plan.window().empty()) {
        return samples;
    }
    float step = 0;
    plan.steps(0, 0, {&step, 1});
    const double depth_of_step = static_cast<double>(step) * static_cast<double>(table.depth_unit()) * M_LN2;
    constexpr float whole_step = 1;
    double gathered = 0;
    for (std::int64_t n = 0; n < plan.slice_count(); ++n) {
        const std::int64_t k = plan.slice(n);
        if (plan.slice_plan(k).owned.empty()) {
            continue;
        }
        const float code = code_of<Code>(volume.level(0), plan, k);
        if (!(code > 0)) {
            continue;
        }
        float share = 0;
        plan.write_shares(k, {0, 0, 1, 1},
                          {.steps = &whole_step, .lengths = &share, .stride = 1, .x0 = 0, .y0 = 0});
        const double depth = extinction_of(code, table) * static_cast<double>(share) * depth_of_step;
        if (static_cast<float>(depth) > 0) {
            samples.push_back({k, static_cast<float>(depth)});
            gathered += depth;
        }
        if (gathered > no_light || samples.size() == most_ray_samples) {
            break;
        }
    }
    return samples;
}

}  // namespace

std::vector<view::RaySample> sample_ray(const BrickVolume& volume, const OpacityTable& table,
                                        const view::Factorisation& ray) {
    base::check(view::is_ray(ray) && ray.lattice.n == volume.cube(), "a ray through the volume's cube");
    return volume.mapping().bits == 8 ? sample<std::uint8_t>(volume, table, ray)
                                      : sample<std::uint16_t>(volume, table, ray);
}

}  // namespace shearwater::shear
