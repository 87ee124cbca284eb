#pragma once
// A cube of 2048^3 voxels that has opacity functions, made up, and nothing else.

#include <array>
#include <memory>
#include <string>

#include "common/base/result.h"
#include "common/base/workers.h"
#include "common/culling/function_store.h"
#include "deploy/view_options.h"

namespace shearwater::bench {

// How dense blocks are, and by how many bases.
struct MadeUp {
    const char* name;
    int codes;  // at random below this
    int bases;
};
// As dense as they come, and so thin that every ray goes through.
inline constexpr std::array made_up{MadeUp{"dense", 256, 1}, MadeUp{"thin", 64, 1}, MadeUp{"of two", 64, 2}};

class ManyBlocks {
  public:
    // Whether this machine has room for one.
    static base::Status check_memory();
    static std::string title();

    // Seen in pictures of a size and quality.
    ManyBlocks(const MadeUp& codes, const deploy::ViewOptions& seen);

    std::size_t size() const { return grid_.size(); }
    // So many steps along the benchmarks' path.
    view::Factorisation factorisation(int step, bool parallel) const;
    culling::BlockSet visible(const view::Factorisation& factorisation, double threshold,
                              base::Workers& workers, const culling::ImagePart& part = {});

  private:
    static constexpr std::int64_t edge = 2048;

    view::Lattice lattice_{.n = {edge, edge, edge}, .spacing = {1, 1, 1}};
    culling::BlockGrid grid_{lattice_.n};
    culling::FunctionStore store_;
    view::TransferFunction tf_;
    deploy::ViewOptions seen_;
};

}  // namespace shearwater::bench
