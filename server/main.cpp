// shearwater-server: the head of the tree. Gives daemons their places, clients their pictures.

#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <random>

#include "common/cube/open.h"
#include "common/options/cube_options.h"
#include "common/options/serve_options.h"
#include "common/options/tree_options.h"
#include "common/volume/levels.h"
#include "protocol/daemon/options.h"
#include "protocol/daemon/runtime.h"
#include "protocol/wire/words.h"
#include "server/head/head.h"
#include "server/service/service.h"

using namespace shearwater;

namespace {

struct Flags {
    daemon::Options common;
    options::CubeOptions cube;
    options::TreeOptions tree;
    options::ServeOptions serve;

    void add_to(CLI::App& app) {
        app.add_option("cube", cube.path, "the FITS file, or synthetic:KIND:SIZE")->required();
        tree.add_to(app);
        cube.add_to(app);
        serve.add_to(app);
        common.add_to(app);
    }
};

head::CubeFacts facts_of(const fits::CubeInfo& info, const options::CubeOptions& options) {
    const std::string path = cube::absolute(options.path);
    return {.name = base::printable(std::filesystem::path(path).filename().string()),
            .path = path,
            .object = info.object,
            .unit = info.unit,
            .hdu = info.hdu,
            .plane = info.plane,
            .lattice = {.n = info.n, .spacing = options.spacing_value()},
            .sketch_level = volume::sketch_level(info.n),
            .copies = options.copies,
            .world = info.world};
}

head::Deciding deciding_of(const options::ServeOptions& serve) {
    return serve.culling_by == "server"      ? head::Deciding::by_server
           : serve.culling_by == "renderers" ? head::Deciding::by_renderers
                                             : head::Deciding::automatic;
}

head::Limits limits_of(const options::CubeOptions& options, const options::ServeOptions& serve) {
    head::Limits limits{.range = {},
                        .percentile = options.percentile,
                        .stretch = options.stretch_value(),
                        .bits = options.bits,
                        .level_of_detail = serve.level_of_detail(),
                        .deciding = deciding_of(serve)};
    if (options.range.size() == 2) {
        limits.range = volume::Limits{options.range[0], options.range[1]};
    }
    return limits;
}

// Daemons of an earlier server must not take this one's places for theirs.
std::uint64_t new_epoch() {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | device();
}

int serve(const std::string& program, const Flags& flags, const link::Secret& secret, cube::Cube cube,
          head::Roster roster, const wire::Address& listen) {
    link::Limits link_limits;
    // All daemons may come at once, each with a link for its orders and one for its place.
    link_limits.handshakes += 2 * roster.plan().nodes.size();
    link_limits.links = 2 * roster.plan().nodes.size() + head::Head::max_clients + 16;
    head::Head head(std::move(roster), limits_of(flags.cube, flags.serve));
    std::optional<service::Service> service;
    std::optional<daemon::Runtime> runtime;
    const auto perform = [&](head::Effects effects) {
        runtime->perform(std::move(effects.net));
        for (head::Job& job : effects.jobs) {
            service->perform(std::move(job));
        }
    };
    runtime.emplace(
        program, secret,
        [&](wire::NetEvent event) {
            perform(head.handle(event, std::chrono::steady_clock::now()));
            if (const auto* up = std::get_if<wire::LinkUp>(&event)) {
                spdlog::info("{} from {} ({})", wire::text_of(up->role), up->peer_host, up->peer_name);
            } else if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
                spdlog::info("link down: {}", down->text);
            }
        },
        link_limits);
    service.emplace(flags.common.threads, std::move(cube.source), [&](head::JobEvent event) {
        auto shared = std::make_shared<head::JobEvent>(std::move(event));
        runtime->post(
            [&, shared] { perform(head.handle(std::move(*shared), std::chrono::steady_clock::now())); });
    });
    const auto bound = runtime->hub().listen(listen);
    if (!bound) {
        return daemon::refuse(program, bound.error());
    }
    // For a person, and for the launcher that waits for this line.
    std::printf("listening on %s\n", wire::to_string(*bound).c_str());
    std::fflush(stdout);
    const int status = runtime->run();
    service.reset();
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string program = "shearwater-server";
    CLI::App app("The head of a Shearwater tree: divides a FITS cube over renderers and serves its pictures.",
                 program);
    Flags flags;
    flags.add_to(app);
    if (const auto status = daemon::parse(app, argc, argv)) {
        return *status;
    }
    if (const auto valid = flags.cube.validate(); !valid) {
        return daemon::refuse(program, valid.error());
    }
    const auto topology = flags.tree.topology();
    if (!topology) {
        return daemon::refuse(program, topology.error());
    }
    const auto listen = wire::parse_address(topology->listen, 0);
    if (!listen) {
        return daemon::refuse(program, listen.error());
    }
    const auto secret = flags.common.secret();
    if (!secret) {
        return daemon::refuse(program, secret.error());
    }
    fits::OpenOptions open = flags.cube.open_options();
    open.world = true;
    auto cube = cube::open(flags.cube.path, open);
    if (!cube) {
        return daemon::refuse(program, cube.error());
    }
    auto plan = tree::make_plan(*topology, cube->info.n);
    if (!plan) {
        return daemon::refuse(program, plan.error());
    }
    flags.common.start_log(program);
    for (const std::string& note : cube->info.notes) {
        spdlog::warn("{}: {}", base::printable(flags.cube.path), note);
    }
    head::Roster roster(*std::move(plan), facts_of(cube->info, flags.cube), new_epoch(), flags.cube.bits);
    return serve(program, flags, *secret, *std::move(cube), std::move(roster), *listen);
}
