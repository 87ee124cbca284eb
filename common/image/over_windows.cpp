#include "common/image/over_windows.h"

#include <algorithm>
#include <limits>

#include "common/image/over.h"

namespace shearwater::image {

namespace {

// The windows of one face, front to back.
template <class AnyWindow>
struct Layers {
    int face;
    Rect rect;  // that holds them all
    std::vector<const AnyWindow*> windows;
};

template <class AnyWindow>
std::vector<Layers<AnyWindow>> by_face(std::span<const AnyWindow> windows) {
    std::vector<Layers<AnyWindow>> faces;
    for (const AnyWindow& window : windows) {
        if (window.rect.empty()) {
            continue;
        }
        auto found = std::ranges::find(faces, window.face, &Layers<AnyWindow>::face);
        if (found == faces.end()) {
            faces.push_back({.face = window.face, .rect = {}, .windows = {}});
            found = faces.end() - 1;
        }
        found->rect = bounding(found->rect, window.rect);
        found->windows.push_back(&window);
    }
    return faces;
}

// Goes through a face's windows row by row, all at once.
class Rows {
  public:
    explicit Rows(const Layers<SpanWindow>& layers) {
        for (const SpanWindow* window : layers.windows) {
            windows_.push_back({window->rect.y0, window->rect.y1, window->bytes.data()});
        }
    }

    // The windows that have something in row y, front to back; to be asked for each row once, from the top.
    struct Row {
        std::span<const std::byte> bytes;
        SpanReader spans;
    };
    std::vector<Row>& at(int y) {
        rows_.clear();
        for (Place& window : windows_) {
            if (window.y0 <= y && y < window.y1) {
                const std::byte* const begin = window.row;
                window.row = after_row(begin);
                const SpanReader spans(begin);
                if (!spans.done()) {
                    rows_.push_back({{begin, window.row}, spans});
                }
            }
        }
        return rows_;
    }

  private:
    struct Place {
        int y0, y1;
        const std::byte* row;
    };
    std::vector<Place> windows_;
    std::vector<Row> rows_;
};

// Cuts a row where a window's span begins or ends. `use` is given each stretch that has something: its x, its
// length, and the pixels of the windows there, front to back.
class Sweep {
  public:
    template <class Use>
    void operator()(std::vector<Rows::Row>& rows, const Use& use) {
        while (true) {
            std::erase_if(rows, [](const Rows::Row& row) { return row.spans.done(); });
            if (rows.empty()) {
                return;
            }
            const auto first = [](const Rows::Row& row) { return row.spans.x(); };
            const int x = first(std::ranges::min(rows, {}, first));
            int end = std::numeric_limits<int>::max();
            covering_.clear();
            for (const Rows::Row& row : rows) {
                if (row.spans.x() == x) {
                    covering_.push_back(row.spans.pixels());
                }
                end = std::min(end, row.spans.x() == x ? row.spans.end() : row.spans.x());
            }
            use(x, end - x, std::span<const Rgba16* const>(covering_));
            for (Rows::Row& row : rows) {
                if (row.spans.x() == x) {
                    row.spans.skip_to(end);
                }
            }
        }
    }

