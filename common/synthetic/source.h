#pragma once
// A cube without a file, by a name of the form of a path: "synthetic:KIND:SIZE" or
// "synthetic:KIND:SIZE:SEED", where SIZE is "NX,NY,NZ" or one number for all three.

#include <memory>
#include <string>
#include <string_view>

#include "common/synthetic/field.h"
#include "common/volume/source.h"

namespace shearwater::synthetic {

// Whether a path names such a cube, well formed or not.
bool is_synthetic(std::string_view path);

struct Name {
    std::string kind;
    volume::Index3 n{};
    std::uint64_t seed = 1;
    bool operator==(const Name&) const = default;
};

base::Result<Name> parse(std::string_view path);
std::string to_string(const Name& name);

// Computes its voxels when they are read; holds next to nothing, and may be read from several threads.
class Source final : public volume::VoxelSource {
  public:
    static base::Result<Source> open(std::string_view path);

    const Name& name() const { return name_; }
    bool bytes() const { return bytes_; }  // as Kind::bytes
    base::Status read(const volume::Box& box, std::span<float> out) override;
    bool concurrent() const override { return true; }

  private:
    Source(Name name, std::unique_ptr<const Field> field, bool bytes)
        : name_(std::move(name)), field_(std::move(field)), bytes_(bytes) {}

    Name name_;
    std::unique_ptr<const Field> field_;
    bool bytes_;
};

}  // namespace shearwater::synthetic
