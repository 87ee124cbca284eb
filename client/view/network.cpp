#include "client/view/network.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>

namespace shearwater::ui {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

// For the goodbye to leave.
constexpr std::chrono::milliseconds patience{300};

Network::Network(const wire::Route& server, model::Redial redial, const std::string& name,
                 link::Secret secret, std::function<void()> wake)
    : wake_(std::move(wake)),
      session_(server, redial, name),
      hub_(io_, std::move(secret), "client", [this](const wire::NetEvent& event) { on_event(event); }) {
    asio::post(io_, [this] {
        session_.start(Clock::now());
        carry_out();
    });
    thread_ = std::jthread([this] {
        const auto work = asio::make_work_guard(io_);
        io_.run();
    });
}

Network::~Network() {
    asio::post(io_, [this] { hub_.shut_down(patience, [this] { io_.stop(); }); });
    thread_.join();
}

void Network::want(const model::Wish& wish, model::Change change) {
    const std::lock_guard lock(mutex_);
    const bool is_posted = wish_.has_value();
    wish_ = WishMail{wish, change};
    if (!is_posted) {
        asio::post(io_, [this] { take_wish(); });
    }
}

void Network::set_effort(const model::Effort& effort) {
    asio::post(io_, [this, effort] {
        session_.set_effort(effort, Clock::now());
        carry_out();
    });
}

void Network::retry() {
    asio::post(io_, [this] {
        session_.retry(Clock::now());
        carry_out();
    });
}

void Network::pick(model::Purpose purpose, const view::Vec2& at) {
    asio::post(io_, [this, purpose, at] {
        session_.pick(purpose, at);
        carry_out();
    });
}

Network::Mail Network::collect() {
    const std::lock_guard lock(mutex_);
    return std::exchange(mail_, {});
}

void Network::on_event(const wire::NetEvent& event) {
    session_.handle(event, Clock::now());
    carry_out();
    if (!std::holds_alternative<wire::Tick>(event)) {
        wake_();
    }
}

void Network::take_wish() {
    std::optional<WishMail> wish;
    {
        const std::lock_guard lock(mutex_);
        wish = std::exchange(wish_, std::nullopt);
    }
    session_.want(wish->wish, wish->change, Clock::now());
    carry_out();
    look_after_rest();
}

// Refinement begins when the view has come to rest, not with the hub's next tick.
void Network::look_after_rest() {
    rest_.expires_after(model::Session::rest_after);
    rest_.async_wait([this](const boost::system::error_code& moved) {
        if (!moved) {
            session_.handle(wire::Tick{}, Clock::now());
            carry_out();
            wake_();
        }
    });
}

void Network::carry_out() {
    for (wire::NetEffect& effect : session_.take_effects()) {
        hub_.perform(std::move(effect));
    }
    auto picture = session_.take_picture();
    const auto picked = session_.take_picked();
    const std::lock_guard lock(mutex_);
    mail_.status = session_.status(Clock::now());
    if (picture) {
        mail_.picture = std::move(picture);
        mail_.picture_wish = session_.picture_wish().value();
    }
    mail_.picked = picked ? picked : mail_.picked;
}

}  // namespace shearwater::ui
