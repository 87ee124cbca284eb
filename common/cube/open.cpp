#include "common/cube/open.h"

#include <filesystem>

#include "common/synthetic/source.h"

namespace shearwater::cube {

namespace {

base::Result<Cube> open_synthetic(const std::string& path) {
    auto source = synthetic::Source::open(path);
    if (!source) {
        return source.error();
    }
    fits::CubeInfo info;
    info.path = path;
    info.n = source->name().n;
    info.file_axes = {1, 2, 3};
    info.bitpix = source->bytes() ? 8 : -32;
    info.object = source->name().kind;
    return Cube{std::make_unique<synthetic::Source>(*std::move(source)), std::move(info)};
}

}  // namespace

base::Result<Cube> open(const std::string& path, const fits::OpenOptions& options) {
    if (synthetic::is_synthetic(path)) {
        return open_synthetic(path);
    }
    auto file = fits::Cube::open(path, options);
    if (!file) {
        return file.error();
    }
    fits::CubeInfo info = file->info();
    return Cube{std::make_unique<fits::Cube>(*std::move(file)), std::move(info)};
}

std::string absolute(const std::string& path) {
    return synthetic::is_synthetic(path) ? path : std::filesystem::absolute(path).string();
}

}  // namespace shearwater::cube
