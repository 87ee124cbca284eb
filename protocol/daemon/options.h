#pragma once
// The options that daemons have in common.

#include <string>

#include "common/base/result.h"
#include "common/options/cli_fwd.h"
#include "protocol/link/secret.h"
#include "protocol/node/member.h"

namespace shearwater::daemon {

struct Options {
    std::string secret_file;
    std::string log_level = "info";
    int threads = 0;  // 0: one a processor

    void add_to(CLI::App& app);
    base::Result<link::Secret> secret() const { return link::Secret::find(secret_file); }
    // Log lines go to standard error, each under the program's name.
    void start_log(const std::string& program) const;
};

// A daemon that joins a server.
struct MemberFlags {
    Options common;
    std::string server;
    std::string node_name;
    std::string listen = "127.0.0.1:0";  // compositors

    void add_to(CLI::App& app, bool listens);
    base::Result<node::MemberOptions> member(wire::pb::Role role) const;
};

// CLI11's parsing with our rules: help ends with 0; a mistake is one line and status 2. Nothing: go on.
std::optional<int> parse(CLI::App& app, int argc, const char* const* argv);

}  // namespace shearwater::daemon
