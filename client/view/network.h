#pragma once
// The session and its link, on a thread of their own. The window's thread never waits for them: it leaves
// wishes and collects what came.

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "client/model/session.h"
#include "protocol/link/hub.h"

namespace shearwater::ui {

class Network {
  public:
    // Dials at once; `redial` and `name` as a session has them. `wake` is called from the network's thread
    // when there is something to collect.
    Network(const wire::Route& server, model::Redial redial, const std::string& name, link::Secret secret,
            std::function<void()> wake);
    // Says goodbye. May take as long as a search for an address that is under way.
    ~Network();
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;

    // The newest wish wins.
    void want(const model::Wish& wish, model::Change change);
    void set_effort(const model::Effort& effort);
    void retry();
    // What is to be seen at a point of the picture that is wanted.
    void pick(model::Purpose purpose, const view::Vec2& at);

    // The newest of each, given once.
    struct Mail {
        std::optional<model::Status> status;
        std::optional<model::Picture> picture;
        model::Wish picture_wish;  // what the picture is of
        std::optional<model::Picked> picked;
    };
    Mail collect();

  private:
    struct WishMail {
        model::Wish wish;
        model::Change change;
    };

    void on_event(const wire::NetEvent& event);
    void take_wish();
    void look_after_rest();
    void carry_out();

    boost::asio::io_context io_{1};
    std::function<void()> wake_;
    model::Session session_;  // the network thread's
    link::Hub hub_;           // the network thread's
    boost::asio::steady_timer rest_{io_};

    std::mutex mutex_;
    std::optional<WishMail> wish_;
    Mail mail_;

    std::jthread thread_;
};

}  // namespace shearwater::ui
