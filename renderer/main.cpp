// shearwater-renderer: a leaf of the tree. Holds a share of the cube and renders windows of it.

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "protocol/daemon/options.h"
#include "protocol/daemon/runtime.h"
#include "protocol/wire/words.h"
#include "renderer/cache/function_cache.h"
#include "renderer/jobs/jobs.h"
#include "renderer/leaf/leaf.h"

using namespace shearwater;

int main(int argc, char** argv) {
    const std::string program = "shearwater-renderer";
    CLI::App app("A renderer of a Shearwater tree: joins the server and draws its share of the cube.",
                 program);
    daemon::MemberFlags flags;
    flags.add_to(app, false);
    std::string kept = cache::default_folder().value_or("off");
    app.add_option("--function-cache", kept,
                   "the folder that opacity functions are kept in for the next time, up to 1 GiB, or off")
        ->type_name("DIR|off")
        ->capture_default_str();
    if (const auto status = daemon::parse(app, argc, argv)) {
        return *status;
    }
    const auto secret = flags.common.secret();
    if (!secret) {
        return daemon::refuse(program, secret.error());
    }
    const auto member = flags.member(wire::pb::ROLE_RENDERER);
    if (!member) {
        return daemon::refuse(program, member.error());
    }
    flags.common.start_log(program);

    leaf::Leaf leaf(*member);
    std::optional<jobs::Jobs> jobs;
    std::optional<daemon::Runtime> runtime;
    wire::pb::Phase said = wire::pb::PHASE_VACANT;
    const auto perform = [&](leaf::Effects effects) {
        runtime->perform(std::move(effects.net));
        for (leaf::Effect& effect : effects.jobs) {
            jobs->perform(std::move(effect));
        }
        if (leaf.phase() != said) {
            said = leaf.phase();
            spdlog::info("{} {}", wire::text_of(said), leaf.error());
        }
    };
    runtime.emplace(program, *secret, [&](wire::NetEvent event) {
        perform(leaf.handle(event, std::chrono::steady_clock::now()));
        if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
            const bool orderly = down->reason == wire::pb::REASON_SHUTDOWN;
            spdlog::log(orderly ? spdlog::level::info : spdlog::level::warn, "link down: {}", down->text);
        }
    });
    const auto tell = [&](leaf::JobEvent event) {
        auto shared = std::make_shared<leaf::JobEvent>(std::move(event));
        runtime->post(
            [&, shared] { perform(leaf.handle(std::move(*shared), std::chrono::steady_clock::now())); });
    };
    jobs.emplace(flags.common.threads, tell,
                 kept == "off" ? std::nullopt
                               : std::optional(cache::FunctionCache(
                                     kept, [](const std::string& line) { spdlog::warn("{}", line); })));
    perform(leaf.start());
    const int status = runtime->run();
    jobs.reset();
    return status;
}
