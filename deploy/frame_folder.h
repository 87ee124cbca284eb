#pragma once
// A movie's frames on disk, one PNG each, and whose they are: a movie that was stopped goes on where it was.

#include <filesystem>
#include <string>

#include "common/base/result.h"
#include "common/image/image.h"

namespace shearwater::deploy {

class FrameFolder {
  public:
    // Makes the folder in one that is there, or goes on in one that holds frames of the same movie: `movie`
    // is a text that tells it from every other. Frames of another are an error, or with `anew` removed.
    static base::Result<FrameFolder> open(const std::filesystem::path& folder, const std::string& movie,
                                          bool anew);

    bool has(int frame) const;
    base::Status write(int frame, const image::Image<image::Rgba8>& picture) const;
    // Of printf, with the frame's number.
    std::string pattern() const;
    // The whole folder, when its frames are of no more use.
    void remove() const;

  private:
    explicit FrameFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}
    std::filesystem::path path_of(int frame) const;

    std::filesystem::path folder_;
};

}  // namespace shearwater::deploy
