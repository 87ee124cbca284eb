#pragma once
// Ctrl-C as a stop token, for commands that compute in the main thread.

#include <memory>
#include <stop_token>

namespace shearwater::daemon {

// While one lives, SIGINT and SIGTERM request a stop instead of ending the process. One at a time.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    std::stop_token token() const { return source_.get_token(); }

  private:
    struct Waiter;
    std::stop_source source_;
    std::unique_ptr<Waiter> waiter_;
};

}  // namespace shearwater::daemon
