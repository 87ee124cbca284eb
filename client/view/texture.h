#pragma once
// A picture on the graphics card.

#include <cstdint>

#include "common/image/image.h"

namespace shearwater::ui {

// Owns its texture; to be made, changed and destroyed while the window's context is current.
class Texture {
  public:
    Texture() = default;
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    void upload(const image::Image<image::Rgba8>& picture);

    bool empty() const { return id_ == 0; }
    unsigned id() const { return id_; }
    int width() const { return width_; }
    int height() const { return height_; }
    std::uint64_t uploads() const { return uploads_; }  // so far

  private:
    unsigned id_ = 0;
    int width_ = 0;
    int height_ = 0;
    std::uint64_t uploads_ = 0;
};

}  // namespace shearwater::ui
