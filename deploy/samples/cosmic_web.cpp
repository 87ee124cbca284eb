// The logarithm of the density of matter in a cosmic web: a foam of voids around random points, whose
// walls meet in filaments and those in knots, with haloes strung along them.

#include <algorithm>
#include <array>
#include <cmath>

#include "deploy/samples/formula.h"
#include "deploy/samples/noise.h"

namespace shearwater::samples {

namespace {

struct Point {
    float x, y, z;
};

// The distances to the nearest four of one random point in each cell of a unit lattice.
std::array<float, 4> nearest(const Point& p, std::uint64_t seed) {
    const auto ix = static_cast<std::int64_t>(std::floor(p.x));
    const auto iy = static_cast<std::int64_t>(std::floor(p.y));
    const auto iz = static_cast<std::int64_t>(std::floor(p.z));
    std::array<float, 4> squares = {1e9F, 1e9F, 1e9F, 1e9F};
    for (std::int64_t k = iz - 1; k <= iz + 1; ++k) {
        for (std::int64_t j = iy - 1; j <= iy + 1; ++j) {
            for (std::int64_t i = ix - 1; i <= ix + 1; ++i) {
                const std::uint64_t bits = hash(i, j, k, seed);
                const auto offset = [bits](unsigned shift) {
                    return static_cast<float>(bits >> shift & 0x1fffffU) * 0x1p-21F;
                };
                const float dx = static_cast<float>(i) + offset(0) - p.x;
                const float dy = static_cast<float>(j) + offset(21) - p.y;
                const float dz = static_cast<float>(k) + offset(42) - p.z;
                float square = dx * dx + dy * dy + dz * dz;
                for (float& kept : squares) {
                    const float larger = std::max(kept, square);
                    kept = std::min(kept, square);
                    square = larger;
                }
            }
        }
    }
    return {std::sqrt(squares[0]), std::sqrt(squares[1]), std::sqrt(squares[2]), std::sqrt(squares[3])};
}

// The density of one foam, about 1 in size at its filaments.
float foam(const std::array<float, 4>& d, float sharpness) {
    const float wall = std::exp(-(d[1] - d[0]) * sharpness);
    const float filament = std::exp(-(d[2] - d[0]) * sharpness);
    const float knot = std::exp(-(d[3] - d[0]) * sharpness);
    return 0.08F * wall + filament + 8 * knot * knot;
}

class CosmicWeb final : public Formula {
  public:
    CosmicWeb(const volume::Index3& n, std::uint64_t seed)
        : n_(n), cell_(static_cast<float>(std::max({n[0], n[1], n[2]})) / voids_across), seed_(seed) {}

    Description description() const override {
        return {.object = "Cosmic web", .unit = "log10 density", .axes = {}, .keywords = {}};
    }

    void plane(std::int64_t z, std::span<float> out) const override {
        std::size_t i = 0;
        for (std::int64_t y = 0; y < n_[1]; ++y) {
            for (std::int64_t x = 0; x < n_[0]; ++x) {
                out[i++] = log_density({static_cast<float>(x) / cell_, static_cast<float>(y) / cell_,
                                        static_cast<float>(z) / cell_});
            }
        }
    }

  private:
    static constexpr float voids_across = 5;

    float log_density(const Point& p) const {
        // Flows bend the foam's flat walls.
        const auto bent = [&](float coordinate, std::uint64_t which) {
            return coordinate +
                   0.11F * fractal_noise(1.3F * p.x, 1.3F * p.y, 1.3F * p.z, 2, 0.5F, seed_ + which);
        };
        const Point q = {bent(p.x, 1), bent(p.y, 2), bent(p.z, 3)};
        const float coarse = foam(nearest(q, seed_ + 4), 9);
        const std::array<float, 4> finer = nearest({2.7F * q.x, 2.7F * q.y, 2.7F * q.z}, seed_ + 5);
        const float fine = foam(finer, 7);
        // A halo sits on each point of the finer lattice, as heavy as its surroundings are dense.
        const float core = finer[0] * 6;
        const float halo = 1 / ((0.15F + core * core) * (0.6F + core));
        const float density =
            0.03F + coarse * (0.7F + 0.8F * fine + 1.6F * halo * std::min(coarse, 1.0F)) + 0.04F * fine;
        return std::log10(density);
    }

    volume::Index3 n_;
    float cell_;  // voxels for a void
    std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<Formula> make_cosmic_web(const volume::Index3& n, std::uint64_t seed) {
    return std::make_unique<CosmicWeb>(n, seed);
}

}  // namespace shearwater::samples
