#include "common/volume/counting_source.h"

#include <algorithm>

namespace shearwater::volume {

CountingSource::CountingSource(VoxelSource& source, const Box& box, const Index3& n)
    : source_(source), owned_(owned_planes(box, n)) {}

base::Status CountingSource::read(const Box& box, std::span<float> out) {
    if (base::Status status = source_.read(box, out); !status) {
        return status;
    }
    Index3 lo{}, hi{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis] = std::max(box.lo[axis], owned_.lo[axis]);
        hi[axis] = std::min(box.hi[axis], owned_.hi[axis]);
    }
    if (lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]) {
        return {};
    }
    auto part = take();
    if (lo == box.lo && hi == box.hi) {
        part->add(out);
    } else {
        for (std::int64_t z = lo[2]; z <= hi[2]; ++z) {
            for (std::int64_t y = lo[1]; y <= hi[1]; ++y) {
                const std::int64_t row = (z - box.lo[2]) * box.planes(1) + (y - box.lo[1]);
                part->add(out.subspan(static_cast<std::size_t>(row * box.planes(0) + lo[0] - box.lo[0]),
                                      static_cast<std::size_t>(hi[0] - lo[0] + 1)));
            }
        }
    }
    give_back(std::move(part));
    return {};
}

Histogram CountingSource::histogram() const {
    Histogram sum;
    for (const auto& part : idle_) {
        sum.merge(*part);
    }
    return sum;
}

std::unique_ptr<Histogram> CountingSource::take() {
    free_.acquire();
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
        return std::make_unique<Histogram>();
    }
    auto part = std::move(idle_.back());
    idle_.pop_back();
    return part;
}

void CountingSource::give_back(std::unique_ptr<Histogram> part) {
    {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(part));
    }
    free_.release();
}

}  // namespace shearwater::volume
