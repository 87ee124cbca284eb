// What a survey's cube is like: noise all over, and a few bright things in it. Noise has mean 40 and
// deviation 10; 40 compact sources and 4 filaments rise out of it; all is cut at 0 and 255. About one
// voxel in 600 is above 80, most of them in sources, but noise strays there too.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/synthetic/hash.h"
#include "common/synthetic/make.h"
#include "common/synthetic/normal.h"
#include "common/synthetic/rows.h"

namespace shearwater::synthetic {

namespace {

struct Blob {
    std::array<float, 3> middle;
    float width;  // deviation in voxels
    float peak;
};

// One number after another from one seed.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    float between(float lo, float hi) { return lo + (hi - lo) * uniform(hash(count_++, -1, -1, seed_)); }
    std::array<float, 3> place(const volume::Index3& n, float margin) {
        std::array<float, 3> place{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place[axis] = static_cast<float>(n[axis]) * between(margin, 1 - margin);
        }
        return place;
    }

  private:
    std::uint64_t seed_;
    std::int64_t count_ = 0;
};

constexpr int compact_sources = 40;
constexpr int filaments = 4;
constexpr int beads = 160;  // of a filament

// Beads along a cubic curve between random points.
void string_beads(Dice& dice, const volume::Index3& n, float scale, std::vector<Blob>& blobs) {
    std::array<std::array<float, 3>, 4> p;
    for (auto& point : p) {
        point = dice.place(n, 0.1F);
    }
    for (int i = 0; i < beads; ++i) {
        const float t = static_cast<float>(i) / (beads - 1);
        const float s = 1 - t;
        Blob bead{.middle = {}, .width = 3 * scale, .peak = 55};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bead.middle[axis] = s * s * s * p[0][axis] + 3 * s * s * t * p[1][axis] +
                                3 * s * t * t * p[2][axis] + t * t * t * p[3][axis];
        }
        blobs.push_back(bead);
    }
}

std::vector<Blob> scatter(const volume::Index3& n, std::uint64_t seed) {
    Dice dice(seed);
    const float scale = static_cast<float>(std::min({n[0], n[1], n[2]})) / 512;
    std::vector<Blob> blobs;
    for (int i = 0; i < compact_sources; ++i) {
        blobs.push_back({.middle = dice.place(n, 0.08F),
                         .width = scale * dice.between(2, 7),
                         .peak = dice.between(80, 215)});
    }
    for (int i = 0; i < filaments; ++i) {
        string_beads(dice, n, scale, blobs);
    }
    return blobs;
}

// The voxels along one axis of [lo, hi] that a blob is in, last included. It ends after four deviations.
struct Reach {
    std::int64_t first, last;
    bool empty() const { return last < first; }
};

Reach reach(const Blob& blob, std::size_t axis, std::int64_t lo, std::int64_t hi) {
    const auto middle = static_cast<std::int64_t>(blob.middle[axis]);
    const auto radius = static_cast<std::int64_t>(std::ceil(4 * blob.width));
    return {std::max(lo, middle - radius), std::min(hi, middle + radius)};
}

bool meets(const Blob& blob, const volume::Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (reach(blob, axis, box.lo[axis], box.hi[axis]).empty()) {
            return false;
        }
    }
    return true;
}

// A blob's factor along one axis, where it is in [lo, hi].
struct Profile {
    std::int64_t first = 0;
    std::vector<float> factors;

    Profile(const Blob& blob, std::size_t axis, std::int64_t lo, std::int64_t hi) {
        const Reach within = reach(blob, axis, lo, hi);
        first = within.first;
        for (std::int64_t at = within.first; at <= within.last; ++at) {
            const float deviations = (static_cast<float>(at) - blob.middle[axis]) / blob.width;
            factors.push_back(std::exp(-0.5F * deviations * deviations));
        }
    }
    // 0 outside.
    float at(std::int64_t index) const {
        const std::int64_t i = index - first;
        return i >= 0 && i < std::ssize(factors) ? factors[static_cast<std::size_t>(i)] : 0.0F;
    }
};

// A blob's part in a box.
struct Part {
    float peak;
    std::array<Profile, 3> along;
};

class NoiseSources final : public Field {
  public:
    NoiseSources(const volume::Index3& n, std::uint64_t seed) : blobs_(scatter(n, seed)), seed_(seed) {}

    void fill(const volume::Box& box, std::span<float> out) const override {
        const std::vector<Part> parts = parts_in(box);
        for_each_row(box, out, [&](std::int64_t y, std::int64_t z, std::span<float> row) {
            std::int64_t x = box.lo[0];
            for (float& value : row) {
                value = 40 + 10 * normal_(hash(x++, y, z, seed_));
            }
            for (const Part& part : parts) {
                add(part, y, z, box.lo[0], row);
            }
            for (float& value : row) {
                value = std::clamp(value, 0.0F, 255.0F);
            }
        });
    }

  private:
    std::vector<Part> parts_in(const volume::Box& box) const {
        std::vector<Part> parts;
        for (const Blob& blob : blobs_) {
            if (meets(blob, box)) {
                parts.push_back(
                    {.peak = blob.peak,
                     .along = {Profile(blob, 0, box.lo[0], box.hi[0]), Profile(blob, 1, box.lo[1], box.hi[1]),
                               Profile(blob, 2, box.lo[2], box.hi[2])}});
            }
        }
        return parts;
    }

    static void add(const Part& part, std::int64_t y, std::int64_t z, std::int64_t x0, std::span<float> row) {
        const float factor = part.peak * part.along[2].at(z) * part.along[1].at(y);
        if (factor > 0) {
            float* to = row.data() + (part.along[0].first - x0);
            for (const float across : part.along[0].factors) {
                *to++ += factor * across;
            }
        }
    }

    std::vector<Blob> blobs_;
    Normal normal_;
    std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<const Field> make_noise_sources(const volume::Index3& n, std::uint64_t seed) {
    return std::make_unique<NoiseSources>(n, seed);
}

}  // namespace shearwater::synthetic
