#include "tests/support/reference_cubes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "common/base/check.h"

namespace shearwater::test {

using volume::Box;
using volume::Index3;

FloatCube::FloatCube(const Index3& n) : n_(n), values_(static_cast<std::size_t>(n[0] * n[1] * n[2])) {}

FloatCube::FloatCube(const Index3& n, const std::function<float(double, double, double)>& value)
    : FloatCube(n) {
    for (std::int64_t z = 0; z < n[2]; ++z) {
        for (std::int64_t y = 0; y < n[1]; ++y) {
            for (std::int64_t x = 0; x < n[0]; ++x) {
                at(x, y, z) = value(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
            }
        }
    }
}

base::Status FloatCube::read(const Box& box, std::span<float> out) {
    auto to = out.begin();
    for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
        for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
            to = std::copy_n(&values_[index(box.lo[0], y, z)], box.planes(0), to);
        }
    }
    return {};
}

FloatCube smooth_cube(const Index3& n, unsigned seed) {
    struct Blob {
        double x, y, z, width, height;
    };
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Blob> blobs(6);
    for (Blob& blob : blobs) {
        blob = {unit(random), unit(random), unit(random), 0.1 + 0.15 * unit(random),
                0.3 + 0.7 * unit(random)};
    }
    const double phase = 6 * unit(random);
    return FloatCube(n, [&](double x, double y, double z) {
        const double px = x / static_cast<double>(n[0] - 1);
        const double py = y / static_cast<double>(n[1] - 1);
        const double pz = z / static_cast<double>(n[2] - 1);
        double value = 0.1 + 0.1 * std::sin(2 * std::numbers::pi * (px + 1.5 * py - pz) + phase);
        for (const Blob& blob : blobs) {
            const double d2 =
                (px - blob.x) * (px - blob.x) + (py - blob.y) * (py - blob.y) + (pz - blob.z) * (pz - blob.z);
            value += blob.height * std::exp(-d2 / (2 * blob.width * blob.width));
        }
        return static_cast<float>(std::min(value / 2, 1.0));
    });
}

FloatCube noise_cube(const Index3& n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    return FloatCube(n, [&](double, double, double) { return unit(random); });
}

FloatCube blanked(FloatCube cube, std::size_t one_of) {
    for (std::size_t i = 0; i < cube.values().size(); i += one_of) {
        cube.values()[i] = std::numeric_limits<float>::quiet_NaN();
    }
    return cube;
}

FloatCube permuted(const FloatCube& cube, const std::array<int, 3>& from) {
    Index3 n;
    for (std::size_t a = 0; a < 3; ++a) {
        n[a] = cube.n()[static_cast<std::size_t>(from[a])];
    }
    FloatCube result(n);
    Index3 p;
    for (p[2] = 0; p[2] < n[2]; ++p[2]) {
        for (p[1] = 0; p[1] < n[1]; ++p[1]) {
            for (p[0] = 0; p[0] < n[0]; ++p[0]) {
                Index3 q;
                for (std::size_t a = 0; a < 3; ++a) {
                    q[static_cast<std::size_t>(from[a])] = p[a];
                }
                result.at(p[0], p[1], p[2]) = cube.at(q[0], q[1], q[2]);
            }
        }
    }
    return result;
}

shear::BrickVolume bricks_of(FloatCube& cube, base::Workers& workers, const volume::Mapping& mapping) {
    return bricks_of(cube, volume::whole(cube.n()), workers, mapping);
}

shear::BrickVolume bricks_of(FloatCube& cube, const Box& box, base::Workers& workers,
                             const volume::Mapping& mapping) {
    auto volume = shear::BrickVolume::load(cube, box, cube.n(), mapping, workers);
    base::check(volume.has_value(), "a cube in memory loads");
    return std::move(*volume);
}

}  // namespace shearwater::test
