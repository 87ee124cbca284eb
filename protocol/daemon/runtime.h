#pragma once
// What every daemon's main needs around its state machine: one network thread, links, signals, a log.

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <functional>
#include <optional>
#include <string>

#include "protocol/link/hub.h"
#include "protocol/wire/events.h"

namespace shearwater::daemon {

class Runtime {
  public:
    // on_event is called on the thread in run(). `program` names the process to its peers.
    Runtime(const std::string& program, link::Secret secret, std::function<void(wire::NetEvent)> on_event,
            link::Limits limits = {});

    link::Hub& hub() { return *hub_; }
    void perform(std::vector<wire::NetEffect> effects);

    // Runs `work` on the network thread, soon; may be called from any thread.
    void post(std::function<void()> work);

    // Until SIGINT, SIGTERM or stop(): then links are drained and closed. Returns the exit status.
    int run();
    void stop(int status);

  private:
    boost::asio::io_context io_{1};
    boost::asio::executor_work_guard<boost::asio::io_context::executor_type> alive_;
    boost::asio::signal_set signals_;
    std::optional<link::Hub> hub_;
    int status_ = 0;
    bool stopping_ = false;
};

// "host:process id", for peers to show.
std::string process_name(const std::string& program);

// One line "program: message" to standard error and the exit status of a user's mistake, 2.
int refuse(const std::string& program, const base::Error& error);

}  // namespace shearwater::daemon
