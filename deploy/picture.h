#pragma once
// A finished still and what it cost, wherever it was made.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/image/image.h"

namespace shearwater::deploy {

// Seconds; medians where a picture was drawn several times.
struct Seconds {
    double load = 0;        // until the first picture could be drawn
    double preprocess = 0;  // of it, in process: finding the limits
    double look = 0;        // finding out what is visible
    double render = 0;      // the slowest renderer's
    double composite = 0;   // coding windows and merging them, on the slowest path
    double warp = 0;
    double encode = 0;
    double total = 0;     // from the request to the decoded picture
    double interval = 0;  // from the decoded picture before, or, for the first, from the request
};

struct ProcessMemory {
    std::string name;
    std::uint64_t peak_bytes = 0;
};

struct Picture {
    image::Image<image::Rgba8> image;
    Seconds seconds;
    std::vector<Seconds> each;  // of every time that it was drawn
    std::uint64_t samples = 0;
    std::uint64_t bricks_total = 0, bricks_empty = 0, bricks_culled = 0, bricks_rendered = 0;
    std::string culling_by = "nobody";  // who found out what is visible: server, renderers or process
    std::uint64_t window_bytes = 0;     // up the tree, all links
    std::uint64_t frame_bytes = 0;      // to the client
    std::vector<ProcessMemory> memory;
    std::string tree;
};

// Each figure of the pictures' seconds replaced by its median; the rest is the last one's.
Seconds median(const std::vector<Seconds>& all);

// The report of design section 4, one line of JSON.
std::string to_json(const Picture& picture);

}  // namespace shearwater::deploy
