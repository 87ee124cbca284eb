#pragma once
// What a pass of widgets would draw, as a number: passes that look alike are drawn once.

#include <cstdint>

struct ImDrawData;

namespace shearwater::ui {

// Of all vertices, in the order and within the limits that they are drawn in, and of the window's size;
// textures count by their names, not by what they hold. Passes that differ have other numbers, but for one in
// 2^64 of them.
std::uint64_t likeness(const ImDrawData& pass);

}  // namespace shearwater::ui
