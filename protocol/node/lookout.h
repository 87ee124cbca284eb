#pragma once
// What a node knows of blocks' opacity, for those who carry out its jobs: puts renderers' functions together,
// and tells what rays may see. The head has its renderers' functions, of their blocks; those have the head's,
// of all.

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/workers.h"
#include "common/culling/merge.h"
#include "common/culling/visible_blocks.h"
#include "protocol/wire/convert_culling.h"

namespace shearwater::node {

// Some of the functions of a sub-volume's blocks have come.
struct Learn {
    culling::FunctionKey key;
    volume::Index3 n{};       // of the cube
    volume::Box box;          // of the sub-volume
    wire::FunctionPart part;  // sound; its codes are
    wire::Payload payload;    // this one's
};
struct Forget {
    culling::FunctionKey key;
};
// What do the rays of a picture's part see?
struct Look {
    std::uint64_t number;
    view::Factorisation factorisation;
    view::TransferFunction tf;
    culling::Settings settings;
    culling::ImagePart part = {};
};
struct Looked {
    std::uint64_t number;
    culling::VisibleBlocks visible;
};

class Lookout {
  public:
    // From one thread,
    void learn(const Learn& learn);
    void forget(const Forget& forget);
    // a piece of a whole table for others, as they are given it, if that is there;
    std::optional<wire::Message> give(std::uint64_t request, const culling::FunctionKey& key,
                                      std::uint64_t number, int first_direction);
    // and from another, which hardly ever waits for that.
    Looked look(const Look& look, base::Workers& workers);

  private:
    // What has come of a sub-volume's functions.
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

}  // namespace shearwater::node
