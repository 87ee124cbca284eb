#pragma once
// A fixed set of threads that share the indices of one loop at a time.

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace shearwater::base {

// Lets the calling thread go on beside others that want the processor, in what time they leave.
void run_in_background();

class Workers {
  public:
    // Background: so run the threads, but the caller's own.
    enum class Priority { normal, background };

    // `threads` counts the caller's own: Workers(1) starts none. 0 means one per processor.
    explicit Workers(int threads = 0, Priority priority = Priority::normal);
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    int threads() const { return static_cast<int>(threads_.size()) + 1; }

    // Calls body(i) once for each i in [0, count), on this thread and the others, handing out indices
    // in order. Returns when all are done. After `stop` is requested no further index is begun; returns
    // whether every index was. One loop at a time; body must not throw, nor start a loop here.
    bool for_each(std::int64_t count, const std::function<void(std::int64_t)>& body,
                  const std::stop_token& stop = {});

  private:
    struct Loop;
    void work();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::condition_variable idle_;
    Loop* loop_ = nullptr;
    std::uint64_t generation_ = 0;
    int busy_ = 0;
    bool ending_ = false;
    std::mutex one_loop_;
    std::vector<std::jthread> threads_;
};

}  // namespace shearwater::base