  private:
    std::vector<const Rgba16*> covering_;
};

// Pixels front to back into one stretch.
void lay(std::span<const Rgba16* const> parts, std::span<RgbaF> to) {
    from_16_bits({parts.front(), to.size()}, to);
    for (const Rgba16* behind : parts.subspan(1)) {
        over(to, std::span(behind, to.size()));
    }
}

// Into a part of a window that holds the layers' rectangle.
void lay_face(const Layers<SpanWindow>& layers, const Rect& part, Window& onto) {
    Rows rows(layers);
    Sweep sweep;
    for (int y = part.y0; y < part.y1; ++y) {
        const std::span<RgbaF> to = onto.pixels.row(y - onto.rect.y0)
                                        .subspan(static_cast<std::size_t>(part.x0 - onto.rect.x0),
                                                 static_cast<std::size_t>(part.width()));
        std::ranges::fill(to, RgbaF{});
        sweep(rows.at(y), [&](int x, int length, std::span<const Rgba16* const> parts) {
            lay(parts, to.subspan(static_cast<std::size_t>(x - part.x0), static_cast<std::size_t>(length)));
        });
    }
}

Window merge_face(const Layers<SpanWindow>& layers) {
    const Rect& rect = layers.rect;
    Window merged{
        .face = layers.face, .rect = rect, .pixels = Image<RgbaF>(rect.width(), rect.height(), Unfilled())};
    lay_face(layers, rect, merged);
    return merged;
}

Window merge_face(const Layers<Window>& layers) {
    const Rect& rect = layers.rect;
    Window merged{.face = layers.face, .rect = rect, .pixels = Image<RgbaF>(rect.width(), rect.height())};
    for (const Window* behind : layers.windows) {
        const auto x = static_cast<std::size_t>(behind->rect.x0 - rect.x0);
        const auto width = static_cast<std::size_t>(behind->rect.width());
        for (int y = 0; y < behind->rect.height(); ++y) {
            over(merged.pixels.row(y + behind->rect.y0 - rect.y0).subspan(x, width), behind->pixels.row(y));
        }
    }
    return merged;
}

template <class AnyWindow>
std::vector<Window> merge(std::span<const AnyWindow> windows) {
    std::vector<Window> merged;
    for (const Layers<AnyWindow>& layers : by_face(windows)) {
        merged.push_back(merge_face(layers));
    }
    return merged;
}

void merge_coded_face(const Layers<SpanWindow>& layers, SpanWriter& writer) {
    Rows rows(layers);
    Sweep sweep;
    std::vector<RgbaF> sum(static_cast<std::size_t>(layers.rect.width()));
    for (int y = layers.rect.y0; y < layers.rect.y1; ++y) {
        std::vector<Rows::Row>& row = rows.at(y);
        if (row.size() == 1) {
            writer.copy_row(row.front().bytes);
            continue;
        }
        writer.begin_row();
        sweep(row, [&](int x, int length, std::span<const Rgba16* const> parts) {
            const std::span<Rgba16> to = writer.put(x, length);
            if (parts.size() == 1) {
                std::copy_n(parts.front(), length, to.begin());
            } else {
                const auto pixels = std::span(sum).first(to.size());
                lay(parts, pixels);
                to_16_bits(pixels, to);
            }
        });
    }
}

}  // namespace

std::vector<Window> merge_front_to_back(std::span<const Window> windows) {
    return merge(windows);
}

std::vector<Window> merge_front_to_back(std::span<const SpanWindow> windows) {
    return merge(windows);
}

void lay_front_to_back(std::span<const SpanWindow> windows, const Rect& part, Window& onto) {
    base::check(intersection(part, onto.rect) == part, "a part lies in its window");
    const auto faces = by_face(windows);
    if (faces.empty()) {
        lay_face({.face = onto.face, .rect = {}, .windows = {}}, part, onto);
        return;
    }
    const Layers<SpanWindow>& layers = faces.front();
    base::check(
        faces.size() == 1 && layers.face == onto.face && intersection(layers.rect, part) == layers.rect,
        "windows lie in the part that they are laid into");
    lay_face(layers, part, onto);
}

CodedWindows merge_coded(std::span<const SpanWindow> windows) {
    const auto faces = by_face(windows);
    std::size_t bound = 0;
    for (const auto& layers : faces) {
        bound += spans_bound(layers.rect);
    }
    CodedWindows merged{.windows = {}, .bytes = base::Buffer(bound)};
    std::size_t used = 0;
    for (const auto& layers : faces) {
        const auto room = std::span(merged.bytes).subspan(used);
        SpanWriter writer(room);
        merge_coded_face(layers, writer);
        merged.windows.push_back(
            {.face = layers.face, .rect = layers.rect, .bytes = room.first(writer.written())});
        used += writer.written();
    }
    merged.bytes.resize(used);
    return merged;
}

CodedWindows encode(std::span<const Window> windows) {
    std::size_t bound = 0;
    for (const Window& window : windows) {
        bound += spans_bound(window.rect);
    }
    CodedWindows coded{.windows = {}, .bytes = base::Buffer(bound)};
    std::size_t used = 0;
    for (const Window& window : windows) {
        const SpanWindow spans = encode_spans(window, std::span(coded.bytes).subspan(used));
        if (!spans.rect.empty()) {
            coded.windows.push_back(spans);
            used += spans.bytes.size();
        }
    }
    coded.bytes.resize(used);
    return coded;
}

}  // namespace shearwater::image
