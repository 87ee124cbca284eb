#include "client/view/keeper.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>

#include "common/scene/file.h"

namespace shearwater::ui {

namespace fs = std::filesystem;

namespace {

using Kind = Keeper::Outcome::Kind;

// Nothing where nobody has a home.
std::optional<fs::path> state_folder() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && fs::path(state).is_absolute()) {
        return fs::path(state) / "shearwater";
    }
    const char* const home = std::getenv("HOME");
    return home != nullptr && fs::path(home).is_absolute()
               ? std::optional(fs::path(home) / ".local/state/shearwater")
               : std::nullopt;
}

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

}  // namespace

Keeper::Keeper(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

Keeper::~Keeper() {
    thread_.request_stop();
    more_.notify_all();
    thread_.join();
    if (!autosaved_.empty()) {
        std::error_code none;
        fs::remove(autosaved_, none);
    }
}

void Keeper::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (more_.wait(lock, stop, [this] { return !jobs_.empty(); })) {
        const std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        job();
        lock.lock();
    }
}

void Keeper::later(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    if (jobs_.size() < most_waiting) {
        jobs_.push_back(std::move(job));
        more_.notify_all();
    }
}

void Keeper::tell(Outcome outcome) {
    {
        const std::lock_guard lock(mutex_);
        outcomes_.push_back(std::move(outcome));
    }
    wake_();
}

std::vector<Keeper::Outcome> Keeper::collect() {
    const std::lock_guard lock(mutex_);
    return std::exchange(outcomes_, {});
}

void Keeper::save(const std::string& path, const scene::Scene& scene) {
    later([this, path, scene] {
        if (const auto written = scene::write(path, scene)) {
            tell({Kind::said, "Saved to " + path, path, {}});
        } else {
            tell({Kind::failed, written.error().message(), path, {}});
        }
    });
}

void Keeper::open(const std::string& path) {
    later([this, path] {
        auto read = scene::read(path);
        if (read) {
            tell({Kind::opened, "Opened " + path, path, *std::move(read)});
        } else {
            tell({Kind::failed, read.error().message(), path, {}});
        }
    });
}

void Keeper::save_picture(const std::string& path, const scene::Scene& scene,
                          std::shared_ptr<const model::Picture> picture) {
    later([this, path, scene, picture = std::move(picture)] {
        std::error_code none;
        std::string free = path + ".png";
        for (int n = 2; fs::exists(fs::symlink_status(free, none)); ++n) {
            free = path + "-" + std::to_string(n) + ".png";
        }
        if (const auto written = scene::write_picture(free, scene, picture->pixels)) {
            tell({Kind::said, "Saved the picture to " + free, free, {}});
        } else {
            tell({Kind::failed, written.error().message(), free, {}});
        }
    });
}

// Where it cannot be kept, it is not, and nobody is told every few seconds.
void Keeper::autosave(const model::Cube& cube, const scene::Scene& scene) {
    later([this, cube, scene] {
        if (const auto folder = state_folder()) {
            const std::string path = *folder / model::autosave_name(cube, own_process());
            if (!autosaved_.empty() && autosaved_ != path) {
                std::error_code none;
                fs::remove(autosaved_, none);
            }
            autosaved_ = scene::write(path, scene) ? path : autosaved_;
        }
    });
}

void Keeper::look_for(const model::Cube& cube) {
    later([this, cube] { offer_newest(cube); });
}

void Keeper::offer_newest(const model::Cube& cube) {
    const auto folder = state_folder();
    if (!folder) {
        return;
    }
    std::error_code none;
    std::vector<std::string> names;
    constexpr std::size_t most_names = 10000;
    for (fs::directory_iterator entry(*folder, none), end; entry != end && names.size() < most_names;
         entry.increment(none)) {
        names.push_back(entry->path().filename().string());
    }
    std::optional<Outcome> newest;
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
            newest = Outcome{Kind::offered, "", path.string(), *std::move(read)};
        } else {
            fs::remove(path, none);
        }
    }
    if (newest) {
        tell(*std::move(newest));
    }
}

void Keeper::forget(const std::string& path) {
    later([path] {
        std::error_code none;
        fs::remove(path, none);
    });
}

}  // namespace shearwater::ui
