#include "common/fits/cube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/check.h"
#include "common/fits/axes.h"
#include "common/fits/handle.h"
#include "common/fits/plain_pixels.h"
#include "common/fits/survey.h"
#include "common/fits/tiled_pixels.h"
#include "common/fits/world.h"

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

// Pixels as they lie in the file, or a handle that unpacks them: it reads from the bytes, so it goes first.
struct Cube::File {
    Bytes bytes;
    CubeInfo info;
    std::stop_token stop;
    std::optional<PlainPixels> plain;
    MemoryFile memory;
    Handle handle;
    TiledPixels tiled;

    base::Status open_tiles(Survey& survey, const CubeAxes& axes, const Encoding& encoding,
                            const std::string& operation);
};

base::Status Cube::File::open_tiles(Survey& survey, const CubeAxes& axes, const Encoding& encoding,
                                    const std::string& operation) {
    // cfitsio reads whole blocks only.
    if (survey.cube.next_offset > bytes.size()) {
        if (base::Status padded = bytes.pad(survey.cube.next_offset, operation); !padded) {
            return padded.error();
        }
    }
    memory = {bytes.unpacked(), static_cast<std::size_t>(bytes.size())};
    auto opened =
        bytes.unpacked() != nullptr ? open_memory(memory, operation) : open_disk(info.path, operation);
    if (!opened) {
        return opened.error();
    }
    handle = std::move(*opened);
    auto pixels = TiledPixels::prepare(handle.get(), survey.cube, axes, encoding, operation);
    if (!pixels) {
        return pixels.error();
    }
    tiled = std::move(*pixels);
    return {};
}

base::Result<Cube> Cube::open(const std::string& path, const OpenOptions& options) {
    const std::string operation = "open " + path;
    auto bytes = Bytes::open(path, options.stop);
    if (!bytes) {
        return bytes.error();
    }
    auto survey = find_cube(*bytes, options.hdu, operation);
    if (!survey) {
        return survey.error();
    }
    if (const std::int64_t missing = survey->cube.next_offset - bytes->size(); missing > 0) {
        survey->notes.push_back("the last block of the file is " + std::to_string(missing) + " bytes short");
    }
    const auto axes = choose_axes(survey->cube, options.plane, operation);
    if (!axes) {
        return axes.error();
    }
    auto file = std::make_unique<File>(
        File{.bytes = std::move(*bytes), .info = describe(path, *survey, *axes), .stop = options.stop});
    if (options.world) {
        const Hdu& hdu = survey->cube;
        file->info.world = read_world(hdu.header, hdu.axes, *axes, file->info.notes);
    }
    const auto encoding = read_encoding(survey->cube, operation, file->info.notes);
    if (!encoding) {
        return encoding.error();
    }
    if (survey->cube.kind == HduKind::image) {
        file->plain.emplace(survey->cube, *axes, *encoding);
    } else if (base::Status opened = file->open_tiles(*survey, *axes, *encoding, operation); !opened) {
        return opened.error();
    }
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
    const std::string operation = "read " + file_->info.path;
    if (file_->plain) {
        return file_->plain->read(file_->bytes, box, out, operation, file_->stop);
    }
    return file_->tiled.read(file_->handle.get(), file_->bytes, box, out, operation, file_->stop);
}

bool Cube::concurrent() const {
    return file_->plain.has_value();
}

bool Cube::gives_rows() const {
    return file_->plain.has_value() || file_->tiled.has_row_tiles();
}

}  // namespace shearwater::fits
