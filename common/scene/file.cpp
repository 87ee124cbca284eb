#include "common/scene/file.h"

#include <filesystem>

#include "common/base/text_file.h"
#include "common/image/png.h"

namespace shearwater::scene {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20;

}  // namespace

base::Result<Scene> read(const std::string& path) {
    const std::string source = base::printable(path);
    const bool is_picture = image::is_png(path);
    const auto text = is_picture ? image::read_png_note(path) : base::read_text_file(path, most_bytes);
    if (!text) {
        return text.error();
    }
    return scene_from_toml(*text, source);
}

base::Status write(const std::string& path, const Scene& scene) {
    std::error_code none;
    const auto status = std::filesystem::symlink_status(path, none);
    if (std::filesystem::exists(status) && (image::is_png(path) || !read(path))) {
        return base::error(base::Code::invalid_argument, "write session " + base::printable(path),
                           "the file that is there is no session, and is left as it is");
    }
    return base::write_text_file(path, to_toml(scene));
}

base::Status write_picture(const std::string& path, const Scene& scene,
                           const image::Image<image::Rgba8>& picture) {
    return image::write_png(path, picture, to_toml(scene));
}

}  // namespace shearwater::scene
