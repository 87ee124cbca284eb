#pragma once
// Small tasks on a thread of their own, one after the other: the window's thread asks, never waits for a
// disk, and collects what came of them.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace shearwater::ui {

template <class Outcome>
class Errands {
  public:
    static constexpr std::size_t most_waiting = 64;  // tasks; more are dropped

    // `wake` is called from the errands' thread when there is something to collect.
    explicit Errands(std::function<void()> wake)
        : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { run(stop); }) {}
    ~Errands() { finish(); }
    Errands(const Errands&) = delete;
    Errands& operator=(const Errands&) = delete;

    // A task may tell nothing.
    void ask(std::function<std::optional<Outcome>()> task) {
        const std::lock_guard lock(mutex_);
        if (tasks_.size() < most_waiting) {
            tasks_.push_back(std::move(task));
            asked_.notify_one();
        }
    }
    // What came of one task, in their order.
    std::optional<Outcome> collect() {
        const std::lock_guard lock(mutex_);
        if (outcomes_.empty()) {
            return std::nullopt;
        }
        Outcome outcome = std::move(outcomes_.front());
        outcomes_.pop_front();
        return outcome;
    }
    // Does what was asked for, and then nothing more.
    void finish() {
        if (thread_.joinable()) {
            thread_.request_stop();
            asked_.notify_all();
            thread_.join();
        }
    }

  private:
    void run(const std::stop_token& stop) {
        std::unique_lock lock(mutex_);
        while (asked_.wait(lock, stop, [this] { return !tasks_.empty(); })) {
            const auto task = std::move(tasks_.front());
            tasks_.pop_front();
            lock.unlock();
            std::optional<Outcome> outcome = task();
            lock.lock();
            if (outcome) {
                outcomes_.push_back(*std::move(outcome));
                wake_();
            }
        }
    }

    std::function<void()> wake_;
    std::mutex mutex_;
    std::condition_variable_any asked_;
    std::deque<std::function<std::optional<Outcome>()>> tasks_;
    std::deque<Outcome> outcomes_;
    std::jthread thread_;
};

}  // namespace shearwater::ui
