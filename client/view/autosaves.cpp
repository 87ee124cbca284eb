#include "client/view/autosaves.h"

#include "client/model/keeping.h"
#include "common/base/text_file.h"
#include "common/scene/file.h"

namespace shearwater::ui {

namespace fs = std::filesystem;

void Autosaves::File::remove() const {
    std::error_code none;
    fs::remove(path, none);
}

Autosaves::~Autosaves() {
    if (own_) {
        own_->remove();
    }
}

void Autosaves::keep(const model::Cube& cube, const scene::Scene& scene) {
    if (!own_ || !model::is_autosave(own_->path.filename().string(), cube)) {
        std::optional<File> claimed = claim_new(cube);
        if (!claimed) {
            return;
        }
        if (own_) {
            own_->remove();
        }
        own_ = std::move(claimed);
    }
    static_cast<void>(scene::write(own_->path.string(), scene));
}

std::optional<scene::Scene> Autosaves::left_behind(const model::Cube& cube) {
    offered_.reset();
    std::optional<scene::Scene> newest;
    fs::file_time_type newest_time;
    for (const std::string& name : names()) {
        std::optional<File> file = model::is_autosave(name, cube) ? claim(name) : std::nullopt;
        if (!file) {
            continue;
        }
        std::error_code none;
        const auto time = fs::last_write_time(file->path, none);
        auto read = scene::read(file->path.string());
        if (read && (!newest || time > newest_time)) {
            forget_left_behind();
            offered_ = std::move(file);
            newest_time = time;
            newest = *std::move(read);
        } else {
            file->remove();
        }
    }
    return newest;
}

void Autosaves::forget_left_behind() {
    if (offered_) {
        offered_->remove();
        offered_.reset();
    }
}

std::optional<Autosaves::File> Autosaves::claim(const std::string& name) const {
    const fs::path path = folder_ / name;
    if (own_ && own_->path == path) {
        return std::nullopt;
    }
    auto lock = base::FileLock::take(path.string() + ".lock");
    return lock ? std::optional(File{path, *std::move(lock)}) : std::nullopt;
}

// The first number that no window has, whether it runs or has left something behind.
std::optional<Autosaves::File> Autosaves::claim_new(const model::Cube& cube) const {
    if (!base::make_own_folder(folder_)) {
        return std::nullopt;
    }
    constexpr int most_windows = 1000;
    for (int number = 1; number <= most_windows; ++number) {
        const std::string name = model::autosave_name(cube, number);
        std::error_code failed;
        if (std::optional<File> file = claim(name);
            file && !fs::exists(fs::symlink_status(file->path, failed))) {
            return file;
        }
    }
    return std::nullopt;
}

std::vector<std::string> Autosaves::names() const {
    std::error_code none;
    std::vector<std::string> names;
    constexpr std::size_t most_names = 10000;
    for (fs::directory_iterator entry(folder_, none), end; entry != end && names.size() < most_names;
         entry.increment(none)) {
        names.push_back(entry->path().filename().string());
    }
    return names;
}

}  // namespace shearwater::ui
