#include "client/view/preset_shelf.h"

#include <utility>

namespace shearwater::ui {

namespace {

PresetShelf::Outcome outcome_of(const base::Status& status, std::string name, std::string done) {
    return {.names = {},
            .name = std::move(name),
            .loaded = {},
            .message = status ? std::move(done) : status.error().message(),
            .is_fault = !status};
}

}  // namespace

PresetShelf::PresetShelf(PresetFolder folder, std::function<void()> wake)
    : folder_(std::move(folder)),
      wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

PresetShelf::~PresetShelf() {
    thread_.request_stop();
    asked_.notify_all();
    thread_.join();
}

void PresetShelf::list() {
    ask([] { return Outcome{}; });
}

void PresetShelf::load(std::string name) {
    ask([this, name = std::move(name)] {
        auto function = folder_.read(name);
        Outcome outcome = outcome_of(function ? base::Status() : function.error(), name, {});
        if (function) {
            outcome.loaded = *std::move(function);
        }
        return outcome;
    });
}

void PresetShelf::save(std::string name, view::AnchoredFunction function) {
    ask([this, name = std::move(name), function = std::move(function)] {
        return outcome_of(folder_.write(name, function), name, "saved as '" + name + "'");
    });
}

void PresetShelf::rename(std::string from, std::string to) {
    ask([this, from = std::move(from), to = std::move(to)] {
        const base::Status status = folder_.rename(from, to);
        return outcome_of(status, status ? to : from, "renamed to '" + to + "'");
    });
}

void PresetShelf::remove(std::string name) {
    ask([this, name = std::move(name)] {
        return outcome_of(folder_.remove(name), {}, "deleted '" + name + "'");
    });
}

std::optional<PresetShelf::Outcome> PresetShelf::collect() {
    const std::lock_guard lock(mutex_);
    if (outcomes_.empty()) {
        return std::nullopt;
    }
    Outcome outcome = std::move(outcomes_.front());
    outcomes_.pop_front();
    return outcome;
}

void PresetShelf::ask(std::function<Outcome()> task) {
    const std::lock_guard lock(mutex_);
    if (tasks_.size() < most_waiting) {
        tasks_.push_back(std::move(task));
        asked_.notify_one();
    }
}

void PresetShelf::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (asked_.wait(lock, stop, [&] { return !tasks_.empty(); })) {
        const auto task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock();
        Outcome outcome = task();
        outcome.names = folder_.names();
        lock.lock();
        outcomes_.push_back(std::move(outcome));
        wake_();
    }
}

}  // namespace shearwater::ui
