#pragma once
// Reads and writes what the window keeps, on a thread of its own: the window's never waits for a disk.

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "client/model/status.h"
#include "client/view/autosaves.h"
#include "client/view/errands.h"
#include "common/scene/scene.h"

namespace shearwater::ui {

class Keeper {
  public:
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
    void forget_left_behind();

    // What came of one of these, in their order.
    struct Outcome {
        enum class Kind { said, failed, opened, offered } kind;
        std::string words;                  // what was done, or what is wrong
        std::string path;                   // of what was saved or opened
        std::optional<scene::Scene> scene;  // opened or offered
    };
    std::optional<Outcome> collect() { return errands_.collect(); }

  private:
    std::optional<Autosaves> autosaves_;  // the keeper's thread's; none where nobody has a home
    Errands<Outcome> errands_;
};

}  // namespace shearwater::ui
