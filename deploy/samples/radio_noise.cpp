#include "deploy/samples/radio_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "deploy/samples/noise.h"

namespace shearwater::samples {

RadioNoise::RadioNoise(std::int64_t nx, std::int64_t ny, float beam, std::uint64_t seed)
    : nx_(nx), ny_(ny), beam_(std::max(beam, 0.1F)), seed_(seed) {
    const int radius = std::max(1, static_cast<int>(std::ceil(2.5F * beam_)));
    float power = 0;
    for (int i = -radius; i <= radius; ++i) {
        const float deviations = static_cast<float>(i) / beam_;
        kernel_.push_back(std::exp(-0.5F * deviations * deviations));
        power += kernel_.back() * kernel_.back();
    }
    for (float& weight : kernel_) {
        weight /= std::sqrt(power);
    }
}

// White noise under the Hanning smoothing of the channels, from half a kernel before the row on.
void RadioNoise::fill_white(std::int64_t y, std::int64_t z, std::span<float> row) const {
    constexpr float power = 0.61237244F;  // of the weights 1/4, 1/2, 1/4
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto x = static_cast<std::int64_t>(i);
        const float sides = normal(hash(x, y, z - 1, seed_)) + normal(hash(x, y, z + 1, seed_));
        row[i] = (0.25F * sides + 0.5F * normal(hash(x, y, z, seed_))) / power;
    }
}

void RadioNoise::add(std::int64_t z, float level, std::span<float> plane) const {
    const auto nx = static_cast<std::size_t>(nx_);
    const std::size_t taps = kernel_.size();
    std::vector<float> white(nx + taps - 1);
    std::vector<float> smooth(nx);
    std::vector<float> noise(plane.size(), 0.0F);
    for (std::int64_t y = 0; y < ny_ + static_cast<std::int64_t>(taps) - 1; ++y) {
        fill_white(y, z, white);
        std::fill(smooth.begin(), smooth.end(), 0.0F);
        for (std::size_t k = 0; k < taps; ++k) {
            for (std::size_t x = 0; x < nx; ++x) {
                smooth[x] += kernel_[k] * white[x + k];
            }
        }
        for (std::size_t k = 0; k < taps; ++k) {
            const std::int64_t to = y - static_cast<std::int64_t>(k);
            for (std::size_t x = 0; to >= 0 && to < ny_ && x < nx; ++x) {
                noise[static_cast<std::size_t>(to) * nx + x] += kernel_[k] * smooth[x];
            }
        }
    }
    constexpr float primary_beam = 1.15F;  // its width at half power, in lengths of the axes
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const float x = (static_cast<float>(i % nx) + 0.5F) / static_cast<float>(nx_) - 0.5F;
        const float y = (static_cast<float>(i / nx) + 0.5F) / static_cast<float>(ny_) - 0.5F;
        const float gain = std::exp2(-4 * (x * x + y * y) / (primary_beam * primary_beam));
        plane[i] = gain < 0.5F ? std::numeric_limits<float>::quiet_NaN() : plane[i] + level * noise[i] / gain;
    }
}

}  // namespace shearwater::samples
