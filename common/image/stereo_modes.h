#pragma once
// A pair of pictures, for the left eye and for the right one, as one picture that some device shows.

#include <array>
#include <optional>
#include <string_view>

#include "common/image/image.h"
#include "common/view/camera.h"

namespace shearwater::image {

enum class StereoMode {
    side_by_side,  // the left eye's on the left, each whole: twice as wide
    top_bottom,    // the left eye's on top, each whole: twice as high
    anaglyph,      // through glasses that are red on the left and cyan on the right
    interlaced,    // rows 0, 2, 4 ... are the left eye's, of a display that polarises its rows by turns
    left,
    right,
    // Each eye's by itself, as the device takes it; where one picture is wanted they are side by side:
    quad_buffered,  // a buffer an eye, of a display that shows them by turns to shutter glasses
    two_windows,    // a window an eye, for a projector each
};
// In the order of StereoMode.
inline constexpr std::array<std::string_view, 8> stereo_mode_names{
    "side-by-side", "top-bottom", "anaglyph", "interlaced", "left", "right", "quad-buffered", "two-windows"};
std::optional<StereoMode> stereo_mode(std::string_view name);

// Whether a device is given both pictures as they are.
constexpr bool is_apart(StereoMode mode) {
    return mode == StereoMode::quad_buffered || mode == StereoMode::two_windows;
}

// Of a picture made from a pair of so large ones.
view::ImageSize composed_size(const view::ImageSize& eye, StereoMode mode);

// The pictures are of one size.
//
// Anaglyphs are Dubois' (2009, "Conversion of a stereo pair to anaglyph with the least-squares projection
// method"): of all colours that can be shown, that is taken which, seen through both filters, comes nearest
// to the pair as seen without. It takes from each channel what of it leaks through the wrong filter, and so
// has the least ghosts of what colour keeps; half-colour and full-colour anaglyphs have more of them, grey
// ones no colour. Light is mixed, not its codes: they are taken as sRGB.
Image<Rgba8> composed(const Image<Rgba8>& left, const Image<Rgba8>& right, StereoMode mode);

}  // namespace shearwater::image
