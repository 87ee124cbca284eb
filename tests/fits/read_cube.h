#pragma once
// Opening and reading in one step, for tests.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/fits/cube.h"

namespace shearwater::fits {

inline std::vector<float> read_box(Cube& cube, const volume::Box& box) {
    std::vector<float> values(static_cast<std::size_t>(box.voxels()));
    const base::Status status = cube.read(box, values);
    EXPECT_TRUE(status) << (status ? "" : status.error().message());
    return values;
}

inline std::vector<float> read_whole(const std::string& path, const OpenOptions& options = {}) {
    auto cube = Cube::open(path, options);
    EXPECT_TRUE(cube) << (cube ? "" : cube.error().message());
    return cube ? read_box(*cube, volume::whole(cube->info().n)) : std::vector<float>();
}

// Equal, where blanks equal blanks.
inline void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_TRUE(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))
            << i << ": " << a[i] << " and " << b[i];
    }
}

inline base::Error open_error(const std::string& path, const OpenOptions& options = {}) {
    const auto cube = Cube::open(path, options);
    EXPECT_FALSE(cube) << path;
    return cube ? base::Error{} : cube.error();
}

}  // namespace shearwater::fits
