#include "protocol/daemon/runtime.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <boost/asio/post.hpp>
#include <cstdio>

#include "common/base/memory.h"

namespace shearwater::daemon {

using namespace std::chrono_literals;

std::string process_name(const std::string& program) {
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    return program + "@" + host.data() + ":" + std::to_string(getpid());
}

Runtime::Runtime(const std::string& program, link::Secret secret,
                 std::function<void(wire::NetEvent)> on_event, link::Limits limits)
    : alive_(boost::asio::make_work_guard(io_)), signals_(io_, SIGINT, SIGTERM) {
    base::keep_free_memory();
    hub_.emplace(io_, std::move(secret), process_name(program), std::move(on_event), limits);
    signals_.async_wait([this](const boost::system::error_code& failed, int) {
        if (!failed) {
            stop(0);
        }
    });
}

void Runtime::perform(std::vector<wire::NetEffect> effects) {
    for (wire::NetEffect& effect : effects) {
        hub_->perform(std::move(effect));
    }
}

void Runtime::post(std::function<void()> work) {
    boost::asio::post(io_, std::move(work));
}

int Runtime::run() {
    io_.run();
    return status_;
}

void Runtime::stop(int status) {
    if (stopping_) {
        return;
    }
    stopping_ = true;
    status_ = status;
    hub_->shut_down(2s, [this] { io_.stop(); });
}

int refuse(const std::string& program, const base::Error& error) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), error.message().c_str());
    return 2;
}

}  // namespace shearwater::daemon
