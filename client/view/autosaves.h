#pragma once
// What windows keep of their scenes for after a crash: a file for each window, which removes it at its end,
// and beside it a lock for as long as the window runs.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/model/status.h"
#include "common/base/file_lock.h"
#include "common/scene/scene.h"

namespace shearwater::ui {

class Autosaves {
  public:
    explicit Autosaves(std::filesystem::path folder) : folder_(std::move(folder)) {}
    ~Autosaves();  // this window has ended well: its own is forgotten; what is on offer is left
    Autosaves(const Autosaves&) = delete;
    Autosaves& operator=(const Autosaves&) = delete;

    // In the place of this window's last one. Where it cannot be kept, it is not.
    void keep(const model::Cube& cube, const scene::Scene& scene);
    // The newest that a window on the cube has left behind; older ones and what cannot be read are removed.
    // It is this window's to offer, and no other's, until it is forgotten, another is looked for or the
    // window ends.
    std::optional<scene::Scene> left_behind(const model::Cube& cube);
    void forget_left_behind();

  private:
    // With its lock beside it.
    struct File {
        std::filesystem::path path;
        base::FileLock lock;

        void remove() const;
    };
    std::optional<File> claim(const std::string& name) const;
    std::optional<File> claim_new(const model::Cube& cube) const;
    std::vector<std::string> names() const;

    std::filesystem::path folder_;
    std::optional<File> own_, offered_;
};

}  // namespace shearwater::ui
