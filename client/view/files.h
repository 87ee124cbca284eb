#pragma once
// The window's files as the desk asks for them: sessions, pictures, and what is kept for after a crash.

#include <memory>
#include <string>
#include <vector>

#include "client/model/keeping.h"
#include "client/view/desk.h"
#include "client/view/keeper.h"

namespace shearwater::ui {

class Files {
  public:
    explicit Files(std::function<void()> wake) : keeper_(std::move(wake)) {}

    // Takes over a session that was read from a file.
    static void open(Desk& desk, const std::string& path, const scene::Scene& scene);
    // Once a pass: what has come of earlier wishes, then new ones. `picture`: the last one; `settled`: it is
    // that of the desk's wish, as good as it gets. Files that were dropped on the window are opened.
    void attend(Desk& desk, const std::vector<std::string>& dropped,
                const std::shared_ptr<const model::Picture>& picture, bool settled);

  private:
    void take(Desk& desk, const Keeper::Outcome& outcome);
    static void apply(Desk& desk, const scene::Scene& scene);

    Keeper keeper_;
    model::Autosave autosave_;
    std::optional<scene::Scene> offered_;
    std::optional<std::string> looked_for_;  // the cube's name
    bool picture_wanted_ = false;
};

}  // namespace shearwater::ui
