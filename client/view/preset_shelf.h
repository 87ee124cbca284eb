#pragma once
// The folder of presets on a thread of its own: the window's thread asks, and collects what came of it.

#include <functional>
#include <optional>

#include "client/view/errands.h"
#include "client/view/preset_folder.h"

namespace shearwater::ui {

class PresetShelf {
  public:
    // `wake` is called from the shelf's thread when there is something to collect.
    PresetShelf(PresetFolder folder, std::function<void()> wake)
        : folder_(std::move(folder)), errands_(std::move(wake)) {}

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
    std::optional<Outcome> collect() { return errands_.collect(); }

  private:
    void ask(std::function<Outcome()> task);

    const PresetFolder folder_;
    Errands<Outcome> errands_;
};

}  // namespace shearwater::ui
