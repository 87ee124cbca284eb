#pragma once
// Seconds, and what is said of several of them.

#include <chrono>
#include <functional>
#include <vector>

namespace shearwater::bench {

class Clock {
  public:
    // Seconds since this was made, or last asked.
    double lap();

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct Spread {
    double median = 0, least = 0, most = 0;
};
Spread spread(std::vector<double> values);

// Does `work` once unmeasured, then over and over for about `seconds`, three times at the least.
Spread measure(double seconds, const std::function<void()>& work);
// So many times.
Spread measure_times(int times, const std::function<void()>& work);

}  // namespace shearwater::bench
