// Neutral hydrogen in position, position and velocity: two discs, the gas between them, and the noise
// of the telescope.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "common/base/workers.h"
#include "deploy/samples/blobs.h"
#include "deploy/samples/disc.h"
#include "deploy/samples/formula.h"
#include "deploy/samples/noise.h"
#include "deploy/samples/radio_noise.h"

namespace shearwater::samples {

namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;
constexpr float sky_units = 128;       // across the shorter side of the sky
constexpr float velocity_range = 403;  // km/s over all channels
constexpr float systemic = 40;         // km/s, of the header only
constexpr float sky_unit_arcsec = 12;
constexpr float noise_level = 0.0007F;  // Jy/beam in the middle of the field

constexpr Disc galaxy = {.x = 57,
                         .y = 66,
                         .v = 0,
                         .inclination = 36 * degree,
                         .position_angle = 62 * degree,
                         .radius = 48,
                         .scale = 24,
                         .hole = 7,
                         .speed = 190,
                         .turnover = 6,
                         .arms = 2,
                         .pitch = 20 * degree,
                         .contrast = 0.55F,
                         .clumping = 0.42F,
                         .warp_inclination = 15 * degree,
                         .warp_angle = -38 * degree};
// Gas above the disc, smoother, wider in velocity, and slower.
constexpr Disc halo = {.x = 57,
                       .y = 66,
                       .v = 0,
                       .inclination = 36 * degree,
                       .position_angle = 62 * degree,
                       .radius = 42,
                       .scale = 22,
                       .hole = 5,
                       .speed = 150,
                       .turnover = 7,
                       .arms = 2,
                       .pitch = 20 * degree,
                       .contrast = 0.3F,
                       .clumping = 0.3F,
                       .warp_inclination = 15 * degree,
                       .warp_angle = -38 * degree};
constexpr Disc companion = {.x = 104,
                            .y = 29,
                            .v = 78,
                            .inclination = 52 * degree,
                            .position_angle = 120 * degree,
                            .radius = 14,
                            .scale = 5,
                            .hole = 1.5F,
                            .speed = 62,
                            .turnover = 3,
                            .arms = 2,
                            .pitch = 25 * degree,
                            .contrast = 0.5F,
                            .clumping = 0.4F,
                            .warp_inclination = 0,
                            .warp_angle = 0};

// What every line of sight crosses of a disc: a density and a velocity for each pixel.
struct Sheet {
    std::vector<float> density, velocity;
    float dispersion;
};

using Random = std::mt19937_64;

float uniform_in(Random& random, float low, float high) {
    return low + (high - low) * static_cast<float>(random() >> 40U) * 0x1p-24F;
}

// The same on every machine, unlike the standard library's.
float normal_of(Random& random) {
    return normal(random());
}

struct Node {
    float x, y, v;
};

float bezier(float t, float a, float b, float c, float d) {
    const float u = 1 - t;
    return u * u * u * a + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d;
}

Node on_disc(const Disc& disc, float x, float y) {
    const auto place = place_seen_at(disc, x, y);
    return {x, y, place ? appearance(disc, *place).v : disc.v};
}

class HiGalaxy final : public Formula {
  public:
    HiGalaxy(const volume::Index3& n, std::uint64_t seed)
        : n_(n),
          scale_(static_cast<float>(std::min(n[0], n[1])) / sky_units),
          channel_(velocity_range / static_cast<float>(n[2])),
          noise_(n[0], n[1], 1.5F * std::min(scale_, 4.0F), seed),
          seed_(seed),
          sheets_{sheet(galaxy, 0.042F, 8, seed + 1), sheet(halo, 0.003F, 20, seed + 2),
                  sheet(companion, 0.05F, 15, seed + 3)},
          clouds_(clouds()) {}

    Description description() const override;
    void plane(std::int64_t z, std::span<float> out) const override;

