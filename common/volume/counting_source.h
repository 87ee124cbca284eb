#pragma once
// Counts values on their way to whoever reads them: a histogram without a pass of its own.

#include <memory>
#include <mutex>
#include <semaphore>
#include <vector>

#include "common/volume/histogram.h"
#include "common/volume/source.h"

namespace shearwater::volume {

// Of the voxels that `box` owns in a cube of whole(n) (owned_planes), as count_values() gives them, once each
// of these has been read once.
class CountingSource final : public VoxelSource {
  public:
    CountingSource(VoxelSource& source, const Box& box, const Index3& n);

    base::Status read(const Box& box, std::span<float> out) override;
    bool concurrent() const override { return source_.concurrent(); }
    bool gives_rows() const override { return source_.gives_rows(); }

    // When nobody reads any more.
    Histogram histogram() const;

  private:
    // A histogram is 8 MB, so that many threads share a few; counting is far faster than reading.
    static constexpr int most_histograms = 8;

    std::unique_ptr<Histogram> take();
    void give_back(std::unique_ptr<Histogram> part);

    VoxelSource& source_;
    Box owned_;
    std::counting_semaphore<most_histograms> free_{most_histograms};
    std::mutex mutex_;
    std::vector<std::unique_ptr<Histogram>> idle_;
};

}  // namespace shearwater::volume
