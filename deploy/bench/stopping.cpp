#include "deploy/bench/stopping.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace shearwater::bench {

Spread time_to_stop(double seconds, int times, const std::function<void(const std::stop_token&)>& work) {
    using Time = std::chrono::steady_clock::time_point;
    std::vector<double> each;
    for (int i = 0; i < times; ++i) {
        Time ended;
        std::stop_source stop;
        std::thread worker([&] {
            work(stop.get_token());
            ended = std::chrono::steady_clock::now();
        });
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds * (i + 0.5) / times));
        const Time asked = std::chrono::steady_clock::now();
        stop.request_stop();
        worker.join();
        each.push_back(std::max(0.0, std::chrono::duration<double>(ended - asked).count()));
    }
    return spread(std::move(each));
}

}  // namespace shearwater::bench
