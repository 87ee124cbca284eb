#pragma once
// Voxels that come down the tree, for a renderer that cannot see the cube's file.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>

#include "common/volume/source.h"
#include "protocol/wire/message.h"

namespace shearwater::jobs {

class LinkSource final : public volume::VoxelSource {
  public:
    // `ask` is called from read() with the box wanted; the answer comes through deliver(), from another
    // thread. A read gives up when `stop` is requested.
    LinkSource(std::function<void(const volume::Box&)> ask, std::stop_token stop)
        : ask_(std::move(ask)), stop_(std::move(stop)) {}

    base::Status read(const volume::Box& box, std::span<float> out) override;
    void deliver(wire::Message voxels);

  private:
    std::function<void(const volume::Box&)> ask_;
    std::stop_token stop_;
    std::mutex mutex_;
    std::condition_variable_any arrived_;
    std::optional<wire::Message> answer_;
};

}  // namespace shearwater::jobs
