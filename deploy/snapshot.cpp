#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>

#include "common/image/png.h"
#include "deploy/commands.h"
#include "deploy/local_tree.h"
#include "deploy/one_process.h"
#include "deploy/progress_bar.h"
#include "deploy/session_secret.h"
#include "deploy/still.h"
#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {
namespace {

const std::string program = "shearwater snapshot";

struct Flags {
    options::CubeOptions cube;
    options::TreeOptions tree;
    ViewOptions view;
    std::string output;
    std::string connect;
    std::string secret_file;
    std::string json;
    int threads = 0;
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

// Draws over the links: on the tree just started, or on a server that was there before.
base::Result<Picture> draw_over_links(const Flags& flags, const view::TransferFunction& tf,
                                      const view::ImageSize& size, const wire::Address& server,
                                      const link::Secret& secret, LocalTree* tree) {
    Still still(server, flags.view, tf, size, flags.repeat);
    ProgressBar bar("loading");
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(program, secret, [&](const wire::NetEvent& event) {
        runtime->perform(still.handle(event, std::chrono::steady_clock::now()));
        bar.show(still.progress());
        if (still.done()) {
            runtime->stop(0);
        } else if (tree != nullptr && std::holds_alternative<wire::Tick>(event) && !tree->keep_alive()) {
            runtime->stop(1);
        }
    });
    runtime->perform(still.start(std::chrono::steady_clock::now()));
    runtime->run();
    if (!still.done()) {
        return base::error(base::Code::cancelled, "draw", "stopped before there was a picture");
    }
    return still.take();
}

base::Result<Picture> draw_on_tree(const Flags& flags, const view::TransferFunction& tf,
                                   const view::ImageSize& size) {
    const auto chosen = choose_secret(flags.secret_file);
    if (!chosen) {
        return chosen.error();
    }
    if (!flags.connect.empty()) {
        const auto server = wire::parse_address(flags.connect, 0);
        if (!server) {
            return server.error();
        }
        return draw_over_links(flags, tf, size, *server, chosen->secret, nullptr);
    }
    auto tree = LocalTree::start(
        {.cube = flags.cube, .tree = flags.tree, .threads = flags.threads, .log_level = "warn"},
        chosen->secret);
    if (!tree) {
        return tree.error();
    }
    auto picture = draw_over_links(flags, tf, size, tree->address(), chosen->secret, &*tree);
    if (picture) {
        picture->tree = tree->shape();
    }
    return picture;
}

base::Status snapshot(const Flags& flags) {
    if (const auto valid = flags.cube.validate(); !valid) {
        return valid;
    }
    if (flags.cube.path.empty() == flags.connect.empty()) {
        return base::error(base::Code::invalid_argument, "snapshot",
                           "name either a cube or --connect HOST:PORT");
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
    if (flags.connect.empty() && flags.tree.one_process()) {
        ProgressBar bar("loading");
        picture = draw_in_process(flags.cube, flags.view, *tf, flags.threads, flags.repeat,
                                  [&](double fraction) { bar.show(fraction); });
    } else {
        picture = draw_on_tree(flags, *tf, *size);
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
    app.add_option("cube", flags->cube.path, "the FITS file");
    app.add_option("-o,--output", flags->output, "PNG file; - for standard output")->required();
    app.add_option("--connect", flags->connect, "HOST:PORT of a running server, instead of a cube");
    app.add_option("--secret-file", flags->secret_file, "file of mode 0600 with the server's secret");
    app.add_option("--threads", flags->threads, "threads that compute; 0: one a processor")
        ->check(CLI::Range(0, 1024));
    app.add_option("--repeat", flags->repeat, "draw so often and report medians")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--json", flags->json, "report times, samples and memory; - for standard output");
    flags->view.add_to(app);
    flags->tree.add_to(app);
    flags->cube.add_to(app);
    return [flags] {
        const auto done = snapshot(*flags);
        if (done) {
            return 0;
        }
        // The server has then said itself why it could not start.
        return done.error().operation.empty() ? LocalTree::refused : daemon::refuse(program, done.error());
    };
}

}  // namespace shearwater::deploy
