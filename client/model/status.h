#pragma once
// What the session knows, for the panel to show.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/view/factorisation.h"
#include "common/view/value_scale.h"
#include "common/volume/mapping.h"
#include "common/volume/summary.h"
#include "common/wcs/axis.h"
#include "protocol/wire/shearwater.pb.h"

namespace shearwater::model {

struct Cube {
    std::string name, object, unit;  // printable
    view::Lattice lattice;
    volume::Mapping mapping;
    bool provisional = false;                       // its limits, which are those of a sketch
    std::shared_ptr<const volume::Summary> values;  // null until any are counted
    bool provisional_values = false;                // they are those of a sketch
    std::shared_ptr<const wcs::Axes> world = std::make_shared<const wcs::Axes>();  // of its axes

    view::ValueScale scale() const { return view::ValueScale(mapping, values); }
};

struct Node {
    std::uint32_t place = 0;
    int depth = 0;  // 0: the server
    wire::pb::Role role = wire::pb::ROLE_UNKNOWN;
    std::string name;  // printable
    volume::Box box;
    wire::pb::Phase phase = wire::pb::PHASE_VACANT;
    double fraction = 0;  // of the phase, 0 to 1
    std::uint64_t memory_bytes = 0;
    std::string error;  // printable
};

// The tree, every node before its children.
struct Tree {
    std::vector<Node> nodes;
    bool ready = false;

    // Renderers' progress over both passes, 0 to 1.
    double loaded() const;
    int in_phase(wire::pb::Phase phase) const;
    int renderers() const;
};

struct Missing {
    std::uint32_t place = 0;
    volume::Box box;
};

// Where a frame's time went (DVR Fig. 8), seconds. Stages overlap, so that their sum may be more than it
// took.
struct Stages {
    double look = 0;       // finding out what is visible
    double render = 0;     // the slowest renderer's
    double composite = 0;  // coding windows and merging them, on the slowest path
    double warp = 0;
    double code = 0;
    double link = 0;  // from the server and back, and whatever the view waited for there
};

// The last frame, without its pixels.
struct FrameNote {
    std::uint64_t revision = 0;
    view::ImageSize size;
    view::Quality quality = view::Quality::normal;
    std::vector<Missing> missing;  // empty: the picture is whole
    bool sketch = false;           // of a sketch of the cube, which is loading: its picture will follow
    std::size_t bytes = 0;         // as it travelled
    Stages stages;
    std::uint64_t samples = 0;
    // Bricks with opacity, and of those how many are left out since others hide them.
    std::uint64_t opaque_bricks = 0, culled_bricks = 0;
};

// Means over the last two seconds; a latency is the time from sending a view to having its picture.
struct Rates {
    double frames_per_second = 0;  // 0 while nothing moves
    double latency_seconds = 0;
    double bytes_per_frame = 0;
};

enum class Connection {
    none,  // nobody has been dialled
    connecting,
    connected,
    waiting,  // to dial again
    refused,  // dialling again would not help
};

struct Status {
    Connection connection = Connection::none;
    std::string words;       // what became of the link, for a person
    double retry_in = 0;     // seconds, while waiting
    std::uint64_t sent = 0;  // revision of the newest view that left
    std::optional<Cube> cube;
    Tree tree;
    std::optional<FrameNote> frame;
    Rates rates;
    std::optional<double> link_speed;  // bytes a second
    bool refining = false;             // the view rests and a better picture of it is to come

    // "first look, 43 % loaded" while the last picture is of a sketch; else empty.
    std::string first_look() const;
};

// A decoded picture.
struct Picture {
    std::uint64_t revision = 0;
    view::Quality quality = view::Quality::normal;
    bool whole = true;
    image::Image<image::Rgba8> pixels;  // of two eyes: the left one's
    image::Image<image::Rgba8> right;   // empty: it is one picture
};

}  // namespace shearwater::model
