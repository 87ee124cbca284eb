#include "deploy/bench/timing.h"

#include <algorithm>

namespace shearwater::bench {

double Clock::lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - last_;
    last_ = now;
    return passed.count();
}

Spread spread(std::vector<double> values) {
    if (values.empty()) {
        return {};
    }
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return {.median = values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2,
            .least = values.front(),
            .most = values.back()};
}

Spread measure(double seconds, const std::function<void()>& work) {
    work();
    std::vector<double> times;
    double spent = 0;
    constexpr std::size_t least_times = 3;
    Clock clock;
    while (times.size() < least_times || spent < seconds) {
        clock.lap();
        work();
        times.push_back(clock.lap());
        spent += times.back();
    }
    return spread(std::move(times));
}

Spread measure_times(int times, const std::function<void()>& work) {
    std::vector<double> each;
    Clock clock;
    for (int i = 0; i < times; ++i) {
        clock.lap();
        work();
        each.push_back(clock.lap());
    }
    return spread(std::move(each));
}

}  // namespace shearwater::bench
