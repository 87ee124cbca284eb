#pragma once
// A renderer of a real tree inside the test, with the daemon's own state machine, jobs and links, that does
// not load its voxels until the test lets it.

#include <boost/asio/io_context.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "protocol/link/hub.h"
#include "renderer/jobs/jobs.h"
#include "renderer/leaf/leaf.h"

namespace shearwater::support {

class HeldRenderer {
  public:
    HeldRenderer(const wire::Address& server, const link::Secret& secret, const std::string& node_name);
    ~HeldRenderer();
    HeldRenderer(const HeldRenderer&) = delete;
    HeldRenderer& operator=(const HeldRenderer&) = delete;

    void let_load();

  private:
    void perform(leaf::Effects effects);

    // All but the jobs belong to the thread that runs io_.
    boost::asio::io_context io_;
    std::optional<link::Hub> hub_;
    leaf::Leaf leaf_;
    std::optional<jobs::Jobs> jobs_;
    bool held_ = true;
    std::vector<leaf::Effect> waiting_;
    std::jthread thread_;
};

}  // namespace shearwater::support
