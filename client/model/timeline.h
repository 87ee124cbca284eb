#pragma once
// A flight path as a person makes it: key frames taken from the view, moved along the time, and played.

#include <optional>

#include "common/flight/path.h"
#include "protocol/wire/events.h"

namespace shearwater::model {

class Timeline {
  public:
    static constexpr double longest = 3600;  // seconds

    const flight::Path& path() const { return path_; }
    void set_path(flight::Path path);
    void set_fps(int fps);
    bool empty() const { return path_.keys.empty(); }
    double duration() const { return empty() ? 0 : path_.keys.back().time; }
    // Of the strip that is shown: room for another key behind the last.
    double span() const;

    // Where the needle is, seconds; brought to a frame, and between 0 and the longest time.
    double at() const { return at_; }
    void seek(double time);

    // A key of this view where the needle is, in the place of one that is there. The first goes to 0.
    void keep(const flight::Seen& seen);
    std::optional<std::size_t> selected() const { return selected_; }
    void select(std::size_t key);  // the needle goes there
    // The selected key: to another time, a frame from its neighbours at least (the first stays); away, and
    // what is behind the first then begins at 0.
    void move_selected(double time);
    void remove_selected();

    // From the needle to the end, or once more from the begin.
    void play(wire::Time now);
    void pause() { played_from_.reset(); }
    bool playing() const { return played_from_.has_value(); }
    // While it plays: moves the needle, and what is to be seen there. It ends at the last key. Limits go from
    // key to key in steps meanwhile, for with every other voxels are read anew.
    std::optional<flight::Seen> advance(wire::Time now, const view::Lattice& lattice);
    // At the needle.
    std::optional<flight::Seen> seen(const view::Lattice& lattice) const;

  private:
    struct Begun {
        wire::Time when;
        double at;
    };

    double frame() const { return 1.0 / path_.fps; }
    std::optional<std::size_t> key_at(double time) const;

    flight::Path path_;
    double at_ = 0;
    std::optional<std::size_t> selected_;
    std::optional<Begun> played_from_;
};

}  // namespace shearwater::model
