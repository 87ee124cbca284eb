#include "deploy/bench/options.h"

#include <CLI/CLI.hpp>

#include "deploy/bench/workload.h"
#include "deploy/target.h"

namespace shearwater::bench {

namespace {

const CLI::Range edge_range(std::int64_t{2}, std::int64_t{1} << 20);

}  // namespace

void Options::add_json(CLI::App& app) {
    app.add_option("--json", json,
                   "lines of JSON into this file; - for standard output instead of the table");
}

void Options::add_threads(CLI::App& app) {
    app.add_option("--threads", threads, "threads that compute; 0: one a processor")
        ->check(CLI::Range(0, 1024));
}

void Options::add_frames(CLI::App& app) {
    app.add_option("--frames", frames, "pictures measured, after one that is not")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
}

void Options::add_in_flight(CLI::App& app) {
    app.add_option("--in-flight", in_flight,
                   "pictures asked for and not yet seen; 2: as a window that is turned has them")
        ->check(CLI::Range(1, 2))
        ->capture_default_str();
}

void Options::add_image(CLI::App& app) {
    app.add_option("--image", image, "size of the picture, WIDTHxHEIGHT pixels")->capture_default_str();
}

void Options::add_quality(CLI::App& app) {
    app.add_option("--quality", quality, "intermediate pixels per pixel: half, one, one and a half")
        ->check(CLI::IsMember({"draft", "normal", "high"}))
        ->capture_default_str();
}

void Options::add_pictures(CLI::App& app) {
    add_frames(app);
    add_image(app);
    add_quality(app);
    drawing.add_classify(app);
    drawing.add_lod(app);
    add_threads(app);
    add_json(app);
}

base::Result<deploy::ViewOptions> Options::view(std::int64_t edge) const {
    deploy::ViewOptions made = first_view(edge);
    made.size = image;
    made.quality = quality;
    made.drawing = drawing;
    if (const auto camera = made.camera({.n = {edge, edge, edge}}); !camera) {
        return base::error(camera.error().code, "--image " + image, camera.error().detail);
    }
    return made;
}

void add_workload(CLI::App& app, std::string& name) {
    app.add_option("--workload", name, "what is drawn")
        ->check(CLI::IsMember(workload_names()))
        ->capture_default_str();
}

void add_size(CLI::App& app, std::int64_t& edge) {
    app.add_option("--size", edge, "the cube's voxels along each axis")
        ->check(edge_range)
        ->capture_default_str();
}

void add_sizes(CLI::App& app, std::vector<std::int64_t>& edges) {
    app.add_option("--sizes", edges, "the cubes' voxels along each axis, with commas between")
        ->delimiter(',')
        ->check(edge_range)
        ->capture_default_str();
}

std::string cube_text(const volume::Index3& n) {
    return std::to_string(n[0]) + "x" + std::to_string(n[1]) + "x" + std::to_string(n[2]);
}

int status_of(const std::string& benchmark, const base::Status& done) {
    return done ? 0 : deploy::refuse("shearwater bench " + benchmark, done.error());
}

}  // namespace shearwater::bench
