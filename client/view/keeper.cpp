#include "client/view/keeper.h"

#include <filesystem>

#include "client/view/state_folder.h"
#include "common/scene/file.h"

namespace shearwater::ui {

namespace fs = std::filesystem;

namespace {

using Kind = Keeper::Outcome::Kind;

std::optional<Keeper::Outcome> outcome_of(const base::Status& status, const std::string& done,
                                          const std::string& path) {
    return status ? Keeper::Outcome{Kind::said, done, path, {}}
                  : Keeper::Outcome{Kind::failed, status.error().message(), path, {}};
}

}  // namespace

Keeper::Keeper(std::function<void()> wake) : errands_(std::move(wake)) {
    if (const auto folder = state_folder()) {
        autosaves_.emplace(*folder);
    }
}

Keeper::~Keeper() {
    errands_.finish();
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

// Where it cannot be kept, nobody is told every few seconds.
void Keeper::autosave(const model::Cube& cube, const scene::Scene& scene) {
    errands_.ask([this, cube, scene]() -> std::optional<Outcome> {
        if (autosaves_) {
            autosaves_->keep(cube, scene);
        }
        return std::nullopt;
    });
}

void Keeper::look_for(const model::Cube& cube) {
    errands_.ask([this, cube]() -> std::optional<Outcome> {
        auto scene = autosaves_ ? autosaves_->left_behind(cube) : std::nullopt;
        return scene ? std::optional(Outcome{Kind::offered, "", "", std::move(scene)}) : std::nullopt;
    });
}

void Keeper::forget_left_behind() {
    errands_.ask([this]() -> std::optional<Outcome> {
        if (autosaves_) {
            autosaves_->forget_left_behind();
        }
        return std::nullopt;
    });
}

}  // namespace shearwater::ui
