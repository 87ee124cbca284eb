#include "deploy/samples/sample.h"

#include <algorithm>
#include <array>
#include <memory>

#include "common/synthetic/field.h"
#include "deploy/samples/formula.h"
#include "deploy/samples/write_cube.h"

namespace shearwater::samples {

namespace {

using base::Code;

constexpr std::array<SampleKind, 2> made_here = {{
    {"hi-galaxy", "neutral hydrogen of a warped spiral, its companion and the bridge between, by velocity"},
    {"nbody-web", "walls, filaments and knots of a cosmic web, logarithm of the density"},
}};

constexpr std::int64_t longest_axis = std::int64_t{1} << 20;
constexpr std::int64_t largest_plane = std::int64_t{1} << 30;

std::unique_ptr<Formula> make(std::string_view name, const volume::Index3& n, std::uint64_t seed) {
    if (name == "hi-galaxy") {
        return make_hi_galaxy(n, seed);
    }
    if (name == "nbody-web") {
        return make_cosmic_web(n, seed);
    }
    return make_synthetic(name, n, seed);
}

std::string listed() {
    std::string list;
    for (const SampleKind& kind : kinds()) {
        list += (list.empty() ? "" : ", ") + std::string(kind.name);
    }
    return list;
}

}  // namespace

std::vector<SampleKind> kinds() {
    std::vector<SampleKind> all(made_here.begin(), made_here.end());
    for (const synthetic::Kind& kind : synthetic::kinds()) {
        all.push_back({kind.name, kind.description, kind.bytes});
    }
    return all;
}

base::Status write_sample(std::string_view name, const volume::Index3& n, std::uint64_t seed,
                          const std::string& path, const volume::Progress& progress,
                          const std::stop_token& stop, int bitpix) {
    const std::string operation = "make the sample " + base::printable(name, 40);
    const std::vector<SampleKind> all = kinds();
    const auto kind = std::ranges::find(all, name, &SampleKind::name);
    if (kind == all.end()) {
        return base::error(Code::invalid_argument, operation, "there is none of that name, but " + listed());
    }
    if (bitpix != -32 && !(bitpix == 8 && kind->bytes)) {
        return base::error(Code::invalid_argument, operation,
                           "its values do not go into BITPIX " + std::to_string(bitpix));
    }
    if (std::any_of(n.begin(), n.end(), [](std::int64_t axis) { return axis < 2 || axis > longest_axis; })) {
        return base::error(Code::invalid_argument, operation,
                           "every axis has from 2 to " + std::to_string(longest_axis) + " voxels");
    }
    if (n[0] * n[1] > largest_plane) {
        return base::error(Code::too_large, operation, "a plane has at most 2^30 voxels");
    }
    return write_cube(*make(name, n, seed), n, bitpix, path, progress, stop);
}

}  // namespace shearwater::samples
