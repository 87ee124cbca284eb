// A window's session on a slow link: how many pictures come while a cube is turned, and how late.
//
//   link_bench [MBIT/S] [ROUND TRIP MS] [SECONDS]       without figures: the links below, one by one

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdlib>
#include <map>
#include <vector>

#include "client/model/session.h"
#include "deploy/bench/workload.h"
#include "deploy/local_tree.h"
#include "protocol/link/hub.h"
#include "tests/support/slow_link.h"

namespace shearwater {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;
using namespace std::chrono_literals;

struct Turned {
    double pictures_per_second = 0;
    double median_lag = 0, worst_lag = 0;  // seconds from the turn to its picture
    double bytes = 0;                      // a picture
    view::ImageSize last;                  // size of the last while it moved
    double whole_after = 0;                // seconds from the last turn to the whole high picture
};

// A hand that drags turns by a degree every 16 ms; one that steps, 100 ms after it has seen what the last
// step did: by a degree, or the height of the first pin.
enum class Hand { drags, turns, moves_pin };

class Orbiting {
  public:
    Orbiting(const wire::Address& server, const link::Secret& secret, const view::TransferFunction& tf,
             std::chrono::seconds time, Hand hand)
        : session_(server),
          hub_(io_, link::Secret(secret), "link bench", [this](const wire::NetEvent& event) { on(event); }),
          timer_(io_),
          time_(time),
          hand_(hand) {
        wish_.tf = tf;
        wish_.size = {512, 512};
    }

    Turned run() {
        session_.start(Clock::now());
        carry_out();
        turn();
        io_.run_for(time_ + 60s);
        std::ranges::sort(lags_);
        turned_.pictures_per_second = static_cast<double>(lags_.size()) / Seconds(end_ - begin_).count();
        turned_.bytes = bytes_ / static_cast<double>(std::max<std::size_t>(1, lags_.size()));
        if (!lags_.empty()) {
            turned_.median_lag = lags_[lags_.size() / 2];
            turned_.worst_lag = lags_.back();
        }
        return turned_;
    }

  private:
    void on(const wire::NetEvent& event) {
        session_.handle(event, Clock::now());
        carry_out();
    }

    void turn() {
        timer_.expires_after(16ms);
        timer_.async_wait([this](const boost::system::error_code&) {
            const auto now = Clock::now();
            // The first seconds are for getting to know the link.
            constexpr auto settling = 3s;
            if (session_.status(now).tree.ready && begin_ == Clock::time_point{}) {
                begin_ = now + settling;
                end_ = begin_ + time_;
            }
            const bool is_due = hand_ == Hand::drags || now - seen_at_ >= 100ms;
            if (is_due && (begin_ == Clock::time_point{} || now < end_)) {
                step();
                turned_at_ = now;
                seen_at_ = Clock::time_point::max();
                session_.want(wish_, model::Change::dragging, now);
            } else {
                session_.handle(wire::Tick{}, now);
            }
            carry_out();
            turn();
        });
    }

    void step() {
        if (hand_ != Hand::moves_pin) {
            wish_.viewpoint.orbit.azimuth += 1;
            return;
        }
        raised_ = !raised_;
        const double height = raised_ ? 0.021 : 0.02;
        wish_.tf.opacity_pins.at(0) = view::Ramp{0, height, 1, height};
    }

    void carry_out() {
        for (wire::NetEffect& effect : session_.take_effects()) {
            if (const auto* send = std::get_if<wire::Send>(&effect)) {
                if (const auto* view = std::get_if<wire::pb::SetView>(&send->message.body)) {
                    asked_[view->revision()] = turned_at_;
                }
            }
            hub_.perform(std::move(effect));
        }
        const auto picture = session_.take_picture();
        const auto now = Clock::now();
        if (picture && asked_[picture->revision] == turned_at_ && seen_at_ == Clock::time_point::max()) {
            seen_at_ = now;
        }
        if (!picture || begin_ == Clock::time_point{}) {
            return;
        }
        if (now >= begin_ && now < end_) {
            lags_.push_back(Seconds(now - asked_[picture->revision]).count());
            bytes_ += static_cast<double>(session_.status(now).frame->bytes);
            turned_.last = {picture->pixels.width(), picture->pixels.height()};
        } else if (now >= end_ && picture->quality == view::Quality::high &&
                   picture->pixels.width() == wish_.size.width) {
            turned_.whole_after = Seconds(now - end_).count();
            io_.stop();
        }
    }

    boost::asio::io_context io_{1};
    model::Session session_;
    link::Hub hub_;
    boost::asio::steady_timer timer_;
    std::chrono::seconds time_;
    Hand hand_;
    bool raised_ = false;
    model::Wish wish_;
    std::map<std::uint64_t, Clock::time_point> asked_;
    Clock::time_point begin_{}, end_{}, turned_at_{}, seen_at_{};
    std::vector<double> lags_;
    double bytes_ = 0;
    Turned turned_;
};

struct Link {
    double megabits, round_trip;
    Hand hand = Hand::drags;
};

int run(const std::vector<Link>& links, std::chrono::seconds time) {
    constexpr std::int64_t edge = 256;
    constexpr std::array names{"drags", "turns", "pin"};
    fmt::print("{:>4} {:>6} {:>10} {:>8} {:>11} {:>8} {:>8} {:>9} {:>9} {:>8}\n", "cube", "hand", "Mbit/s",
               "ms", "pictures/s", "lag ms", "worst", "kB each", "size", "whole s");
    for (const char* name : {"W1", "W2"}) {
        const bench::Workload drawn = bench::workload(name);
        const link::Secret secret = link::Secret::random();
        deploy::LocalTree::Options options{.cube = drawn.cube(edge), .tree = {}, .log_level = "warn"};
        options.tree.tree = {2, 2};
        auto tree = deploy::LocalTree::start(options, secret);
        if (!tree) {
            fmt::print(stderr, "link_bench: {}\n", tree.error().message());
            return 2;
        }
        for (const auto& [megabits, round_trip, hand] : links) {
            test::SlowLink link(tree->address(), {megabits * 1e6 / 8, Seconds(round_trip / 2000)});
            const Turned turned = Orbiting(link.address(), secret, drawn.tf, time, hand).run();
            fmt::print("{:>4} {:>6} {:>10.0f} {:>8.0f} {:>11.1f} {:>8.0f} {:>8.0f} {:>9.0f} {:>9} {:>8.1f}\n",
                       name, names.at(static_cast<std::size_t>(hand)), megabits, round_trip,
                       turned.pictures_per_second, turned.median_lag * 1e3, turned.worst_lag * 1e3,
                       turned.bytes / 1e3, fmt::format("{}x{}", turned.last.width, turned.last.height),
                       turned.whole_after);
        }
    }
    return 0;
}

}  // namespace
}  // namespace shearwater

int main(int argc, char** argv) {
    const auto number = [&](int i, double otherwise) { return argc > i ? std::atof(argv[i]) : otherwise; };
    const std::chrono::seconds time(static_cast<int>(number(3, 8)));
    if (argc > 1) {
        return shearwater::run({{number(1, 100), number(2, 20)}}, time);
    }
    using enum shearwater::Hand;
    return shearwater::run({{10000, 0, turns}, {10000, 0, moves_pin}, {10000, 0}, {100, 20}, {10, 20}}, time);
}
