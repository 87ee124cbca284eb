// The parts of the benchmarks: what is drawn, from where, and what is said of times.

#include <gmock/gmock.h>

#include <cmath>

#include "deploy/bench/in_process.h"
#include "deploy/bench/machine.h"
#include "deploy/bench/paper.h"
#include "deploy/bench/timing.h"
#include "deploy/bench/workload.h"

namespace shearwater::bench {
namespace {

using testing::HasSubstr;

TEST(Workload, OpacitiesAreThoseThatOtherRenderersAreGiven) {
    const view::TransferFunction w1 = workload("W1").tf;
    const view::TransferFunction w2 = workload("W2").tf;
    const view::TransferFunction w3 = workload("W3").tf;
    for (int value = 0; value <= 255; ++value) {
        const double s = value / 255.0;
        const double along = value <= 80 ? 0 : (value - 80) / 175.0;
        EXPECT_DOUBLE_EQ(w1.opacity(s), 0.001);
        EXPECT_NEAR(w2.opacity(s), 0.3 * along, 1e-12) << value;
        EXPECT_NEAR(w3.opacity(s), 0.05 + 0.25 * along, 1e-12) << value;
    }
    EXPECT_EQ(w1.colour(0.3), (view::Rgb{1, 1, 1}));
    EXPECT_NEAR(w2.colour(80 / 255.0).g, 0.4, 1e-12);
    EXPECT_NEAR(w3.colour(150 / 255.0).r, 1, 1e-12);
    for (const std::string& name : workload_names()) {
        EXPECT_TRUE(view::validate(workload(name).tf)) << name;
    }
}

TEST(Workload, ThePathBeginsWhereOtherRenderersBegin) {
    const auto camera = first_view(100).camera({.n = {100, 100, 100}});
    ASSERT_TRUE(camera);
    const double degree = std::acos(-1) / 180;
    EXPECT_NEAR(camera->eye.x, 240 * std::cos(20 * degree) * std::sin(10 * degree), 1e-9);
    EXPECT_NEAR(camera->eye.y, 240 * std::sin(20 * degree), 1e-9);
    EXPECT_NEAR(camera->eye.z, 240 * std::cos(20 * degree) * std::cos(10 * degree), 1e-9);
    EXPECT_EQ(camera->fov, 30);
}

TEST(Workload, EveryFrameOfThePathMeetsTheWholeCube) {
    const Workload work = workload("W1");
    auto cube = InProcess::load(work.cube(24), 2, {});
    ASSERT_TRUE(cube);
    deploy::ViewOptions view = first_view(24);
    view.size = "48x48";
    const auto frames = cube->draw_path(view, 10, work.tf, [](double) {});
    ASSERT_TRUE(frames);
    ASSERT_EQ(frames->size(), 10U);
    for (const FrameTimes& frame : *frames) {
        EXPECT_GT(frame.samples, 48U * 48U * 24U / 2);
        EXPECT_GT(frame.render, 0);
    }
    EXPECT_NE((*frames)[0].samples, (*frames)[1].samples);  // the camera has turned
    const FrameSummary all = summary(*frames);
    EXPECT_LE(all.total.least, all.total.median);
    EXPECT_LE(all.total.median, all.total.most);
    EXPECT_GT(all.samples_per_second, 0);
}

TEST(Timing, TheMedianIsTheMiddle) {
    EXPECT_EQ(spread({3, 1, 2}).median, 2);
    EXPECT_EQ(spread({4, 1, 3, 2}).median, 2.5);
    EXPECT_EQ(spread({4, 1, 3, 2}).least, 1);
    EXPECT_EQ(spread({4, 1, 3, 2}).most, 4);
    EXPECT_EQ(spread({}).median, 0);
    int count = 0;
    measure(0, [&] { ++count; });
    EXPECT_EQ(count, 4);  // one that is not measured
    measure_times(5, [&] { ++count; });
    EXPECT_EQ(count, 9);
}

TEST(Paper, TablesAreReadByRowAndColumn) {
    EXPECT_EQ(paper::tree_seconds(64, 3), 0.20);
    EXPECT_EQ(paper::tree_seconds(256, 15), 0.81);
    EXPECT_EQ(paper::tree_seconds(1024, 31), 21);
    EXPECT_FALSE(paper::tree_seconds(100, 3));
    EXPECT_FALSE(paper::tree_seconds(64, 1));
    EXPECT_EQ(paper::image_seconds(256), 0.36);
    EXPECT_FALSE(paper::image_seconds(300));
}

TEST(Machine, IsKnown) {
    const Machine machine = this_machine();
    EXPECT_GT(machine.cores, 0);
    EXPECT_GT(machine.memory_bytes, 1U << 26U);
    EXPECT_NE(machine.simd, "");
    EXPECT_THAT(to_line(machine), HasSubstr(machine.cpu));
    EXPECT_TRUE(check_memory("load", 1 << 20));
    EXPECT_EQ(check_memory("load", std::uint64_t{1} << 60U).error().code, base::Code::too_large);
}

}  // namespace
}  // namespace shearwater::bench
