#include "common/image/window_spans.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "common/image/over.h"

namespace shearwater::image {

namespace {

// Pixels are read and written in place.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Rgba16) == 8 && alignof(Rgba16) == 2);

constexpr std::size_t row_head = 2;
constexpr std::size_t span_head = 4;

int load(const std::byte* from) {
    std::uint16_t value = 0;
    std::memcpy(&value, from, sizeof value);
    return value;
}

// Below this a channel is rounded to nothing.
constexpr float least = 0.5F / 65535;

bool seen(const RgbaF& pixel) {
    return std::max(std::max(pixel.r, pixel.g), std::max(pixel.b, pixel.a)) >= least;
}

// So many pixels are looked at together; a gap between spans is at least as wide.
constexpr std::size_t block = 8;
static_assert(LitBlocks::block % block == 0);

bool any_seen(std::span<const RgbaF> pixels) {
    std::uint64_t bits = 0;  // most blocks have none, and that is told soonest
    for (const RgbaF& pixel : pixels) {
        const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(pixel);
        bits |= halves[0] | halves[1];
    }
    return bits != 0 && std::ranges::any_of(pixels, seen);
}

std::span<const RgbaF> block_at(std::span<const RgbaF> row, std::size_t at) {
    return row.subspan(at, std::min(block, row.size() - at));
}

// The next stretch of a row from `from` on, which begins a block; empty at the row's end.
struct Stretch16 {
    std::size_t begin, end, next_block;
};
template <class SeenAt>
Stretch16 next_stretch(std::span<const RgbaF> row, std::size_t from, const SeenAt& any_seen_at) {
    while (from < row.size() && !any_seen_at(from)) {
        from += block;
    }
    std::size_t to = from;
    while (to < row.size() && any_seen_at(to)) {
        to += block;
    }
    Stretch16 stretch{from, std::min(to, row.size()), to};
    while (stretch.begin < stretch.end && !seen(row[stretch.begin])) {
        ++stretch.begin;
    }
    while (stretch.begin < stretch.end && !seen(row[stretch.end - 1])) {
        --stretch.end;
    }
    return stretch;
}

void encode_row(const Window& window, int y, SpanWriter& writer) {
    const auto row = window.pixels.row(y);
    const int x0 = window.rect.x0;
    const auto any_seen_at = [&](std::size_t at) {
        return (window.lit.empty() || window.lit.is_lit(static_cast<int>(at), y)) &&
               any_seen(block_at(row, at));
    };
    writer.begin_row();
    for (std::size_t from = 0; from < row.size();) {
        const Stretch16 stretch = next_stretch(row, from, any_seen_at);
        if (stretch.begin < stretch.end) {
            const auto pixels = row.subspan(stretch.begin, stretch.end - stretch.begin);
            to_16_bits(pixels,
                       writer.put(x0 + static_cast<int>(stretch.begin), static_cast<int>(pixels.size())));
        }
        from = stretch.next_block;
    }
}

}  // namespace

// A span beyond the first of its row costs less than the pixel that it leaves out.
std::size_t spans_bound(const Rect& rect) {
    return rect.empty() ? 0
                        : static_cast<std::size_t>(rect.area()) * sizeof(Rgba16) +
                              static_cast<std::size_t>(rect.height()) * (row_head + span_head);
}

SpanWindow encode_spans(const Window& window, std::span<std::byte> out) {
    const Rect& rect = window.rect;
    Rect full;
    SpanWriter writer(out);
    std::size_t end = 0;  // of the last row that has something
    for (int y = rect.y0; y < rect.y1; ++y) {
        encode_row(window, y - rect.y0, writer);
        if (!writer.row_empty()) {
            full = bounding(full, {writer.row_first(), y, writer.row_last(), y + 1});
            end = writer.written();
        } else if (full.empty()) {
            writer.cut(0);
        }
    }
    return {.face = window.face, .rect = full, .bytes = out.first(end)};
}

base::Result<std::size_t> check_spans(std::span<const std::byte> bytes, const Rect& rect) {
    const auto fault = [](const char* what) {
        return base::error(base::Code::corrupt, "read a window's spans", what);
    };
    std::size_t at = 0;
    for (int y = rect.y0; y < rect.y1; ++y) {
        if (bytes.size() - at < row_head) {
            return fault("they are cut off");
        }
        int from = rect.x0;  // the least that the next span's x may be
        int spans = load(bytes.data() + at);
        at += row_head;
        for (; spans > 0; --spans) {
            if (bytes.size() - at < span_head) {
                return fault("they are cut off");
            }
            const int x = load(bytes.data() + at);
            const int length = load(bytes.data() + at + 2);
            at += span_head;
            if (x < from || length == 0 || length > rect.x1 - x) {
                return fault("one leaves its row or its place in it");
            }
            const std::size_t size = static_cast<std::size_t>(length) * sizeof(Rgba16);
            if (bytes.size() - at < size) {
                return fault("they are cut off");
            }
            at += size;
            from = x + length + 1;
        }
    }
    return at;
}

SpanReader::SpanReader(const std::byte* row) : left_(load(row)), next_(row + row_head) {
    next();
}

void SpanReader::next() {
    if (--left_ >= 0) {
        x_ = load(next_);
        length_ = load(next_ + 2);
        pixels_ = reinterpret_cast<const Rgba16*>(next_ + span_head);
        next_ += span_head + static_cast<std::size_t>(length_) * sizeof(Rgba16);
    }
}

void SpanReader::skip_to(int to) {
    if (to == end()) {
        next();
    } else {
        pixels_ += to - x_;
        length_ -= to - x_;
        x_ = to;
    }
}

const std::byte* after_row(const std::byte* row) {
    int spans = load(row);
    row += row_head;
    for (; spans > 0; --spans) {
        row += span_head + static_cast<std::size_t>(load(row + 2)) * sizeof(Rgba16);
    }
    return row;
}

void SpanWriter::store(std::size_t at, int value) {
    const auto number = static_cast<std::uint16_t>(value);
    std::memcpy(out_.data() + at, &number, sizeof number);
}

void SpanWriter::begin_row() {
    base::check(out_.size() - at_ >= row_head, "a row has room");
    row_ = at_;
    spans_ = 0;
    store(row_, 0);
    at_ += row_head;
}

std::span<Rgba16> SpanWriter::put(int x, int length) {
    const bool goes_on = spans_ > 0 && end_ == x;
    const std::size_t size = static_cast<std::size_t>(length) * sizeof(Rgba16);
    base::check(out_.size() - at_ >= size + (goes_on ? 0 : span_head), "a span has room");
    if (!goes_on) {
        first_ = spans_ == 0 ? x : first_;
        store(row_, ++spans_);
        store(at_, x);
        length_ = at_ + 2;
        store(length_, 0);
        at_ += span_head;
    }
    store(length_, load(out_.data() + length_) + length);
    end_ = x + length;
    Rgba16* const to = reinterpret_cast<Rgba16*>(out_.data() + at_);
    at_ += size;
    return {to, static_cast<std::size_t>(length)};
}

void SpanWriter::copy_row(std::span<const std::byte> row) {
    base::check(out_.size() - at_ >= row.size(), "a row has room");
    std::memcpy(out_.data() + at_, row.data(), row.size());
    at_ += row.size();
}

}  // namespace shearwater::image
