// shearwater-compositor: a junction of the tree. Merges its children's windows in visibility order.

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include "common/base/memory.h"
#include "compositor/junction/junction.h"
#include "protocol/daemon/options.h"
#include "protocol/daemon/runtime.h"
#include "protocol/wire/events.h"

using namespace shearwater;

namespace {

junction::MergeDone carry_out(junction::Merge& merge) {
    return {.windows = node::merge_coded(merge.job)};
}

// So much is merged sooner than another thread wakes up and reports back.
constexpr std::size_t little = std::size_t{1} << 20;

}  // namespace

int main(int argc, char** argv) {
    const std::string program = "shearwater-compositor";
    CLI::App app("A compositor of a Shearwater tree: joins the server and merges its children's windows.",
                 program);
    daemon::MemberFlags flags;
    flags.add_to(app, true);
    if (const auto status = daemon::parse(app, argc, argv)) {
        return *status;
    }
    const auto secret = flags.common.secret();
    if (!secret) {
        return daemon::refuse(program, secret.error());
    }
    auto member = flags.member(wire::pb::ROLE_COMPOSITOR);
    if (!member) {
        return daemon::refuse(program, member.error());
    }
    const auto listen = wire::parse_address(flags.listen, 0);
    if (!listen) {
        return daemon::refuse(program, listen.error());
    }
    flags.common.start_log(program);

    std::optional<junction::Junction> junction;
    boost::asio::thread_pool merging(1);
    std::optional<daemon::Runtime> runtime;
    std::size_t merges_away = 0;  // on the other thread; a little one waits for them, to keep the order
    const std::function<void(junction::Effects)> perform = [&](junction::Effects effects) {
        runtime->perform(std::move(effects.net));
        for (junction::Merge& merge : effects.merges) {
            if (merges_away == 0 && merge.job.bytes() <= little) {
                perform(junction->handle(carry_out(merge)));
                continue;
            }
            ++merges_away;
            boost::asio::post(merging, [&, merge = std::move(merge)]() mutable {
                auto done = std::make_shared<junction::MergeDone>(carry_out(merge));
                runtime->post([&, done] {
                    --merges_away;
                    perform(junction->handle(std::move(*done)));
                });
            });
        }
    };
    link::Limits limits;
    constexpr std::size_t children_at_once = 64;  // as many as a junction has may dial together
    limits.handshakes += children_at_once;
    const auto on_event = [&](const wire::NetEvent& event) {
        if (std::holds_alternative<wire::Tick>(event)) {
            const base::MemoryUse memory = base::memory_use();
            junction->handle(junction::Memory{memory.resident, memory.peak});
        }
        perform(junction->handle(event, std::chrono::steady_clock::now()));
        if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
            const bool orderly = down->reason == wire::pb::REASON_SHUTDOWN;
            spdlog::log(orderly ? spdlog::level::info : spdlog::level::warn, "link down: {}", down->text);
        }
    };
    runtime.emplace(program, *secret, on_event, limits);
    const auto bound = runtime->hub().listen(*listen);
    if (!bound) {
        return daemon::refuse(program, bound.error());
    }
    // Children on other machines reach us where the server sees us, unless we listen at one address only.
    const bool anywhere = listen->host.empty() || listen->host == "0.0.0.0" || listen->host == "::";
    member->listen = {anywhere ? std::string{} : bound->host, bound->port};
    junction.emplace(*member);
    spdlog::info("listening on {}", wire::to_string(*bound));
    perform(junction->start());
    const int status = runtime->run();
    merging.stop();
    merging.join();
    return status;
}
