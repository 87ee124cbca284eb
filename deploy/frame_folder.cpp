#include "deploy/frame_folder.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "common/base/text_file.h"
#include "common/image/png.h"

namespace shearwater::deploy {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view movie_file = "movie.toml";
constexpr std::string_view prefix = "frame-";

bool is_frame(const fs::path& path) {
    return path.filename().string().starts_with(prefix) && path.extension() == ".png";
}

}  // namespace

base::Result<FrameFolder> FrameFolder::open(const fs::path& folder, const std::string& movie, bool anew) {
    const std::string operation = fmt::format("write frames to {}", folder.string());
    std::error_code failed;
    if (!fs::is_directory(folder, failed) && !fs::create_directory(folder, failed)) {
        return base::error(base::Code::io, operation, failed.message());
    }
    std::vector<fs::path> frames;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
        if (is_frame(entry.path())) {
            frames.push_back(entry.path());
        }
    }
    const fs::path kept = folder / movie_file;
    if (!frames.empty()) {
        constexpr std::size_t most_bytes = std::size_t{8} << 20;
        const auto of = base::read_text_file(kept.string(), most_bytes);
        if (!of || *of != movie) {
            if (!anew) {
                return base::error(base::Code::invalid_argument, operation,
                                   "it holds frames of another movie; --anew removes them");
            }
            for (const fs::path& frame : frames) {
                fs::remove(frame, failed);
            }
        }
    }
    if (const auto written = base::write_text_file(kept.string(), movie); !written) {
        return written.error();
    }
    return FrameFolder(folder);
}

fs::path FrameFolder::path_of(int frame) const {
    return folder_ / fmt::format("{}{:06}.png", prefix, frame);
}

bool FrameFolder::has(int frame) const {
    std::error_code failed;
    return fs::is_regular_file(path_of(frame), failed);
}

base::Status FrameFolder::write(int frame, const image::Image<image::Rgba8>& picture) const {
    return image::write_png(path_of(frame).string(), picture);
}

std::string FrameFolder::pattern() const {
    return (folder_ / fmt::format("{}%06d.png", prefix)).string();
}

void FrameFolder::remove() const {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder_, failed)) {
        if (is_frame(entry.path()) || entry.path().filename() == movie_file) {
            fs::remove(entry.path(), failed);
        }
    }
    fs::remove(folder_, failed);  // unless something else is in it
}

}  // namespace shearwater::deploy
