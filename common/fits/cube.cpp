#include "common/fits/cube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/check.h"
#include "common/fits/axes.h"
#include "common/fits/handle.h"
#include "common/fits/pixels.h"
#include "common/fits/survey.h"

namespace shearwater::fits {

namespace {

CubeInfo describe(const std::string& path, const Survey& survey, const CubeAxes& axes) {
    const Header& header = survey.cube.header;
    CubeInfo info;
    info.path = path;
    info.hdu = survey.cube.number;
    info.n = axes.n;
    info.file_axes = axes.axis;
    info.bitpix = survey.cube.bitpix;
    info.plane = axes.plane;
    info.planes = axes.planes;
    info.object = base::printable(header.text("OBJECT").value_or(""));
    info.unit = base::printable(header.text("BUNIT").value_or(""));
    for (std::size_t i = 0; i < 3; ++i) {
        info.axis_types[i] = base::printable(header.text("CTYPE", axes.axis[i]).value_or(""));
    }
    info.notes = survey.notes;
    if (!axes.note.empty()) {
        info.notes.push_back(axes.note);
    }
    return info;
}

}  // namespace

// The handle reads from the bytes, so it goes first.
struct Cube::File {
    Bytes bytes;
    MemoryFile memory;
    Handle handle;
    PixelReader reader;
    CubeInfo info;
};

base::Result<Cube> Cube::open(const std::string& path, const OpenOptions& options) {
    const std::string operation = "open " + path;
    auto bytes = Bytes::open(path);
    if (!bytes) {
        return bytes.error();
    }
    auto survey = find_cube(*bytes, options.hdu, operation);
    if (!survey) {
        return survey.error();
    }
    if (const std::int64_t missing = survey->cube.next_offset - bytes->size(); missing > 0) {
        if (base::Status padded = bytes->pad(survey->cube.next_offset, operation); !padded) {
            return padded.error();
        }
        survey->notes.push_back("the last block of the file is " + std::to_string(missing) + " bytes short");
    }
    const auto axes = choose_axes(survey->cube, options.plane, operation);
    if (!axes) {
        return axes.error();
    }
    auto file = std::make_unique<File>(File{.bytes = std::move(*bytes),
                                            .memory = {},
                                            .handle = {},
                                            .reader = {},
                                            .info = describe(path, *survey, *axes)});
    file->memory = {file->bytes.unpacked(), static_cast<std::size_t>(file->bytes.size())};
    auto handle =
        file->bytes.unpacked() != nullptr ? open_memory(file->memory, operation) : open_disk(path, operation);
    if (!handle) {
        return handle.error();
    }
    file->handle = std::move(*handle);
    auto reader = PixelReader::prepare(file->handle.get(), survey->cube, *axes, operation, file->info.notes);
    if (!reader) {
        return reader.error();
    }
    file->reader = std::move(*reader);
    return Cube(std::move(file));
}

Cube::Cube(std::unique_ptr<File> file) : file_(std::move(file)) {}
Cube::Cube(Cube&&) noexcept = default;
Cube& Cube::operator=(Cube&&) noexcept = default;
Cube::~Cube() = default;

const CubeInfo& Cube::info() const {
    return file_->info;
}

base::Status Cube::read(const volume::Box& box, std::span<float> out) {
    base::check(volume::whole(file_->info.n).contains(box), "the box lies in the cube");
    base::check(static_cast<std::int64_t>(out.size()) == box.voxels(), "one float for each voxel");
    return file_->reader.read(file_->handle.get(), file_->bytes, box, out, "read " + file_->info.path);
}

}  // namespace shearwater::fits
