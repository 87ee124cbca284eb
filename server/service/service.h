#pragma once
// Carries out the head's jobs: finishing frames on one thread that shares its loops with the workers, and
// reading voxels for renderers that cannot see the file on another.

#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <map>
#include <memory>

#include "common/base/workers.h"
#include "common/image/canvas.h"
#include "common/volume/source.h"
#include "server/head/head.h"

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
    image::Canvas& lay(node::MergeJob& merge);
    void done_with(std::uint64_t frame);
    void finish(head::Finish& job);
    void read_voxels(const head::ReadVoxels& job);

    std::unique_ptr<volume::VoxelSource> cube_;  // touched by the reading thread only
    std::function<void(head::JobEvent)> tell_;
    base::Workers workers_;
    // Touched by the frames' thread only.
    std::map<std::uint64_t, image::Canvas> canvases_;  // by frame
    image::Canvas spare_;                              // for the memory it has
    boost::asio::thread_pool frames_{1};
    boost::asio::thread_pool reading_{1};
};

}  // namespace shearwater::service
