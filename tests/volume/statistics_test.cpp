#include "common/volume/statistics.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

namespace shearwater::volume {
namespace {

// A cube whose every voxel has a value of its own, a few of them blank.
class Formula final : public VoxelSource {
  public:
    explicit Formula(const Index3& n, bool concurrent = false) : n_(n), concurrent_(concurrent) {}

    bool concurrent() const override { return concurrent_; }

    base::Status read(const Box& box, std::span<float> out) override {
        EXPECT_TRUE(whole(n_).contains(box));
        EXPECT_EQ(static_cast<std::int64_t>(out.size()), box.voxels());
        if (++reads_ == stop_at_) {
            stop_.request_stop();
        }
        if (reads_left_ >= 0 && reads_left_-- == 0) {
            return base::error(base::Code::io, "read a formula", "no more");
        }
        EXPECT_TRUE(concurrent_ || reading_++ == 0);
        std::size_t largest = largest_;
        while (largest < out.size() && !largest_.compare_exchange_weak(largest, out.size())) {
        }
        std::size_t i = 0;
        for (std::int64_t z = box.lo[2]; z <= box.hi[2]; ++z) {
            for (std::int64_t y = box.lo[1]; y <= box.hi[1]; ++y) {
                for (std::int64_t x = box.lo[0]; x <= box.hi[0]; ++x) {
                    const std::int64_t number = x + n_[0] * (y + n_[1] * z);
                    out[i++] = number % 17 == 3 ? std::nanf("") : static_cast<float>(number - 100);
                }
            }
        }
        reading_ = 0;
        return {};
    }

    void fail_after(int reads) { reads_left_ = reads; }
    void stop_at(int reads, const std::stop_source& stop) {
        stop_at_ = reads;
        stop_ = stop;
    }
    int reads() const { return reads_; }
    std::size_t largest() const { return largest_; }

  private:
    Index3 n_;
    bool concurrent_;
    std::atomic<int> reading_{0};
    int stop_at_ = -1;
    std::stop_source stop_;
    std::atomic<int> reads_{0};
    std::atomic<int> reads_left_{-1};
    std::atomic<std::size_t> largest_{0};
};

Histogram counted(Formula& source, const Box& box, const Index3& n, std::size_t slab_bytes = 1 << 20) {
    base::Workers workers(3);
    auto result = count_values(source, box, n, workers, {}, {}, slab_bytes);
    EXPECT_TRUE(result.has_value());
    return std::move(*result);
}

void expect_equal(const Histogram& a, const Histogram& b) {
    EXPECT_EQ(a.filled(), b.filled());
    EXPECT_EQ(a.blank(), b.blank());
    EXPECT_EQ(a.min(), b.min());
    EXPECT_EQ(a.max(), b.max());
}

TEST(CountValues, CountsEveryVoxelOnce) {
    const Index3 n{13, 11, 7};
    Formula source(n);
    const Histogram histogram = counted(source, whole(n), n);
    EXPECT_EQ(histogram.valid() + histogram.blank(), 13U * 11 * 7);
    EXPECT_EQ(histogram.min(), -100);
    EXPECT_EQ(histogram.max(), 13 * 11 * 7 - 101);
    for (const Histogram::Bin& bin : histogram.filled()) {
        EXPECT_EQ(bin.count, 1U);
    }
}

TEST(CountValues, SlabsOfAnySizeGiveTheSame) {
    const Index3 n{13, 11, 7};
    Formula source(n);
    const Histogram expected = counted(source, whole(n), n);
    for (const std::size_t bytes : {1UL, 20UL, 60UL, 500UL, 600UL, 1500UL}) {
        Formula sliced(n);
        expect_equal(counted(sliced, whole(n), n, bytes), expected);
        EXPECT_LE(sliced.largest() * sizeof(float), std::max(bytes, sizeof(float)));
    }
}

TEST(CountValues, ReadingAtOnceGivesTheSame) {
    const Index3 n{13, 11, 7};
    Formula source(n);
    const Histogram expected = counted(source, whole(n), n);
    for (const std::size_t bytes : {1UL, 60UL, 600UL, 1500UL, 1UL << 20}) {
        Formula sliced(n, true);
        expect_equal(counted(sliced, whole(n), n, bytes), expected);
        EXPECT_LE(3 * sliced.largest() * sizeof(float), std::max(bytes, 3 * sizeof(float)));
    }
}

TEST(CountValues, DivisionsAddUpToTheCube) {
    const Index3 n{13, 11, 7};
    Formula source(n);
    const Histogram expected = counted(source, whole(n), n);
    std::mt19937 random(11);
    for (int trial = 0; trial < 10; ++trial) {
        Histogram sum;
        const auto cut = [&](std::int64_t planes) {
            return static_cast<std::int64_t>(1 + random() % (planes - 2));
        };
        const Index3 cuts = {cut(n[0]), cut(n[1]), cut(n[2])};
        for (unsigned corner = 0; corner < 8; ++corner) {
            Box box = whole(n);
            for (unsigned axis = 0; axis < 3; ++axis) {
                ((corner >> axis & 1U) != 0 ? box.lo : box.hi)[axis] = cuts[axis];
            }
            sum.merge(counted(source, box, n));
        }
        expect_equal(sum, expected);
    }
}

TEST(CountValues, ThinCubesHaveTheirOnePlane) {
    const Index3 n{5, 1, 1};
    Formula source(n);
    EXPECT_EQ(counted(source, whole(n), n).valid(), 4U);
}

TEST(CountValues, PassesOnAFault) {
    const Index3 n{13, 11, 7};
    base::Workers workers(2);
    for (const bool concurrent : {false, true}) {
        for (int reads = 0; reads < 7; ++reads) {
            Formula source(n, concurrent);
            source.fail_after(reads);
            const auto result = count_values(source, whole(n), n, workers, {}, {}, 13 * 11 * 4);
            ASSERT_FALSE(result.has_value());
            EXPECT_EQ(result.error().code, base::Code::io);
        }
    }
}

TEST(CountValues, TellsOfEverRisingSharesUpToTheWhole) {
    const Index3 n{13, 11, 50};
    base::Workers workers(3);
    for (const bool concurrent : {false, true}) {
        Formula source(n, concurrent);
        double told = 0;
        const auto progress = [&, caller = std::this_thread::get_id()](double share) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_GT(share, told);
            told = share;
        };
        EXPECT_TRUE(count_values(source, whole(n), n, workers, progress, {}, 3 * 13 * 11 * 4));
        EXPECT_EQ(told, 1);
    }
}

TEST(CountValues, StopsWhenAsked) {
    const Index3 n{13, 11, 50};
    for (const int threads : {1, 3}) {
        for (const bool concurrent : {false, true}) {
            base::Workers workers(threads);
            Formula source(n, concurrent);
            std::stop_source stop;
            source.stop_at(20, stop);
            const auto result = count_values(source, whole(n), n, workers, {}, stop.get_token(), 13 * 11 * 4);
            ASSERT_FALSE(result.has_value()) << threads << concurrent;
            EXPECT_EQ(result.error().code, base::Code::cancelled);
            EXPECT_LE(source.reads(), 20 + threads);
        }
    }
}

}  // namespace
}  // namespace shearwater::volume
