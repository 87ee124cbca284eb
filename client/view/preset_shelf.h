#pragma once
// The folder of presets on a thread of its own: the window's thread asks, and collects what came of it.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "client/view/preset_folder.h"

namespace shearwater::ui {

class PresetShelf {
  public:
    // `wake` is called from the shelf's thread when there is something to collect.
    PresetShelf(PresetFolder folder, std::function<void()> wake);
    ~PresetShelf();  // what was asked for is done first
    PresetShelf(const PresetShelf&) = delete;
    PresetShelf& operator=(const PresetShelf&) = delete;

    void list();
    void load(std::string name);
    void save(std::string name, view::AnchoredFunction function);
    void rename(std::string from, std::string to);
    void remove(std::string name);

    // What came of one thing asked for, in their order.
    struct Outcome {
        std::vector<std::string> names;  // that there are now
        std::string name;                // the preset that it is about, or empty
        std::optional<view::AnchoredFunction> loaded;
        std::string message;  // one line for the person, or empty
        bool is_fault = false;
    };
    std::optional<Outcome> collect();

  private:
    static constexpr std::size_t most_waiting = 64;

    void ask(std::function<Outcome()> task);
    void run(const std::stop_token& stop);

    const PresetFolder folder_;
    std::function<void()> wake_;
    std::mutex mutex_;
    std::condition_variable_any asked_;
    std::deque<std::function<Outcome()>> tasks_;
    std::deque<Outcome> outcomes_;
    std::jthread thread_;
};

}  // namespace shearwater::ui
