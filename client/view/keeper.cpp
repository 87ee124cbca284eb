#include "client/view/keeper.h"

#include <charconv>
#include <filesystem>

#include "client/view/state_folder.h"
#include "common/scene/file.h"

namespace shearwater::ui {

namespace fs = std::filesystem;

namespace {

using Kind = Keeper::Outcome::Kind;

std::uint64_t own_process() {
    std::error_code none;
    const std::string number = fs::read_symlink("/proc/self", none).string();
    std::uint64_t process = 0;
    std::from_chars(number.data(), number.data() + number.size(), process);
    return process;
}

bool runs(std::uint64_t process) {
    std::error_code none;
    return fs::exists("/proc/" + std::to_string(process), none);
}

std::optional<Keeper::Outcome> outcome_of(const base::Status& status, const std::string& done,
                                          const std::string& path) {
    return status ? Keeper::Outcome{Kind::said, done, path, {}}
                  : Keeper::Outcome{Kind::failed, status.error().message(), path, {}};
}

// The others are removed.
std::optional<Keeper::Outcome> newest_left_behind(const model::Cube& cube) {
    const auto folder = state_folder();
    if (!folder) {
        return std::nullopt;
    }
    std::error_code none;
    std::vector<std::string> names;
    constexpr std::size_t most_names = 10000;
    for (fs::directory_iterator entry(*folder, none), end; entry != end && names.size() < most_names;
         entry.increment(none)) {
        names.push_back(entry->path().filename().string());
    }
    std::optional<Keeper::Outcome> newest;
    fs::file_time_type newest_time;
    for (const std::string& name : model::left_behind(names, cube, runs)) {
        const fs::path path = *folder / name;
        const auto time = fs::last_write_time(path, none);
        auto read = scene::read(path);
        if (read && (!newest || time > newest_time)) {
            if (newest) {
                fs::remove(newest->path, none);
            }
            newest_time = time;
            newest = Keeper::Outcome{Kind::offered, "", path.string(), *std::move(read)};
        } else {
            fs::remove(path, none);
        }
    }
    return newest;
}

}  // namespace

Keeper::~Keeper() {
    errands_.finish();
    if (!autosaved_.empty()) {
        std::error_code none;
        fs::remove(autosaved_, none);
    }
}

void Keeper::save(const std::string& path, const scene::Scene& scene) {
    errands_.ask([path, scene] { return outcome_of(scene::write(path, scene), "Saved to " + path, path); });
}

void Keeper::open(const std::string& path) {
    errands_.ask([path] {
        auto read = scene::read(path);
        return std::optional(read ? Outcome{Kind::opened, "Opened " + path, path, *std::move(read)}
                                  : Outcome{Kind::failed, read.error().message(), path, {}});
    });
}

void Keeper::save_picture(const std::string& path, const scene::Scene& scene,
                          std::shared_ptr<const model::Picture> picture) {
    errands_.ask([path, scene, picture = std::move(picture)] {
        std::error_code none;
        std::string free = path + ".png";
        for (int n = 2; fs::exists(fs::symlink_status(free, none)); ++n) {
            free = path + "-" + std::to_string(n) + ".png";
        }
        const bool is_pair = scene.stereo && !picture->right.empty();
        const auto written =
            is_pair ? scene::write_picture(
                          free, scene, image::composed(picture->pixels, picture->right, scene.stereo->mode))
                    : scene::write_picture(free, scene, picture->pixels);
        return outcome_of(written, "Saved the picture to " + free, free);
    });
}

// Where it cannot be kept, it is not, and nobody is told every few seconds.
void Keeper::autosave(const model::Cube& cube, const scene::Scene& scene) {
    errands_.ask([this, cube, scene]() -> std::optional<Outcome> {
        if (const auto folder = state_folder()) {
            const std::string path = *folder / model::autosave_name(cube, own_process());
            if (!autosaved_.empty() && autosaved_ != path) {
                std::error_code none;
                fs::remove(autosaved_, none);
            }
            autosaved_ = scene::write(path, scene) ? path : autosaved_;
        }
        return std::nullopt;
    });
}

void Keeper::look_for(const model::Cube& cube) {
    errands_.ask([cube] { return newest_left_behind(cube); });
}

void Keeper::forget(const std::string& path) {
    errands_.ask([path]() -> std::optional<Outcome> {
        std::error_code none;
        fs::remove(path, none);
        return std::nullopt;
    });
}

}  // namespace shearwater::ui
