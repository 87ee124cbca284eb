#pragma once
// Reads and writes what the window keeps, on a thread of its own: the window's never waits for a disk.

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/model/keeping.h"
#include "client/model/status.h"
#include "common/scene/scene.h"

namespace shearwater::ui {

class Keeper {
  public:
    static constexpr std::size_t most_waiting = 32;  // jobs; more are dropped

    // `wake` is called from the keeper's thread when there is something to collect.
    explicit Keeper(std::function<void()> wake);
    ~Keeper();  // finishes what is asked for, and forgets the autosave: this window has ended well
    Keeper(const Keeper&) = delete;
    Keeper& operator=(const Keeper&) = delete;

    void save(const std::string& path, const scene::Scene& scene);
    void open(const std::string& path);
    // To PATH.png, or PATH-2.png and so on: no picture is written over.
    void save_picture(const std::string& path, const scene::Scene& scene,
                      std::shared_ptr<const model::Picture> picture);
    // Keeps the scene for after a crash, of this window on a cube.
    void autosave(const model::Cube& cube, const scene::Scene& scene);
    // What windows on the cube have left behind that did not end well: the newest is offered.
    void look_for(const model::Cube& cube);
    void forget(const std::string& path);

    // What came of it all since the last call.
    struct Outcome {
        enum class Kind { said, failed, opened, offered } kind;
        std::string words;  // what was done, or what is wrong
        std::string path;
        std::optional<scene::Scene> scene;  // opened or offered
    };
    std::vector<Outcome> collect();

  private:
    void later(std::function<void()> job);
    void tell(Outcome outcome);
    void run(const std::stop_token& stop);
    void offer_newest(const model::Cube& cube);

    std::function<void()> wake_;
    std::string autosaved_;  // the keeper's thread's
    std::mutex mutex_;
    std::condition_variable_any more_;
    std::deque<std::function<void()>> jobs_;
    std::vector<Outcome> outcomes_;
    std::jthread thread_;
};

}  // namespace shearwater::ui
