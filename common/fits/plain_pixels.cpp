#include "common/fits/plain_pixels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

namespace shearwater::fits {

namespace {

// As much as stays in the processor's caches between reading and decoding.
constexpr std::int64_t piece_bytes = std::int64_t{128} << 10;
// Bytes between two runs that are read along with them, since asking twice costs more.
constexpr std::int64_t widest_gap = std::int64_t{4} << 10;

// The pixels of a box as they lie in the file: runs of pixels at equal steps, in the order of the box. Rows
// and planes that follow each other at the same step are one run, and what is longer than a piece is cut.
class Runs {
  public:
    Runs(const volume::Box& box, std::int64_t first, const volume::Index3& steps, std::int64_t pixel_bytes)
        : first_(first), step_(steps[0]), pixel_bytes_(pixel_bytes), row_(box.planes(0)) {
        for (int axis = 0; axis < 3; ++axis) {
            first_ += box.lo[axis] * steps[axis];
        }
        rows_ = {box.planes(1), box.planes(2)};
        row_steps_ = {steps[1], steps[2]};
        while (row_steps_[0] == row_ * step_ && rows_[0] * rows_[1] > 1) {
            row_ *= rows_[0];
            rows_ = {rows_[1], 1};
            row_steps_ = {row_steps_[1], 0};
        }
        longest_ = std::clamp<std::int64_t>(piece_bytes / step_, 1, row_);
        cuts_ = (row_ + longest_ - 1) / longest_;
    }

    std::int64_t count() const { return cuts_ * rows_[0] * rows_[1]; }
    std::int64_t pixels(std::int64_t run) const { return std::min(longest_, row_ - run % cuts_ * longest_); }
    // Where its first pixel begins and where its last one ends.
    std::int64_t begin(std::int64_t run) const {
        const std::int64_t row = run / cuts_;
        return first_ + run % cuts_ * longest_ * step_ + row % rows_[0] * row_steps_[0] +
               row / rows_[0] * row_steps_[1];
    }
    std::int64_t end(std::int64_t run) const { return begin(run) + (pixels(run) - 1) * step_ + pixel_bytes_; }

    // The run behind the last of those that are worth reading at once with this one.
    std::int64_t end_of_group(std::int64_t run) const {
        const std::int64_t limit = begin(run) + piece_bytes;
        std::int64_t next = run + 1;
        while (next < count() && end(next) <= limit && begin(next) - end(next - 1) <= widest_gap) {
            ++next;
        }
        return next;
    }

    // The most bytes that a group spans.
    std::int64_t longest_group() const {
        return std::max(std::min(piece_bytes, end(count() - 1) - begin(0)), end(0) - begin(0));
    }

  private:
    std::int64_t first_, step_, pixel_bytes_;
    std::int64_t row_;                    // pixels
    std::array<std::int64_t, 2> rows_{};  // two nested loops of them
    std::array<std::int64_t, 2> row_steps_{};
    std::int64_t longest_, cuts_;  // pixels of a run, and runs of a row
};

// Moves pixels that lie `step` bytes apart together.
void close_up(char* pixels, std::int64_t count, std::int64_t step, std::size_t pixel_bytes) {
    for (std::int64_t i = 1; i < count; ++i) {
        std::memmove(pixels + static_cast<std::size_t>(i) * pixel_bytes, pixels + i * step, pixel_bytes);
    }
}

}  // namespace

PlainPixels::PlainPixels(const Hdu& hdu, const CubeAxes& axes, const Encoding& encoding)
    : encoding_(encoding), first_(hdu.header.data_offset()) {
    auto step = static_cast<std::int64_t>(encoding.pixel_bytes());
    for (std::size_t i = 0; i < hdu.axes.size(); ++i) {
        const int axis = static_cast<int>(i) + 1;
        const auto found = std::find(axes.axis.begin(), axes.axis.end(), axis);
        if (found != axes.axis.end()) {
            byte_steps_[static_cast<std::size_t>(found - axes.axis.begin())] = step;
        } else if (axis == axes.plane_axis) {
            first_ += axes.plane * step;
        }
        step *= hdu.axes[i];
    }
}

base::Status PlainPixels::read(const Bytes& bytes, const volume::Box& box, std::span<float> out,
                               const std::string& operation, const std::stop_token& stop) const {
    const std::size_t pixel_bytes = encoding_.pixel_bytes();
    const Runs runs(box, first_, byte_steps_, static_cast<std::int64_t>(pixel_bytes));
    const auto room = static_cast<std::size_t>(runs.longest_group());
    const auto piece = std::make_unique_for_overwrite<char[]>(room);
    for (std::int64_t run = 0; run < runs.count();) {
        if (stop.stop_requested()) {
            return base::error(base::Code::cancelled, operation, "stopped");
        }
        const std::int64_t next = runs.end_of_group(run);
        const std::int64_t start = runs.begin(run);
        if (!bytes.read(start, {piece.get(), static_cast<std::size_t>(runs.end(next - 1) - start)})) {
            return base::error(base::Code::io, operation, "the file has become shorter or cannot be read");
        }
        for (; run < next; ++run) {
            char* const first = piece.get() + (runs.begin(run) - start);
            const auto pixels = static_cast<std::size_t>(runs.pixels(run));
            if (byte_steps_[0] != static_cast<std::int64_t>(pixel_bytes)) {
                close_up(first, runs.pixels(run), byte_steps_[0], pixel_bytes);
            }
            decode(encoding_, {first, pixels * pixel_bytes}, out.first(pixels));
            out = out.subspan(pixels);
        }
    }
    return {};
}

}  // namespace shearwater::fits
