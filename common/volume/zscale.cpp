#include "common/volume/zscale.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"

namespace shearwater::volume {

namespace {

struct Line {
    double middle = 0;  // its value there
    double slope = 0;   // a sample
};

// Least squares over the samples kept; numbers count from the middle one.
Line fit(const std::vector<double>& values, const std::vector<bool>& kept) {
    const double middle = static_cast<double>(values.size() - 1) / 2;
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (kept[i]) {
            const double at = static_cast<double>(i) - middle;
            n += 1;
            x += at;
            y += values[i];
            xx += at * at;
            xy += at * values[i];
        }
    }
    const double spread = n * xx - x * x;
    const double slope = spread > 0 ? (n * xy - x * y) / spread : 0;
    return {(y - slope * x) / n, slope};
}

}  // namespace

Limits zscale_limits(const Summary& summary, double contrast) {
    base::check(!summary.empty() && contrast > 0, "there are values");
    constexpr std::size_t samples = 1000;
    constexpr int most_steps = 5;
    constexpr double far = 2.5;           // standard deviations from the line
    constexpr std::ptrdiff_t grown = 10;  // samples beside one far off that are left out with it
    std::vector<double> values(samples);
    for (std::size_t i = 0; i < samples; ++i) {
        values[i] = summary.value_at((static_cast<double>(i) + 0.5) / samples);
    }
    const double middle = static_cast<double>(samples - 1) / 2;
    std::vector<bool> kept(samples, true);
    auto left = static_cast<std::ptrdiff_t>(samples);
    Line line = fit(values, kept);
    for (int step = 0; step < most_steps; ++step) {
        const auto off = [&](std::size_t i) {
            return values[i] - (line.middle + line.slope * (static_cast<double>(i) - middle));
        };
        double squares = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            squares += kept[i] ? off(i) * off(i) : 0;
        }
        const double limit = far * std::sqrt(squares / static_cast<double>(left));
        std::vector<bool> next(samples, true);
        for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(samples); ++i) {
            if (std::abs(off(static_cast<std::size_t>(i))) > limit) {
                const auto from = std::max<std::ptrdiff_t>(i - grown / 2, 0);
                const auto to = std::min<std::ptrdiff_t>(i + grown / 2 + 1, samples);
                std::fill(next.begin() + from, next.begin() + to, false);
            }
        }
        const auto still = std::count(next.begin(), next.end(), true);
        if (still < static_cast<std::ptrdiff_t>(samples) / 2) {
            return {summary.min, summary.max};
        }
        if (still >= left) {
            break;
        }
        kept = std::move(next);
        left = still;
        line = fit(values, kept);
    }
    const double slope = line.slope / contrast;
    return {std::max(summary.min, summary.median - slope * middle),
            std::min(summary.max, summary.median + slope * middle)};
}

}  // namespace shearwater::volume
