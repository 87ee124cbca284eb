#pragma once
// The form windows travel in: of each row only the stretches that are not wholly transparent, at 16 bits a
// channel.
//
//   window:  | row | row | ...              the rows of its rectangle, from the top
//   row:     | spans | span | span | ...
//   span:    | x | length | r g b a | r g b a | ...   from left to right
//
// All are little-endian numbers of 16 bits; x counts from the edge of the face.

#include <cstddef>
#include <span>

#include "common/base/result.h"
#include "common/image/image.h"

namespace shearwater::image {

// A window as it travels, not owned: what SpanWriter wrote, or check_spans found to be sound.
struct SpanWindow {
    int face = 0;
    Rect rect;
    std::span<const std::byte> bytes;
};

// The most bytes that a window of this rectangle takes.
std::size_t spans_bound(const Rect& rect);

// Codes a window into `out`, of at least spans_bound bytes. What comes back has the smallest rectangle that
// holds all that is not transparent: an empty one, and no bytes, where nothing is. A few transparent pixels
// may stay inside a span, where a new one would save little.
SpanWindow encode_spans(const Window& window, std::span<std::byte> out);

// Looks at untrusted bytes that begin with a window of this rectangle, and gives how many of them are its
// own. Its spans keep to the rectangle and are whole; along a row they rise, with a gap in between.
base::Result<std::size_t> check_spans(std::span<const std::byte> bytes, const Rect& rect);

// Reads the spans of a row, the first of the row on its creation.
class SpanReader {
  public:
    explicit SpanReader(const std::byte* row);

    bool done() const { return left_ < 0; }
    int x() const { return x_; }
    int end() const { return x_ + length_; }
    const Rgba16* pixels() const { return pixels_; }  // of [x, end)
    // Leaves out what is left of `to`, which lies in the present span or at its end.
    void skip_to(int to);
    // After the row's last span.
    const std::byte* row_end() const { return next_; }

  private:
    void next();

    int left_;  // spans after this one; below 0: it is none
    int x_ = 0;
    int length_ = 0;
    const Rgba16* pixels_ = nullptr;
    const std::byte* next_;
};

// The row after this one, or the end of the window.
const std::byte* after_row(const std::byte* row);

// Writes a window row by row. `out` has room for all of it: spans_bound bytes of its rectangle.
class SpanWriter {
  public:
    explicit SpanWriter(std::span<std::byte> out) : out_(out) {}

    void begin_row();
    // Where the next `length` pixels of the row go, from x on.
    std::span<Rgba16> put(int x, int length);
    // A row as it came.
    void copy_row(std::span<const std::byte> row);

    std::size_t written() const { return at_; }
    bool row_empty() const { return spans_ == 0; }
    int row_first() const { return first_; }  // of a row that is not empty
    int row_last() const { return end_; }
    // Takes the last rows back, from where `written` was so much.
    void cut(std::size_t written) { at_ = written; }

  private:
    void store(std::size_t at, int value);

    std::span<std::byte> out_;
    std::size_t at_ = 0;
    std::size_t row_ = 0;     // where the row began
    std::size_t length_ = 0;  // where the present span's length is
    int spans_ = 0;           // of the row
    int first_ = 0;
    int end_ = 0;
};

}  // namespace shearwater::image
