#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include "common/image/png.h"
#include "deploy/commands.h"
#include "deploy/one_process.h"
#include "deploy/progress_bar.h"
#include "deploy/still.h"
#include "deploy/target.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string program = "shearwater snapshot";

struct Flags {
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

base::Result<Picture> draw_over_links(const Flags& flags, const view::TransferFunction& tf,
                                      const view::ImageSize& size) {
    auto target = open_target(flags.target, "warn");
    if (!target) {
        return target.error();
    }
    std::optional<LocalTree>& tree = target->tree;
    Still still(target->server, flags.view, tf, size, flags.repeat);
    ProgressBar bar("loading");
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(program, target->secret, [&](const wire::NetEvent& event) {
        runtime->perform(still.handle(event, std::chrono::steady_clock::now()));
        bar.show(still.progress());
        if (still.done()) {
            runtime->stop(0);
        } else if (tree && std::holds_alternative<wire::Tick>(event) && !tree->keep_alive()) {
            runtime->stop(1);
        }
    });
    runtime->perform(still.start(std::chrono::steady_clock::now()));
    runtime->run();
    if (!still.done()) {
        return base::error(base::Code::cancelled, "draw", "stopped before there was a picture");
    }
    auto picture = still.take();
    if (picture && tree) {
        picture->tree = tree->shape();
    }
    return picture;
}

base::Status snapshot(const Flags& flags) {
    if (const auto valid = flags.target.validate(); !valid) {
        return valid;
    }
    const auto tf = flags.view.transfer_function();
    if (!tf) {
        return tf.error();
    }
    const auto size = flags.view.image_size();
    if (!size) {
        return size.error();
    }
    base::Result<Picture> picture = Picture{};
    if (flags.target.connect.empty() && flags.target.tree.one_process()) {
        ProgressBar bar("loading");
        picture = draw_in_process(flags.target.cube, flags.view, *tf, flags.target.threads, flags.repeat,
                                  [&](double fraction) { bar.show(fraction); });
    } else {
        picture = draw_over_links(flags, *tf, *size);
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
    auto flags = std::make_shared<Flags>();
    app.add_option("-o,--output", flags->output, "PNG file; - for standard output")->required();
    app.add_option("--repeat", flags->repeat, "draw so often and report medians")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--json", flags->json, "report times, samples and memory; - for standard output");
    flags->target.add_to(app);
    flags->view.add_to(app);
    return [flags] {
        const auto done = snapshot(*flags);
        return done ? 0 : refuse(program, done.error());
    };
}

}  // namespace shearwater::deploy
