#pragma once
// Carries out a leaf's jobs: counting, loading and drawing, one after the other on a thread of their own
// that shares its loops with the workers.

#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>

#include "common/base/workers.h"
#include "common/volume/source.h"
#include "renderer/jobs/link_source.h"
#include "renderer/leaf/leaf.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"

namespace shearwater::jobs {

class Jobs {
  public:
    // `tell` is called from the threads that compute, one at a time, and must only pass the event on.
    Jobs(int threads, std::function<void(leaf::JobEvent)> tell);
    ~Jobs();  // stops what runs
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    void perform(leaf::Effect effect);

  private:
    using Source = std::shared_ptr<volume::VoxelSource>;

    std::stop_token begin(leaf::Job job);
    void end(leaf::Job job);
    void count(const leaf::Count& count, const std::stop_token& stop);
    void load(const leaf::Load& load, const std::stop_token& stop);
    void draw(const leaf::Draw& draw, const std::stop_token& stop);
    base::Result<Source> open(leaf::Job job, const leaf::Share& share, const std::stop_token& stop);
    void tell_memory();

    std::function<void(leaf::JobEvent)> tell_;
    base::Workers workers_;
    // Touched by the jobs' thread only.
    std::optional<shear::BrickVolume> volume_;
    shear::Classifier classifier_;  // of the volume
    std::chrono::steady_clock::time_point memory_told_;
    std::mutex mutex_;
    std::map<leaf::Job, std::stop_source> running_;
    std::map<leaf::Job, std::shared_ptr<LinkSource>> link_sources_;
    boost::asio::thread_pool thread_{1};
};

}  // namespace shearwater::jobs
