#include "deploy/bench/cases.h"

#include <CLI/CLI.hpp>

#include "deploy/bench/options.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {

base::Result<InProcess> load(const Case& drawn, int threads) {
    deploy::ProgressBar bar("loading " + drawn.name);
    return InProcess::load(drawn.cube, threads, [&](double share) { bar.show(share); });
}

void CaseOptions::add_to(CLI::App& app) {
    auto* const file = app.add_option("cube", cube.path, "a FITS file to draw instead of a workload");
    app.add_option("--workload", workloads, "what is drawn; several with commas between")
        ->delimiter(',')
        ->check(CLI::IsMember(workload_names()))
        ->excludes(file)
        ->capture_default_str();
    add_size(app, edge);
    app.add_option("--tf", tf_file, "the FITS file's transfer function, a TOML file")->needs(file);
    cube.add_to(app);
}

base::Result<std::vector<Case>> CaseOptions::cases() const {
    std::vector<Case> cases;
    if (cube.path.empty()) {
        for (const std::string& name : workloads) {
            const Workload made = workload(name);
            cases.push_back({name, made.cube(edge), made.tf});
            cases.back().cube.bits = cube.bits;
            cases.back().cube.copies = cube.copies;
        }
        return cases;
    }
    const auto function = options::DrawingOptions{.tf_file = tf_file}.transfer_function();
    if (!function) {
        return function.error();
    }
    const auto tf = view::on_scale(*function, nullptr);
    if (!tf) {
        return tf.error();
    }
    cases.push_back({cube.path, cube, *tf});
    return cases;
}

}  // namespace shearwater::bench
