#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

#include "common/flight/path_toml.h"
#include "deploy/commands.h"
#include "deploy/film.h"
#include "deploy/frame_folder.h"
#include "deploy/one_process.h"
#include "deploy/over_links.h"
#include "deploy/progress_bar.h"
#include "deploy/target.h"

namespace shearwater::deploy {
namespace {

namespace fs = std::filesystem;

const std::string movie_program = "shearwater movie";

struct MovieFlags {
    std::string path_file;
    TargetOptions target;
    ViewOptions view;
    std::string output;
    bool anew = false;
    bool keep_frames = false;
};

// Size and time of a file: another cube by the same name is another movie.
std::string stamp_of(const std::string& path) {
    std::error_code failed;
    const auto bytes = fs::file_size(path, failed);
    if (failed) {
        return {};
    }
    const auto changed = fs::last_write_time(path, failed).time_since_epoch().count();
    return fmt::format(", {} bytes of {}", bytes, changed);
}

// Whatever the frames depend on, as a text.
std::string description_of(const flight::Path& path, const MovieFlags& flags) {
    std::string text = "#";
    for (const std::string& word : flags.view.picture_arguments()) {
        text += " " + word;
    }
    for (const options::CubeOptions& cube : path.cubes) {
        text += fmt::format("\n# {}{}", cube.path, stamp_of(cube.path));
    }
    if (!flags.target.connect.empty()) {
        text += "\n# by " + flags.target.connect;
    }
    return text + "\n" + flight::to_toml(path);
}

// The path's cubes, or the one of the command line for all its keys.
base::Result<flight::Path> path_of(const MovieFlags& flags) {
    auto path = flight::read_path(flags.path_file);
    if (!path) {
        return path.error();
    }
    const bool named = !flags.target.cube.path.empty() || !flags.target.connect.empty();
    if (named == !path->cubes.empty()) {
        return base::error(base::Code::invalid_argument, flags.path_file,
                           named ? "it names its cubes itself: leave out the cube and --connect"
                                 : "it names no cube: give one, or --connect HOST:PORT");
    }
    if (named) {
        if (const auto valid = flags.target.validate(); !valid) {
            return valid.error();
        }
        if (flags.target.connect.empty()) {
            path->cubes = {flags.target.cube};
        }
        for (flight::Key& key : path->keys) {
            if (key.cube != 0) {
                return base::error(base::Code::invalid_argument, flags.path_file, "there is but one cube");
            }
        }
    }
    return path;
}

class Movie {
  public:
    Movie(const MovieFlags& flags, flight::Path path, FrameFolder folder)
        : flags_(flags), path_(std::move(path)), folder_(std::move(folder)), bar_("drawing") {}

    // Every frame that is not there yet, cube by cube: each is loaded once.
    base::Status draw() {
        const std::size_t cubes = std::max<std::size_t>(path_.cubes.size(), 1);
        for (std::size_t cube = 0; cube < cubes; ++cube) {
            std::vector<int> frames;
            for (int frame = 0; frame < path_.frames(); ++frame) {
                if (flight::cube_at(path_, time_of(frame)) != cube) {
                    continue;
                }
                if (folder_.has(frame)) {
                    ++done_;
                } else {
                    frames.push_back(frame);
                }
            }
            if (!frames.empty()) {
                if (const auto drawn = draw(cube, frames); !drawn) {
                    return drawn;
                }
            }
        }
        return {};
    }

    base::Status encode() const {
        const auto encoded = encode_film(folder_.pattern(), path_.fps, flags_.output);
        if (encoded && !flags_.keep_frames) {
            folder_.remove();
        }
        return encoded;
    }

  private:
    double time_of(int frame) const { return static_cast<double>(frame) / path_.fps; }

    base::Status draw(std::size_t cube, const std::vector<int>& frames) {
        const auto size = flags_.view.image_size();
        if (!size) {
            return size.error();
        }
        const Script script{.pictures = static_cast<int>(frames.size()),
                            .in_flight = 2,
                            .shot = [&](int index, const KnownCube& known) -> base::Result<flight::Shot> {
                                auto shot = flight::shot_at(
                                    path_, time_of(frames[static_cast<std::size_t>(index)]), known.lattice);
                                if (const auto valid = flags_.view.check(shot.camera); !valid) {
                                    return valid.error();
                                }
                                return shot;
                            },
                            .keep =
                                [&](int index, const image::Image<image::Rgba8>& picture) {
                                    ++done_;
                                    return folder_.write(frames[static_cast<std::size_t>(index)], picture);
                                }};
        const auto progress = [&](double) { bar_.show(static_cast<double>(done_) / path_.frames()); };
        TargetOptions target = flags_.target;
        if (!path_.cubes.empty()) {
            target.cube = path_.cubes[cube];
        }
        if (target.connect.empty() && target.tree.one_process()) {
            const auto drawn = draw_in_process(target.cube, flags_.view, script, target.threads, progress);
            return drawn ? base::Status{} : drawn.error();
        }
        auto opened = open_target(target, "warn");
        if (!opened) {
            return opened.error();
        }
        const auto drawn = draw_over_links(movie_program, *opened, flags_.view, *size, script, progress);
        return drawn ? base::Status{} : drawn.error();
    }

    const MovieFlags& flags_;
    flight::Path path_;
    FrameFolder folder_;
    ProgressBar bar_;
    int done_ = 0;
};

base::Status movie(const MovieFlags& flags) {
    const bool film = is_film(flags.output);
    if (!film && !flags.output.ends_with('/') && !fs::is_directory(flags.output)) {
        return base::error(base::Code::invalid_argument, "-o " + flags.output,
                           "is neither a film (.mp4, .mkv, .mov) nor a folder (which ends with /)");
    }
    auto path = path_of(flags);
    if (!path) {
        return path.error();
    }
    if (const auto size = flags.view.image_size(); !size) {
        return size.error();
    }
    fs::path frames = film ? flags.output + ".frames" : flags.output;
    if (!frames.has_filename()) {
        frames = frames.parent_path();  // without the slash
    }
    auto folder = FrameFolder::open(frames, description_of(*path, flags), flags.anew);
    if (!folder) {
        return folder.error();
    }
    Movie movie(flags, *std::move(path), *std::move(folder));
    if (const auto drawn = movie.draw(); !drawn || !film) {
        return drawn;
    }
    return movie.encode();
}

}  // namespace

Run add_movie(CLI::App& app) {
    auto flags = std::make_shared<MovieFlags>();
    app.add_option("path", flags->path_file, "flight path, a TOML file of key frames")->required();
    app.add_option("-o,--output", flags->output,
                   "film (.mp4, .mkv, .mov; by ffmpeg), or folder/ for PNG frames; what a stopped movie left "
                   "is gone on with")
        ->required();
    app.add_flag("--anew", flags->anew, "remove frames of another movie from the folder");
    app.add_flag("--keep-frames", flags->keep_frames, "of a film, in FILM.frames/");
    flags->target.add_to(app);
    flags->view.quality = "high";
    flags->view.add_picture_to(app);
    return [flags] {
        const auto done = movie(*flags);
        return done ? 0 : refuse(movie_program, done.error());
    };
}

}  // namespace shearwater::deploy
