#include "deploy/bench/path_on_tree.h"

#include <CLI/CLI.hpp>

#include "deploy/bench/on_tree.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

void PathOnTree::add_to(CLI::App& app) {
    app.add_option("--tree", tree, "branching and levels")
        ->delimiter(',')
        ->expected(2)
        ->allow_extra_args(false)
        ->type_name("B,LEVELS")
        ->default_str(std::to_string(tree[0]) + "," + std::to_string(tree[1]));
    add_workload(app, workload);
    common.add_pictures(app);
}

base::Result<PathOnTree::Drawn> PathOnTree::draw() const {
    const auto view = common.view(edge);
    if (!view) {
        return view.error();
    }
    const Workload work = bench::workload(workload);
    auto by = OnTree::start(work.cube(edge), tree[0], tree[1], common.threads);
    if (!by) {
        return by.error();
    }
    deploy::ProgressBar bar(workload + ", " + std::to_string(edge) + "^3");
    auto picture = by->draw_path(*view, common.frames, work.tf, [&](double share) { bar.show(share); });
    if (!picture) {
        return picture.error();
    }
    return Drawn{by->renderers(), by->nodes(), *std::move(picture)};
}

}  // namespace shearwater::bench
