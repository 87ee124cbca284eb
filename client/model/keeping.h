#pragma once
// What is kept of a window: for undo, in a file, and in one that is left behind should the window not end
// well.

#include <optional>
#include <string>

#include "client/model/crop.h"
#include "client/model/session.h"
#include "common/scene/scene.h"

namespace shearwater::model {

// What undo and redo change.
struct Remembered {
    Viewpoint viewpoint;
    view::TransferFunction tf;
    Crop crop;
    std::optional<volume::Scaling> scaling;
    bool operator==(const Remembered&) const = default;
};
Remembered remembered(const Wish& wish);
void restore(const Remembered& state, Wish& wish);

// What a file keeps; `cube` is its name. A picture's size is that of the window, and stays so; how a pair is
// shown is the window's to say.
scene::Scene scene_of(const Wish& wish, const Effort& effort, const std::string& cube);
void apply(const scene::Scene& scene, Wish& wish, Effort& effort);

// The name that files of a cube's have by default, without an ending: of letters, digits, '.', '-' and '_'.
std::string stem_for(const Cube& cube);

// ---- left behind after a crash ----

// A window keeps its scene in a file of its own while it is open, and removes it at its end: the `number`th
// of those on the cube.
std::string autosave_name(const Cube& cube, int number);
// Whether that is the name of a file that some window on the cube keeps.
bool is_autosave(const std::string& name, const Cube& cube);

// When to keep it.
class Autosave {
  public:
    static constexpr std::chrono::seconds interval{3};

    // Whether the scene is to be written now: it has changed, and the last time is long enough ago. What it
    // was at first needs no keeping.
    bool due(const scene::Scene& scene, wire::Time now);

  private:
    std::optional<scene::Scene> kept_;
    wire::Time kept_at_{};
};

}  // namespace shearwater::model