  private:
    float sky_x(float x) const { return (x - static_cast<float>(n_[0] - 1) / 2) / scale_ + sky_units / 2; }
    float sky_y(float y) const { return (y - static_cast<float>(n_[1] - 1) / 2) / scale_ + sky_units / 2; }
    Blob blob(const Node& at, float peak, float width, float dispersion) const;

    Sheet sheet(const Disc& disc, float peak, float dispersion, std::uint64_t seed) const;
    std::vector<Blob> clouds() const;
    void add_complexes(const Disc& disc, int count, float peak, Random& random,
                       std::vector<Blob>& blobs) const;
    void add_stream(const std::array<Node, 4>& path, int count, float peak, float width0, float width1,
                    Random& random, std::vector<Blob>& blobs) const;
    void add_sheet(const Sheet& sheet, float v, std::span<float> out) const;
    float turbulence(std::int64_t x, std::int64_t y, float v) const;

    volume::Index3 n_;
    float scale_;    // pixels for a sky unit
    float channel_;  // km/s
    RadioNoise noise_;
    std::uint64_t seed_;
    std::array<Sheet, 3> sheets_;
    Blobs clouds_;
};

Description HiGalaxy::description() const {
    const double pixel = sky_unit_arcsec / 3600.0 / scale_;
    const double beam = noise_.beam() * pixel * 2.3548;
    const auto middle = [&](std::size_t axis) { return static_cast<double>(n_[axis] + 1) / 2; };
    return {.object = "Synthetic spiral",
            .unit = "Jy/beam",
            .axes = {{"RA---SIN", "deg", 150, middle(0), -pixel},
                     {"DEC--SIN", "deg", 30, middle(1), pixel},
                     {"VRAD", "m/s", systemic * 1e3, middle(2), channel_ * 1e3}},
            .keywords = {
                {"BMAJ", beam}, {"BMIN", beam}, {"BPA", 0}, {"RESTFRQ", 1.42040575e9}, {"EQUINOX", 2000}}};
}

Sheet HiGalaxy::sheet(const Disc& disc, float peak, float dispersion, std::uint64_t seed) const {
    const auto pixels = static_cast<std::size_t>(n_[0] * n_[1]);
    Sheet sheet{std::vector<float>(pixels), std::vector<float>(pixels), dispersion};
    base::Workers workers;
    workers.for_each(n_[1], [&](std::int64_t y) {
        for (std::int64_t x = 0; x < n_[0]; ++x) {
            const auto i = static_cast<std::size_t>(y * n_[0] + x);
            const auto place =
                place_seen_at(disc, sky_x(static_cast<float>(x)), sky_y(static_cast<float>(y)));
            if (place) {
                sheet.density[i] = peak * density(disc, *place, seed);
                sheet.velocity[i] = appearance(disc, *place).v;
            }
        }
    });
    return sheet;
}

Blob HiGalaxy::blob(const Node& at, float peak, float width, float dispersion) const {
    return {.x = (at.x - sky_units / 2) * scale_ + static_cast<float>(n_[0] - 1) / 2,
            .y = (at.y - sky_units / 2) * scale_ + static_cast<float>(n_[1] - 1) / 2,
            .v = at.v,
            .peak = peak,
            .width = width * scale_,
            .dispersion = dispersion};
}

// Cloud complexes, most of them on the arms.
void HiGalaxy::add_complexes(const Disc& disc, int count, float peak, Random& random,
                             std::vector<Blob>& blobs) const {
    for (int tries = 0; count > 0 && tries < 200000; ++tries) {
        const DiscPlace place{disc.radius * std::sqrt(uniform_in(random, 0, 0.8F)),
                              uniform_in(random, 0, 2 * std::numbers::pi_v<float>)};
        const float inner = 1 - 0.9F * std::exp(-(place.r / disc.hole) * (place.r / disc.hole));
        const float arm = arm_strength(disc, place);
        if (place.r > disc.radius || uniform_in(random, 0, 1) > inner * arm * arm) {
            continue;
        }
        const SkyPlace seen = appearance(disc, place);
        const float strength = std::exp(0.6F * normal_of(random)) * std::exp(-place.r / (2 * disc.scale));
        blobs.push_back(blob({seen.x, seen.y, seen.v + 4 * normal_of(random)}, peak * strength,
                             uniform_in(random, 0.7F, 1.6F), uniform_in(random, 4, 8)));
        --count;
    }
}

// Gas along a curve through sky and velocity, in knots.
void HiGalaxy::add_stream(const std::array<Node, 4>& path, int count, float peak, float width0, float width1,
                          Random& random, std::vector<Blob>& blobs) const {
    const auto& [a, b, c, d] = path;
    for (int i = 0; i < count; ++i) {
        const float t = (static_cast<float>(i) + uniform_in(random, 0, 1)) / static_cast<float>(count);
        const float width = width0 + (width1 - width0) * t;
        const float knots = 1 + 0.7F * std::sin(9 * t + 1.3F) * std::sin(23 * t);
        const Node at = {bezier(t, a.x, b.x, c.x, d.x) + 0.6F * width * normal_of(random),
                         bezier(t, a.y, b.y, c.y, d.y) + 0.6F * width * normal_of(random),
                         bezier(t, a.v, b.v, c.v, d.v) + 4 * normal_of(random)};
        blobs.push_back(blob(at, peak * knots * std::exp(0.4F * normal_of(random)),
                             width * uniform_in(random, 0.6F, 1.1F), uniform_in(random, 6, 11)));
    }
}

std::vector<Blob> HiGalaxy::clouds() const {
    Random random(seed_ + 4);
    std::vector<Blob> blobs;
    add_complexes(galaxy, 1800, 0.014F, random, blobs);
    add_complexes(companion, 60, 0.012F, random, blobs);
    // The bridge leaves one disc and enters the other at their own velocities, the tail leaves too.
    const Node near_side = on_disc(galaxy, 79, 52);
    const Node arrival = on_disc(companion, 106, 35);
    const Node far_side = on_disc(galaxy, 80, 98);
    add_stream({near_side, {94, 66, 62}, {122, 60, 108}, arrival}, 420, 0.0015F, 1.5F, 2.2F, random, blobs);
    add_stream({far_side, {66, 127, far_side.v + 30}, {36, 124, 92}, {17, 102, 40}}, 460, 0.0012F, 1.4F, 3.2F,
               random, blobs);
    return blobs;
}

// The gas is clumpy in velocity as it is on the sky.
float HiGalaxy::turbulence(std::int64_t x, std::int64_t y, float v) const {
    const float finest = 0.16F / scale_;
    const float noise = fractal_noise(static_cast<float>(x) * finest, static_cast<float>(y) * finest, v / 22,
                                      3, 0.6F, seed_ + 5);
    return std::exp(0.35F * noise);
}

void HiGalaxy::add_sheet(const Sheet& sheet, float v, std::span<float> out) const {
    constexpr float reach = 4.5F;
    constexpr float unseen = 1e-6F;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float deviations = (v - sheet.velocity[i]) / sheet.dispersion;
        const float value = sheet.density[i] * std::exp(-0.5F * deviations * deviations);
        if (std::fabs(deviations) < reach && value > unseen) {
            const auto at = static_cast<std::int64_t>(i);
            out[i] += value * turbulence(at % n_[0], at / n_[0], v);
        }
    }
}

void HiGalaxy::plane(std::int64_t z, std::span<float> out) const {
    const float v = (static_cast<float>(z) - static_cast<float>(n_[2] - 1) / 2) * channel_;
    std::fill(out.begin(), out.end(), 0.0F);
    for (const Sheet& sheet : sheets_) {
        add_sheet(sheet, v, out);
    }
    clouds_.add(v, n_[0], n_[1], out);
    noise_.add(z, noise_level, out);
}

}  // namespace

std::unique_ptr<Formula> make_hi_galaxy(const volume::Index3& n, std::uint64_t seed) {
    return std::make_unique<HiGalaxy>(n, seed);
}

}  // namespace shearwater::samples
