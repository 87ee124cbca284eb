#include "common/view/bands.h"

#include <algorithm>

namespace shearwater::view {

namespace {

int divided_up(std::int64_t number, std::int64_t by) {
    return static_cast<int>((number + by - 1) / by);
}

// Lines of a band where a face has `lines` of `length` pixels each.
int lines_of_a_band(int lines, int length) {
    constexpr int step = Band::line_step;
    const int wanted = (lines / Band::per_face + step / 2) / step;
    const int least = divided_up(std::max(Band::least_lines, divided_up(Band::least_pixels, length)), step);
    return std::max(wanted, least) * step;
}

}  // namespace

std::vector<Band> bands_of(const Factorisation& factorisation) {
    std::vector<Band> bands;
    for (int n = 0; n < static_cast<int>(factorisation.faces.size()); ++n) {
        const Face& face = factorisation.faces[static_cast<std::size_t>(n)];
        const bool columns = face.axis == 1;
        const int lines = columns ? face.width : face.height;
        const int length = columns ? face.height : face.width;
        const int step = lines_of_a_band(lines, length);
        for (int first = 0; first < lines; first += step) {
            const int end = std::min(first + step, lines);
            bands.push_back({n, columns ? Rect{first, 0, end, length} : Rect{0, first, length, end}});
        }
    }
    return bands;
}

}  // namespace shearwater::view
