#include "tests/support/held_renderer.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <chrono>
#include <utility>

namespace shearwater::support {

using Clock = std::chrono::steady_clock;

HeldRenderer::HeldRenderer(const wire::Address& server, const link::Secret& secret,
                           const std::string& node_name)
    : leaf_({.server = server, .role = wire::pb::ROLE_RENDERER, .node_name = node_name}) {
    hub_.emplace(io_, secret, "held renderer",
                 [this](const wire::NetEvent& event) { perform(leaf_.handle(event, Clock::now())); });
    jobs_.emplace(1, [this](leaf::JobEvent event) {
        boost::asio::post(io_, [this, shared = std::make_shared<leaf::JobEvent>(std::move(event))] {
            perform(leaf_.handle(std::move(*shared), Clock::now()));
        });
    });
    perform(leaf_.start());
    thread_ = std::jthread([this] {
        const auto alive = boost::asio::make_work_guard(io_);
        io_.run();
    });
}

HeldRenderer::~HeldRenderer() {
    io_.stop();
    thread_.join();
    jobs_.reset();
}

void HeldRenderer::let_load() {
    boost::asio::post(io_, [this] {
        held_ = false;
        for (leaf::Effect& effect : std::exchange(waiting_, {})) {
            jobs_->perform(std::move(effect));
        }
    });
}

void HeldRenderer::perform(leaf::Effects effects) {
    for (wire::NetEffect& effect : effects.net) {
        hub_->perform(std::move(effect));
    }
    for (leaf::Effect& effect : effects.jobs) {
        if (held_ && std::holds_alternative<leaf::Load>(effect)) {
            waiting_.push_back(std::move(effect));
        } else {
            jobs_->perform(std::move(effect));
        }
    }
}

}  // namespace shearwater::support
