#include "common/synthetic/normal.h"

#include <cmath>
#include <numbers>

namespace shearwater::synthetic {

double normal_quantile(double p) {
    // Newton's method for log(distribution(x)) = log(p), whose left side is concave: from the left it
    // never oversteps.
    double x = -std::sqrt(-2 * std::log(p));
    constexpr int enough = 12;
    for (int step = 0; step < enough; ++step) {
        const double below = 0.5 * std::erfc(-x / std::numbers::sqrt2);
        const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
        const double change = (std::log(p) - std::log(below)) * below / density;
        x += change;
        if (std::fabs(change) < 1e-9) {
            break;
        }
    }
    return x;
}

Normal::Normal() : edges_(cells + 1) {
    for (std::uint64_t i = 1; i <= cells / 2; ++i) {
        const double x = normal_quantile(static_cast<double>(i) / static_cast<double>(cells));
        edges_[i] = static_cast<float>(x);
        edges_[cells - i] = static_cast<float>(-x);
    }
}

float Normal::tail(std::uint64_t bits) {
    const bool upper = bits >> 63U != 0;
    const std::uint64_t from_end = (upper ? ~bits : bits) >> 11U;
    const double p = (static_cast<double>(from_end) + 0.5) * 0x1p-53;
    return static_cast<float>(upper ? -normal_quantile(p) : normal_quantile(p));
}

}  // namespace shearwater::synthetic
