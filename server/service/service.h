#pragma once
// Carries out the head's jobs: finishing frames on one thread that shares its loops with the workers, looking
// what is visible on another, putting opacity functions together and giving them away on a third, and reading
// voxels for renderers that cannot see the file, and for picks, on a fourth.

#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <memory>

#include "common/base/workers.h"
#include "common/volume/source.h"
#include "protocol/node/lookout.h"
#include "server/head/head.h"
#include "server/head/pictures.h"

namespace shearwater::service {

class Service {
  public:
    // `tell` is called from the jobs' threads and must only pass the event on.
    Service(int threads, std::unique_ptr<volume::VoxelSource> cube, std::function<void(head::JobEvent)> tell);
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    void perform(head::Job job);

  private:
    void finish(const head::Finish& job);
    void read_voxels(const head::ReadVoxels& job);
    void measure(const head::Measure& job);

    std::unique_ptr<volume::VoxelSource> cube_;  // touched by the reading thread only
    std::function<void(head::JobEvent)> tell_;
    base::Workers workers_, lookers_;
    head::Pictures pictures_;  // touched by the frames' thread only
    node::Lookout lookout_;    // touched by the learning and the looking thread
    boost::asio::thread_pool frames_{1};
    boost::asio::thread_pool looking_{1};
    boost::asio::thread_pool learning_{1};  // in the background
    boost::asio::thread_pool reading_{1};
};

}  // namespace shearwater::service
