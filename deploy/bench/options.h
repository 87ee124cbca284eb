#pragma once
// The options that benchmarks have in common.

#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/options/cli_fwd.h"
#include "deploy/view_options.h"

namespace shearwater::bench {

struct Options {
    int frames = 10;
    int threads = 0;
    int in_flight = 1;
    std::string image = "512x512";
    std::string quality = "normal";
    options::DrawingOptions drawing{.lod = "on"};
    std::string json;

    void add_json(CLI::App& app);
    void add_threads(CLI::App& app);
    void add_frames(CLI::App& app);
    void add_in_flight(CLI::App& app);
    void add_image(CLI::App& app);
    void add_quality(CLI::App& app);
    // What benchmarks of whole pictures take: all of it but how many are in flight.
    void add_pictures(CLI::App& app);

    // first_view with these options' image, quality and ways of drawing, checked.
    base::Result<deploy::ViewOptions> view(std::int64_t edge) const;
};

void add_workload(CLI::App& app, std::string& name);
void add_size(CLI::App& app, std::int64_t& edge);
// Several of them, with commas between.
void add_sizes(CLI::App& app, std::vector<std::int64_t>& edges);

// "512x512x512"
std::string cube_text(const volume::Index3& n);

// Ends a benchmark: 0, or the status of what went wrong after telling it.
int status_of(const std::string& benchmark, const base::Status& done);

}  // namespace shearwater::bench
