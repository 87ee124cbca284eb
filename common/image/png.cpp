#include "common/image/png.h"

#include <fcntl.h>
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "common/image/file.h"
#include "common/image/png_note.h"

namespace shearwater::image {

namespace {

// A picture larger than this is none of ours.
constexpr png_uint_32 max_side = 32768;
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 27;

base::Error failed(const std::string& operation) {
    return base::error(base::Code::io, operation, std::generic_category().message(errno));
}

// libpng's simplified interface keeps its jumps to itself: faults come back as a flag and a message.
class PngImage {
  public:
    PngImage() { png_.version = PNG_IMAGE_VERSION; }
    ~PngImage() { png_image_free(&png_); }
    PngImage(const PngImage&) = delete;
    PngImage& operator=(const PngImage&) = delete;

    png_image* get() { return &png_; }
    png_image* operator->() { return &png_; }
    base::Error fault(base::Code code, const std::string& operation) const {
        return base::error(code, operation, base::printable(png_.message));
    }

  private:
    png_image png_{};
};

// Opaque pictures, which ours are, are written without alpha.
bool is_opaque(const Image<Rgba8>& image) {
    return std::all_of(image.pixels().begin(), image.pixels().end(),
                       [](const Rgba8& p) { return p.a == 255; });
}

std::vector<std::uint8_t> without_alpha(const Image<Rgba8>& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels().size() * 3);
    for (const Rgba8& p : image.pixels()) {
        bytes.insert(bytes.end(), {p.r, p.g, p.b});
    }
    return bytes;
}

base::Status write_to(std::FILE* file, const Image<Rgba8>& image, const std::string& note,
                      const std::string& operation) {
    PngImage png;
    png->width = static_cast<png_uint_32>(image.width());
    png->height = static_cast<png_uint_32>(image.height());
    std::vector<std::uint8_t> rgb;
    const void* pixels = image.pixels().data();
    png->format = PNG_FORMAT_RGBA;
    if (is_opaque(image)) {
        rgb = without_alpha(image);
        pixels = rgb.data();
        png->format = PNG_FORMAT_RGB;
    }
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(*png.get());
    std::vector<std::uint8_t> coded(bytes);
    if (png_image_write_to_memory(png.get(), coded.data(), &bytes, 0, pixels, 0, nullptr) == 0) {
        return png.fault(base::Code::io, operation);
    }
    coded.resize(bytes);
    if (!note.empty()) {
        put_png_note(coded, note);
    }
    if (std::fwrite(coded.data(), 1, coded.size(), file) != coded.size()) {
        return failed(operation);
    }
    if (std::fflush(file) != 0) {
        return failed(operation);
    }
    return {};
}

// Writes a new file beside the target and moves it there, so that nobody sees half a picture.
base::Status write_beside(const std::string& path, const Image<Rgba8>& image, const std::string& note,
                          const std::string& operation) {
    const std::string part = path + "." + std::to_string(getpid()) + ".part";
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        return failed(operation);
    }
    File file(fdopen(descriptor, "wb"));
    base::Status written =
        file ? write_to(file.get(), image, note, operation) : base::Status(failed(operation));
    if (file && std::fclose(file.release()) != 0 && written) {
        written = failed(operation);
    }
    if (written && std::rename(part.c_str(), path.c_str()) != 0) {
        written = failed(operation);
    }
    if (!written) {
        ::unlink(part.c_str());
    }
    return written;
}

// Devices, pipes and what links lead to are written in place.
bool is_written_in_place(const std::string& path) {
    std::error_code none;
    const auto status = std::filesystem::symlink_status(path, none);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

base::Status write_in_place(const std::string& path, const Image<Rgba8>& image, const std::string& note,
                            const std::string& operation) {
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) {
        return failed(operation);
    }
    if (auto written = write_to(file.get(), image, note, operation); !written) {
        return written;
    }
    if (std::fclose(file.release()) != 0) {
        return failed(operation);
    }
    return {};
}

}  // namespace

base::Status write_png(const std::string& path, const Image<Rgba8>& image, const std::string& note) {
    base::check(!image.empty(), "a picture has pixels");
    if (path == "-") {
        return write_to(stdout, image, note, "write picture to standard output");
    }
    const std::string operation = "write picture " + path;
    return is_written_in_place(path) ? write_in_place(path, image, note, operation)
                                     : write_beside(path, image, note, operation);
}

base::Result<Image<Rgba8>> read_png(const std::string& path) {
    const std::string operation = "read picture " + path;
    const File file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        return base::error(errno == ENOENT ? base::Code::not_found : base::Code::io, operation,
                           std::generic_category().message(errno));
    }
    PngImage png;
    if (png_image_begin_read_from_stdio(png.get(), file.get()) == 0) {
        return png.fault(base::Code::corrupt, operation);
    }
    if (png->width > max_side || png->height > max_side ||
        std::uint64_t{png->width} * png->height > max_pixels) {
        return base::error(base::Code::too_large, operation,
                           std::to_string(png->width) + " x " + std::to_string(png->height) + " pixels");
    }
    png->format = PNG_FORMAT_RGBA;
    Image<Rgba8> image(static_cast<int>(png->width), static_cast<int>(png->height));
    if (png_image_finish_read(png.get(), nullptr, image.pixels().data(), 0, nullptr) == 0) {
        return png.fault(base::Code::corrupt, operation);
    }
    return image;
}

}  // namespace shearwater::image
