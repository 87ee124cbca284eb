// bench images: the paper's Table 2, pictures of several sizes of one cube by seven nodes.

#include "deploy/bench/in_process.h"

#include <CLI/CLI.hpp>
#include "deploy/bench/on_tree.h"
#include "deploy/bench/options.h"
#include "deploy/bench/paper.h"
#include "deploy/bench/report.h"
#include "deploy/bench/subcommands.h"
#include "deploy/bench/workload.h"
#include "deploy/progress_bar.h"

namespace shearwater::bench {
namespace {

struct ImagesFlags {
    Options common;
    std::vector<std::string> images{"100x100", "256x256", "512x512"};
    std::int64_t edge = 128;
    std::string workload = "W1";
};

base::Status images(const ImagesFlags& flags) {
    const Workload work = workload(flags.workload);
    std::vector<deploy::ViewOptions> views;
    for (const std::string& image : flags.images) {
        Options common = flags.common;
        common.image = image;
        const auto view = common.view(flags.edge);
        if (!view) {
            return view.error();
        }
        views.push_back(*view);
    }
    auto report = Report::open("images", flags.common.json);
    if (!report) {
        return report.error();
    }
    deploy::ProgressBar bar(flags.workload);
    const auto show = [&](double share) { bar.show(share); };
    auto cube = InProcess::load(work.cube(flags.edge), flags.common.threads, show);
    if (!cube) {
        return cube.error();
    }
    constexpr int levels = 3;
    auto tree = OnTree::start(work.cube(flags.edge), 2, levels, flags.common.threads);
    if (!tree) {
        return tree.error();
    }
    for (const deploy::ViewOptions& view : views) {
        const auto here = cube->draw_path(view, flags.common.frames, work.tf, show);
        const auto by_tree = tree->draw_path(view, flags.common.frames, work.tf, show);
        if (!here || !by_tree) {
            return here ? by_tree.error() : here.error();
        }
        const view::ImageSize size = *view.image_size();
        const bool papers = flags.edge == 128 && size.width == size.height;
        const auto paper = papers ? paper::image_seconds(size.width) : std::nullopt;
        const deploy::Seconds& seconds = by_tree->seconds;
        Record record;
        record.text("image", view.size, 9)
            .aside("cube", cube_text(cube->lattice().n))
            .aside("workload", flags.workload)
            .aside("frames", flags.common.frames)
            .count("nodes", static_cast<std::uint64_t>(tree->nodes()))
            .number("median_s", seconds.total, 4)
            .number("render_s", seconds.render, 4)
            .number("paper_s", paper, 2)
            .number("times_faster", paper ? std::optional(*paper / seconds.total) : std::nullopt, 1)
            .number("one_process_s", summary(*here).total.median, 4);
        report->add(record);
    }
    return report->close();
}

}  // namespace

Run add_images(CLI::App& app) {
    auto flags = std::make_shared<ImagesFlags>();
    app.add_option("--images", flags->images, "sizes of the pictures, WIDTHxHEIGHT with commas between")
        ->delimiter(',')
        ->capture_default_str();
    add_size(app, flags->edge);
    add_workload(app, flags->workload);
    flags->common.add_frames(app);
    flags->common.add_quality(app);
    flags->common.drawing.add_classify(app);
    flags->common.drawing.add_lod(app);
    flags->common.add_threads(app);
    flags->common.add_json(app);
    return [flags] { return status_of("images", images(*flags)); };
}

}  // namespace shearwater::bench
