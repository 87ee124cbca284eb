#pragma once
// From frames to a film, by ffmpeg.

#include <string>

#include "common/base/result.h"

namespace shearwater::deploy {

// H.264 in the container that the file's name asks for: .mp4, .mkv or .mov. A frame of odd size gets a line
// of black at its right or lower edge. `frames` is printf's pattern of their names. The film is there whole
// or not at all. Not found: there is no ffmpeg here.
base::Status encode_film(const std::string& frames, int fps, const std::string& film);
// Whether a name is one of a film.
bool is_film(const std::string& path);

}  // namespace shearwater::deploy
