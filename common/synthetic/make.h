#pragma once
// The fields, one by one.

#include "common/synthetic/field.h"

namespace shearwater::synthetic {

std::unique_ptr<const Field> make_slab();
std::unique_ptr<const Field> make_ball(const volume::Index3& n);
std::unique_ptr<const Field> make_random(std::uint64_t seed);
std::unique_ptr<const Field> make_random_bytes(std::uint64_t seed);
std::unique_ptr<const Field> make_noise_sources(const volume::Index3& n, std::uint64_t seed);

}  // namespace shearwater::synthetic
