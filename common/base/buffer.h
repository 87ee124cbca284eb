#pragma once
// Bytes on their way somewhere: made to be written at once, so a new one is not filled first.

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace shearwater::base {

// An allocator under which elements without a value stay as the memory was.
template <class T>
struct Unfilled : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = Unfilled<U>;
    };
    template <class U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        std::construct_at(at, std::forward<Arguments>(arguments)...);
    }
};

// Memory that a long buffer is not yet written to costs nothing but addresses.
using Buffer = std::vector<std::byte, Unfilled<std::byte>>;

}  // namespace shearwater::base
