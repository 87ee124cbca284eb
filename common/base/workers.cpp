#include "common/base/workers.h"

#include <sched.h>

#include <algorithm>
#include <atomic>

namespace shearwater::base {

struct Workers::Loop {
    std::int64_t count;
    const std::function<void(std::int64_t)>& body;
    const std::stop_token& stop;
    std::atomic<std::int64_t> next{0};

    void run() {
        while (!stop.stop_requested()) {
            const std::int64_t i = next.fetch_add(1, std::memory_order_relaxed);
            if (i >= count) {
                return;
            }
            body(i);
        }
    }
};

void run_in_background() {
    // Of this thread, 0. Only advice: where it is not taken, the thread competes.
    const sched_param none{};
    static_cast<void>(sched_setscheduler(0, SCHED_IDLE, &none));
}

Workers::Workers(int threads, Priority priority) {
    if (threads <= 0) {
        threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    }
    for (int i = 1; i < threads; ++i) {
        threads_.emplace_back([this, priority] {
            if (priority == Priority::background) {
                run_in_background();
            }
            work();
        });
    }
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    wake_.notify_all();
}

bool Workers::for_each(std::int64_t count, const std::function<void(std::int64_t)>& body,
                       const std::stop_token& stop) {
    const std::lock_guard one(one_loop_);
    Loop loop{.count = count, .body = body, .stop = stop};
    if (count <= 1) {  // not worth waking anyone
        loop.run();
        return loop.next.load() >= count;
    }
    {
        const std::lock_guard lock(mutex_);
        loop_ = &loop;
        ++generation_;
    }
    wake_.notify_all();
    loop.run();
    std::unique_lock lock(mutex_);
    loop_ = nullptr;
    idle_.wait(lock, [this] { return busy_ == 0; });
    return loop.next.load() >= count;
}

void Workers::work() {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [&] { return ending_ || (loop_ != nullptr && generation_ != seen); });
        if (ending_) {
            return;
        }
        seen = generation_;
        Loop* const loop = loop_;
        ++busy_;
        lock.unlock();
        loop->run();
        lock.lock();
        --busy_;
        if (busy_ == 0) {
            idle_.notify_all();
        }
    }
}

}  // namespace shearwater::base
