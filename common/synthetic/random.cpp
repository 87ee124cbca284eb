// Fields of independent values: nothing in them can be skipped, and no two neighbours are alike.

#include "common/synthetic/hash.h"
#include "common/synthetic/make.h"
#include "common/synthetic/rows.h"

namespace shearwater::synthetic {

namespace {

// A voxel's value is `Value` of its hash.
template <class Value>
class Random final : public Field {
  public:
    explicit Random(std::uint64_t seed) : seed_(seed) {}

    void fill(const volume::Box& box, std::span<float> out) const override {
        for_each_row(box, out, [&](std::int64_t y, std::int64_t z, std::span<float> row) {
            std::int64_t x = box.lo[0];
            for (float& value : row) {
                value = Value{}(hash(x++, y, z, seed_));
            }
        });
    }

  private:
    std::uint64_t seed_;
};

struct UnitInterval {
    float operator()(std::uint64_t bits) const { return uniform(bits); }
};

struct Byte {
    float operator()(std::uint64_t bits) const {
        // By way of a signed integer of 32 bits, which is what processors turn into a float at once.
        return static_cast<float>(static_cast<std::int32_t>(bits >> 56U));
    }
};

}  // namespace

std::unique_ptr<const Field> make_random(std::uint64_t seed) {
    return std::make_unique<Random<UnitInterval>>(seed);
}

std::unique_ptr<const Field> make_random_bytes(std::uint64_t seed) {
    return std::make_unique<Random<Byte>>(seed);
}

}  // namespace shearwater::synthetic
