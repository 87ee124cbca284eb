#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "common/image/png.h"
#include "deploy/commands.h"
#include "deploy/one_process.h"
#include "deploy/over_links.h"
#include "deploy/progress_bar.h"
#include "deploy/target.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string snapshot_program = "shearwater snapshot";

struct SnapshotFlags {
    TargetOptions target;
    ViewOptions view;
    std::string output;
    std::string json;
    int repeat = 1;
};

base::Status write_json(const std::string& path, const Picture& picture) {
    if (path == "-") {
        std::cout << to_json(picture) << std::endl;
        return {};
    }
    std::ofstream file(path);
    file << to_json(picture) << "\n";
    if (!file.flush()) {
        return base::error(base::Code::io, "write " + path, "cannot be written");
    }
    return {};
}

base::Result<Picture> draw_by_tree(const SnapshotFlags& flags, const view::AnchoredFunction& function,
                                   const view::ImageSize& size) {
    auto target = open_target(flags.target, "warn");
    if (!target) {
        return target.error();
    }
    ProgressBar bar(flags.repeat > 1 ? "loading and drawing" : "loading");
    return draw_over_links(snapshot_program, *target, flags.view, size,
                           script_of(flags.view, function, flags.repeat),
                           [&](double fraction) { bar.show(fraction); });
}

base::Status snapshot(SnapshotFlags& flags) {
    if (const auto valid = flags.target.validate(); !valid) {
        return valid;
    }
    if (const auto opened = flags.view.open_session(); !opened) {
        return opened;
    }
    const auto function = flags.view.drawing.transfer_function();
    if (!function) {
        return function.error();
    }
    const auto size = flags.view.image_size();
    if (!size) {
        return size.error();
    }
    base::Result<Picture> picture = Picture{};
    if (flags.target.connect.empty() && flags.target.tree.one_process()) {
        ProgressBar bar("loading");
        picture =
            draw_in_process(flags.target.cube, flags.view, script_of(flags.view, *function, flags.repeat),
                            flags.target.threads, [&](double fraction) { bar.show(fraction); });
    } else {
        picture = draw_by_tree(flags, *function, *size);
    }
    if (!picture) {
        return picture.error();
    }
    if (const auto written = image::write_png(flags.output, picture->image); !written) {
        return written;
    }
    return flags.json.empty() ? base::Status{} : write_json(flags.json, *picture);
}

}  // namespace

Run add_snapshot(CLI::App& app) {
    auto flags = std::make_shared<SnapshotFlags>();
    app.add_option("-o,--output", flags->output, "PNG file; - for standard output")->required();
    app.add_option("--repeat", flags->repeat, "draw so often and report medians")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--json", flags->json, "report times, samples and memory; - for standard output");
    flags->target.add_to(app);
    flags->view.add_to(app);
    return [flags] {
        const auto done = snapshot(*flags);
        return done ? 0 : refuse(snapshot_program, done.error());
    };
}

}  // namespace shearwater::deploy
