#pragma once
// What simulated trees are of and are asked for.

#include <gtest/gtest.h>

#include <vector>

#include "protocol/wire/picture.h"
#include "tests/support/simulation.h"

namespace shearwater::support {

class Waves final : public volume::VoxelSource {
  public:
    explicit Waves(bool concurrent = false) : concurrent_(concurrent) {}
    bool concurrent() const override { return concurrent_; }
    base::Status read(const volume::Box& box, std::span<float> out) override {
        std::size_t i = 0;
        for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
            for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
                for (std::int64_t x = box.lo[0]; x <= box.hi[0]; ++x) {
                    out[i++] = static_cast<float>((x * 7 + y * 11 + z * 5) % 23);
                }
            }
        }
        return {};
    }

  private:
    bool concurrent_;
};

inline wire::View view_of(const volume::Index3& n,
                          const view::ImageSize& size = {.width = 24, .height = 20}) {
    wire::View view;
    view.camera = view::camera_on({}, {.n = n, .spacing = {1, 1, 1}});
    view.size = size;
    view.tf = view::default_transfer_function();
    return view;
}

inline image::Image<image::Rgba8> picture_of(const wire::Message& frame, const wire::View& view) {
    auto picture = wire::picture_from(frame, view.size);
    EXPECT_TRUE(picture);
    return *std::move(picture);
}

inline std::vector<tree::Place> all_daemons(const Simulation& simulation) {
    std::vector<tree::Place> places;
    for (std::size_t i = 1; i < simulation.plan().nodes.size(); ++i) {
        places.push_back(static_cast<tree::Place>(i));
    }
    return places;
}

}  // namespace shearwater::support
