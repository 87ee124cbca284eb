#pragma once
// What the head knows of blocks' opacity, for the service that carries out its jobs as for a simulation of
// it: puts renderers' functions together, and tells what a frame's rays may see.

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/workers.h"
#include "common/culling/merge.h"
#include "server/head/head.h"

namespace shearwater::head {

class Lookout {
  public:
    // From one thread,
    void learn(const Learn& learn);
    void forget(const Forget& forget);
    // and from another, which hardly ever waits for that.
    Looked look(const Look& look, base::Workers& workers);

  private:
    // What has come of a renderer's functions.
    struct Incoming {
        culling::FunctionTable table;
        int directions = 0;
    };
    struct Known {
        culling::FunctionKey key;
        std::map<int, Incoming> coarse, fine;  // by place, while they come
        std::map<int, culling::SubVolume> parts;
    };

    Known& known(const culling::FunctionKey& key);

    std::vector<Known> known_;
    std::mutex mutex_;  // of the store
    std::optional<culling::FunctionStore> store_;
};

}  // namespace shearwater::head
