#include "deploy/bench/on_tree.h"

#include "common/cube/open.h"
#include "deploy/bench/machine.h"
#include "deploy/bench/workload.h"
#include "deploy/over_links.h"

namespace shearwater::bench {

base::Result<OnTree> OnTree::start(const options::CubeOptions& cube, int branching, int levels, int threads) {
    const auto opened = cube::open(cube.path, cube.open_options());
    if (!opened) {
        return opened.error();
    }
    const auto voxels = static_cast<std::uint64_t>(volume::voxel_count(opened->info.n));
    if (const auto fits = check_memory("load " + cube.path,
                                       voxels * static_cast<std::uint64_t>(cube.bits / 8 * cube.copies));
        !fits) {
        return fits.error();
    }
    deploy::LocalTree::Options options{.cube = cube, .tree = {}, .threads = threads, .log_level = "warn"};
    options.tree.tree = {branching, levels};
    const auto topology = options.tree.topology();
    if (!topology) {
        return topology.error();
    }
    const link::Secret secret = link::Secret::random();
    auto tree = deploy::LocalTree::start(options, secret);
    if (!tree) {
        return tree.error();
    }
    deploy::Target target{.server = tree->address(), .secret = secret, .tree = {}};
    target.tree.emplace(*std::move(tree));
    return OnTree(std::move(target), topology->renderers(), static_cast<int>(topology->nodes.size()));
}

base::Result<deploy::Picture> OnTree::draw(const deploy::ViewOptions& view, deploy::Script script,
                                           const volume::Progress& progress) {
    const auto size = view.image_size();
    if (!size) {
        return size.error();
    }
    return deploy::draw_over_links("shearwater bench", target_, view, *size, std::move(script), progress);
}

base::Result<deploy::Picture> OnTree::draw_path(deploy::ViewOptions view, int frames,
                                                const view::TransferFunction& tf,
                                                const volume::Progress& progress, int in_flight) {
    constexpr int until_all_fly = 4;
    const int before = in_flight > 1 ? until_all_fly : 1;
    view.orbit.azimuth -= before * Path::turn;
    auto picture =
        draw(view, deploy::script_of(view, {.tf = tf}, before + frames, Path::turn, in_flight), progress);
    if (picture) {
        picture->each.erase(picture->each.begin(), picture->each.begin() + before);
        picture->seconds = deploy::median(picture->each);
    }
    return picture;
}

}  // namespace shearwater::bench
