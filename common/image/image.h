#pragma once
// Pixels and the images and windows made of them. All colours are premultiplied by opacity.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "common/base/check.h"
#include "common/image/lit_blocks.h"
#include "common/view/factorisation.h"

namespace shearwater::image {

using view::Rect;

struct RgbaF {
    float r = 0, g = 0, b = 0, a = 0;
};
struct Rgba16 {  // 0..65535 stand for 0..1; the form windows travel in
    std::uint16_t r = 0, g = 0, b = 0, a = 0;
    bool operator==(const Rgba16&) const = default;
};
struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 0;
    bool operator==(const Rgba8&) const = default;
};

// For an image that is written to from end to end: its pixels are not made transparent first.
struct Unfilled {};

// A dense image, row 0 first, move-only, zeroed unless told otherwise. Functions take Image& or spans of
// rows.
template <class Pixel>
class Image {
  public:
    Image() = default;
    Image(int width, int height) : Image(width, height, Unfilled()) {
        std::fill(pixels_.begin(), pixels_.end(), Pixel{});
    }
    Image(int width, int height, Unfilled)
        : width_(width),
          height_(height),
          pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
    Image(Image&&) noexcept = default;
    Image& operator=(Image&&) noexcept = default;
    Image(const Image&) = delete;
    Image& operator=(const Image&) = delete;

    // Of another size, in the same memory where that is enough. Its pixels are to be written.
    void reshape(int width, int height) {
        const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (count > pixels_.capacity()) {
            pixels_ = {};
        }
        pixels_.resize(count);
        width_ = width;
        height_ = height;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return pixels_.empty(); }
    std::span<Pixel> row(int y) { return {pixels_.data() + start(y), static_cast<std::size_t>(width_)}; }
    std::span<const Pixel> row(int y) const {
        return {pixels_.data() + start(y), static_cast<std::size_t>(width_)};
    }
    Pixel& at(int x, int y) { return row(y)[static_cast<std::size_t>(x)]; }
    const Pixel& at(int x, int y) const { return row(y)[static_cast<std::size_t>(x)]; }
    std::span<Pixel> pixels() & { return pixels_; }
    std::span<const Pixel> pixels() const& { return pixels_; }
    void pixels() && = delete;  // they would be gone before anyone looked at them
    void pixels() const&& = delete;
    Image clone() const {
        Image copy(width_, height_);
        copy.pixels_ = pixels_;
        return copy;
    }

  private:
    // Leaves elements without a value as the memory was.
    template <class T>
    struct Memory : std::allocator<T> {
        template <class U>
        struct rebind {
            using other = Memory<U>;
        };
        void construct(T*) noexcept {}
        void construct(T* at, const T& value) noexcept { std::construct_at(at, value); }
    };

    std::size_t start(int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_); }

    int width_ = 0;
    int height_ = 0;
    std::vector<Pixel, Memory<Pixel>> pixels_;
};

// The part of one face's intermediate image that a box projects to. rect is in the face's pixels and of
// the image's size; what lies outside is transparent.
struct Window {
    int face = 0;  // index into Factorisation::faces
    Rect rect;
    Image<RgbaF> pixels;
    LitBlocks lit{};  // of its pixels, where whoever filled them has noted it
};

}  // namespace shearwater::image
