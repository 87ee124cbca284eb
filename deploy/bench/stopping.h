#pragma once
// How soon work ends once it is told to.

#include <functional>
#include <stop_token>

#include "deploy/bench/timing.h"

namespace shearwater::bench {

// Does `work`, which takes about `seconds`, so many times, and tells it to stop at moments spread over them:
// the seconds from then until it has returned. 0 where it had before.
Spread time_to_stop(double seconds, int times, const std::function<void(const std::stop_token&)>& work);

}  // namespace shearwater::bench
