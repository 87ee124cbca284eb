#include "client/view/files.h"

#include <algorithm>

namespace shearwater::ui {

namespace {

constexpr std::string_view picture_ending = ".png";
constexpr std::string_view session_ending = ".toml";

void name_file(Desk& desk, const std::string& path) {
    if (path.size() < desk.file.size()) {
        desk.file.fill('\0');
        std::ranges::copy(path, desk.file.begin());
    }
}

std::string without(const std::string& path, std::string_view ending) {
    return path.ends_with(ending) ? path.substr(0, path.size() - ending.size()) : path;
}

}  // namespace

// All of the scene but the size, which is the window's.
void Files::apply(Desk& desk, const scene::Scene& scene) {
    desk.transition.stop();
    desk.flying = false;
    model::apply(scene, desk.wish, desk.effort);
    desk.show_pair(scene.stereo);
}

// A picture is not written over by a session: that gets a name beside it.
void Files::open(Desk& desk, const std::string& path, const scene::Scene& scene) {
    apply(desk, scene);
    name_file(desk, path.ends_with(picture_ending)
                        ? without(path, picture_ending) + std::string(session_ending)
                        : path);
}

void Files::take(Desk& desk, const Keeper::Outcome& outcome) {
    switch (outcome.kind) {
        case Keeper::Outcome::Kind::said:
            desk.say(outcome.words);
            break;
        case Keeper::Outcome::Kind::failed:
            desk.say(outcome.words, true);
            break;
        case Keeper::Outcome::Kind::opened: {
            open(desk, outcome.path, *outcome.scene);
            const std::string& cube = outcome.scene->cube;
            const bool is_another =
                desk.has_cube() && !cube.empty() && cube != base::printable(desk.status.cube->name);
            desk.say(is_another ? outcome.words + ", a session of another cube, " + cube : outcome.words);
            break;
        }
        case Keeper::Outcome::Kind::offered:
            offered_ = outcome.scene;
            break;
    }
}

void Files::attend(Desk& desk, const std::vector<std::string>& dropped,
                   const std::shared_ptr<const model::Picture>& picture, bool settled) {
    while (const auto outcome = keeper_.collect()) {
        take(desk, *outcome);
    }
    if (!dropped.empty()) {
        keeper_.open(dropped.back());
    }
    const FileWishes wishes = std::exchange(desk.files, {});
    desk.offers_restoring = offered_.has_value();
    if (!desk.has_cube()) {
        return;
    }
    const model::Cube& cube = *desk.status.cube;
    if (looked_for_ != cube.name) {
        looked_for_ = cube.name;
        offered_.reset();
        keeper_.look_for(cube);
        if (desk.file[0] == '\0') {
            name_file(desk, model::stem_for(cube) + std::string(session_ending));
        }
    }
    scene::Scene scene = model::scene_of(desk.wish, desk.effort, base::printable(cube.name));
    if (desk.shown) {
        scene.stereo = scene::Pair{desk.eyes, *desk.shown};
    }
    const std::string file = desk.file.data();
    if ((wishes.save || wishes.open || wishes.picture) && file.empty()) {
        desk.say("Name a file for the session first", true);
    } else if (wishes.save) {
        keeper_.save(file, scene);
    } else if (wishes.open) {
        keeper_.open(file);
    } else if (wishes.picture) {
        picture_wanted_ = true;
        desk.say("The picture is saved once it is as good as it gets");
    }
    if (picture_wanted_ && settled && picture != nullptr) {
        picture_wanted_ = false;
        keeper_.save_picture(without(without(file, session_ending), picture_ending), scene, picture);
    }
    if (offered_ && (wishes.restore || wishes.dismiss)) {
        if (wishes.restore) {
            apply(desk, *offered_);
        }
        keeper_.forget_left_behind();
        offered_.reset();
    }
    if (autosave_.due(scene, desk.now)) {
        keeper_.autosave(cube, scene);
    }
}

}  // namespace shearwater::ui
