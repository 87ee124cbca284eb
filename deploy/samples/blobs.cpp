#include "deploy/samples/blobs.h"

#include <algorithm>
#include <cmath>

namespace shearwater::samples {

namespace {

constexpr float reach = 3.5F;  // deviations, beyond which a cloud has ended

float gauss(float deviations) {
    return std::exp(-0.5F * deviations * deviations);
}

void add_cut(const Blob& blob, float peak, std::int64_t nx, std::int64_t ny, std::span<float> plane) {
    const float radius = reach * blob.width;
    const auto first = [&](float middle) { return std::max<std::int64_t>(0, std::llround(middle - radius)); };
    const auto last = [&](float middle, std::int64_t n) {
        return std::min<std::int64_t>(n - 1, std::llround(middle + radius));
    };
    std::vector<float> across;
    for (std::int64_t x = first(blob.x); x <= last(blob.x, nx); ++x) {
        across.push_back(gauss((static_cast<float>(x) - blob.x) / blob.width));
    }
    for (std::int64_t y = first(blob.y); y <= last(blob.y, ny); ++y) {
        const float row = peak * gauss((static_cast<float>(y) - blob.y) / blob.width);
        float* const to = plane.data() + y * nx + first(blob.x);
        for (std::size_t i = 0; i < across.size(); ++i) {
            to[i] += row * across[i];
        }
    }
}

}  // namespace

Blobs::Blobs(std::vector<Blob> blobs) : blobs_(std::move(blobs)) {
    std::sort(blobs_.begin(), blobs_.end(), [](const Blob& a, const Blob& b) { return a.v < b.v; });
    for (const Blob& blob : blobs_) {
        widest_ = std::max(widest_, blob.dispersion);
    }
}

void Blobs::add(float v, std::int64_t nx, std::int64_t ny, std::span<float> plane) const {
    const auto slower = [](const Blob& blob, float than) { return blob.v < than; };
    const auto begin = std::lower_bound(blobs_.begin(), blobs_.end(), v - reach * widest_, slower);
    const auto end = std::lower_bound(begin, blobs_.end(), v + reach * widest_, slower);
    for (auto blob = begin; blob != end; ++blob) {
        const float deviations = (v - blob->v) / blob->dispersion;
        if (std::fabs(deviations) < reach) {
            add_cut(*blob, blob->peak * gauss(deviations), nx, ny, plane);
        }
    }
}

}  // namespace shearwater::samples
