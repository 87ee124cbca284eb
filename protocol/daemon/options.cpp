#include "protocol/daemon/options.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <thread>

#include "protocol/wire/events.h"

namespace shearwater::daemon {

void Options::add_to(CLI::App& app) {
    app.add_option("--secret-file", secret_file,
                   "file of mode 0600 with the tree's secret (else the environment's SHEARWATER_SECRET)");
    app.add_option("--log", log_level, "how much to log")
        ->check(CLI::IsMember({"debug", "info", "warn", "error", "off"}))
        ->capture_default_str();
    app.add_option("--threads", threads, "threads that compute; 0: one a processor")
        ->check(CLI::Range(0, 1024));
}

void Options::start_log(const std::string& program) const {
    auto logger = spdlog::stderr_logger_mt(program);
    logger->set_pattern("%H:%M:%S.%e %n %l: %v");
    logger->set_level(spdlog::level::from_str(log_level == "warn" ? "warning" : log_level));
    spdlog::set_default_logger(std::move(logger));
}

void MemberFlags::add_to(CLI::App& app, bool listens) {
    common.add_to(app);
    app.add_option("--server", server, "HOST:PORT of the tree's server")->required();
    app.add_option("--node", node_name, "the topology's node to be; else any vacant place");
    if (listens) {
        app.add_option("--listen", listen, "ADDR:PORT where children dial; port 0: a free one")
            ->capture_default_str();
    }
}

base::Result<node::MemberOptions> MemberFlags::member(wire::pb::Role role) const {
    const auto address = wire::parse_address(server, 0);
    if (!address) {
        return address.error();
    }
    const int count =
        common.threads > 0 ? common.threads : static_cast<int>(std::thread::hardware_concurrency());
    return node::MemberOptions{.server = *address,
                               .role = role,
                               .node_name = node_name,
                               .listen = {},
                               .threads = static_cast<unsigned>(std::max(1, count))};
}

std::optional<int> parse(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::CallForVersion& version) {
        return app.exit(version);
    } catch (const CLI::ParseError& mistake) {
        std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(),
                     base::printable(mistake.what(), 400).c_str());
        return 2;
    }
    return std::nullopt;
}

}  // namespace shearwater::daemon
