#pragma once
// Integers as FITS stores them.

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace shearwater::fits {

template <class Integer>
std::int64_t big_endian(const char* bytes) {
    std::make_unsigned_t<Integer> value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
        value =
            static_cast<std::make_unsigned_t<Integer>>(value << 8U) | static_cast<unsigned char>(bytes[i]);
    }
    return static_cast<Integer>(value);
}

}  // namespace shearwater::fits
