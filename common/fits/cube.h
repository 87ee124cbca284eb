#pragma once
// A cube in a FITS file: opened, judged by its header and the file's real size, read box by box.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/volume/box.h"
#include "common/volume/source.h"
#include "common/wcs/axis.h"

namespace shearwater::fits {

struct OpenOptions {
    std::optional<int> hdu;             // 0 is the primary; unset: the first that holds a cube
    std::optional<std::int64_t> plane;  // index along a fourth axis longer than 1; unset: 0, with a note
    bool world = false;                 // the axes' world coordinates are wanted too
    std::stop_token stop;               // once requested, opening and reading end as cancelled
};

struct CubeInfo {
    std::string path;
    int hdu = 0;
    volume::Index3 n{};                     // the three axes longer than 1, in the file's order
    std::array<int, 3> file_axes{};         // their FITS axis numbers, from 1
    int bitpix = 0;                         // as stored; of the uncompressed image where it is compressed
    std::int64_t plane = 0;                 // chosen along the fourth axis
    std::int64_t planes = 1;                // its length
    std::string object, unit;               // printable
    std::array<std::string, 3> axis_types;  // CTYPE, printable
    wcs::Axes world;                        // unknown where they were not asked for
    // What was repaired, assumed or left out, a sentence each, for the person.
    std::vector<std::string> notes;
};

// One cube. Move-only; owns the file handle. Reads of one that is not compressed may go on in several
// threads at once; open another again for another thread.
class Cube final : public volume::VoxelSource {
  public:
    // Never allocates by what the header says before the file's size has confirmed it. Names are plain
    // files: brackets and such do nothing.
    static base::Result<Cube> open(const std::string& path, const OpenOptions& options = {});

    Cube(Cube&&) noexcept;
    Cube& operator=(Cube&&) noexcept;
    ~Cube() override;

    const CubeInfo& info() const;
    base::Status read(const volume::Box& box, std::span<float> out) override;
    bool concurrent() const override;
    bool gives_rows() const override;  // also of one whose compressed tiles are rows

  private:
    struct File;
    explicit Cube(std::unique_ptr<File> file);
    std::unique_ptr<File> file_;
};

}  // namespace shearwater::fits
