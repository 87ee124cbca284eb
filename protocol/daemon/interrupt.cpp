#include "protocol/daemon/interrupt.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <csignal>
#include <thread>

namespace shearwater::daemon {

struct Interrupt::Waiter {
    boost::asio::io_context io{1};
    boost::asio::signal_set signals{io, SIGINT, SIGTERM};
    std::jthread thread;

    ~Waiter() { io.stop(); }
};

Interrupt::Interrupt() : waiter_(std::make_unique<Waiter>()) {
    waiter_->signals.async_wait([this](const boost::system::error_code& failed, int) {
        if (!failed) {
            source_.request_stop();
        }
    });
    waiter_->thread = std::jthread([waiter = waiter_.get()] { waiter->io.run(); });
}

Interrupt::~Interrupt() = default;

}  // namespace shearwater::daemon
