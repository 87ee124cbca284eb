// The choice of quality on a manual clock: frames are counted as a server of known speed would send them.

#include "client/model/pace.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>

namespace shearwater::model {
namespace {

using namespace std::chrono_literals;
using view::Quality;
using Seconds = Pace::Seconds;

// What a frame takes: rendering, which grows with quality, and all the rest, which does not.
struct Server {
    double draft, normal, high;
    double rest = 0.002;
    double noise = 0;  // of the whole, either way

    double render(Quality quality) const {
        return quality == Quality::draft ? draft : quality == Quality::normal ? normal : high;
    }
};

class PaceTest : public testing::Test {
  protected:
    // One frame at a time or two under way, as a drag without pause asks for them.
    void move(const Server& server, std::chrono::milliseconds time, bool two = true) {
        const wire::Time end = now_ + time;
        wire::Time sent = now_;
        while (now_ < end) {
            const Quality quality = pace_.while_moving(now_);
            switches_ += last_ && *last_ != quality ? 1 : 0;
            last_ = quality;
            const wire::Time sent_next = now_;
            pass(server, quality);
            pace_.count(now_, two ? sent : sent_next, quality, server.render(quality));
            ++frames_[quality];
            sent = sent_next;
        }
    }
    void rest(const Server& server) {
        now_ += 200ms;
        for (const Quality quality : {Quality::normal, Quality::high}) {
            const wire::Time sent = now_;
            pass(server, quality);
            pace_.count(now_, sent, quality, server.render(quality));
        }
        now_ += 5s;
    }
    void pass(const Server& server, Quality quality) {
        std::uniform_real_distribution<double> off(1 - server.noise, 1 + server.noise);
        const Seconds seconds((server.render(quality) + server.rest) * off(random_));
        now_ += std::chrono::duration_cast<wire::Time::duration>(seconds);
    }
    void forget() {
        frames_.clear();
        switches_ = 0;
    }
    int all() const {
        int sum = 0;
        for (const auto& [quality, count] : frames_) {
            sum += count;
        }
        return sum;
    }

    Pace pace_;
    wire::Time now_ = wire::Time{} + 1000s;
    std::mt19937 random_{7};
    std::optional<Quality> last_;
    std::map<Quality, int> frames_;
    int switches_ = 0;
};

TEST_F(PaceTest, AFastServerMovesInHighQuality) {
    const Server fast{.draft = 0.002, .normal = 0.006, .high = 0.025};
    rest(fast);
    move(fast, 1s);
    forget();
    move(fast, 10s);
    EXPECT_EQ(last_, Quality::high);
    EXPECT_EQ(switches_, 0);
}

TEST_F(PaceTest, ASlowServerMovesInDrafts) {
    const Server slow{.draft = 0.030, .normal = 0.110, .high = 0.500};
    rest(slow);
    move(slow, 10s);
    EXPECT_EQ(all(), frames_[Quality::draft]);
    EXPECT_GE(all(), 20 * 10);
}

TEST_F(PaceTest, WhenEvenDraftsAreTooSlowTheyAreWhatThereIs) {
    const Server slowest{.draft = 0.4, .normal = 1.5, .high = 7};
    move(slowest, 20s);
    EXPECT_EQ(all(), frames_[Quality::draft]);
}

TEST_F(PaceTest, TheBestThatHoldsTheTargetIsFound) {
    const Server server{.draft = 0.008, .normal = 0.030, .high = 0.140};
    for (const bool two : {true, false}) {
        move(server, 2s, two);
        forget();
        move(server, 10s, two);
        EXPECT_EQ(all(), frames_[Quality::normal]);
        EXPECT_GE(all(), 20 * 10);
    }
    // The same server under other demands.
    pace_.set({.fixed = {}, .target_rate = 60});
    move(server, 1s);
    forget();
    move(server, 5s);
    EXPECT_EQ(all(), frames_[Quality::draft]);
    pace_.set({.fixed = {}, .target_rate = 5});
    move(server, 2s);
    forget();
    move(server, 5s);
    EXPECT_EQ(all(), frames_[Quality::high]);
}

TEST_F(PaceTest, FollowsTheLoad) {
    const Server fast{.draft = 0.004, .normal = 0.015, .high = 0.070};
    const Server slow{.draft = 0.020, .normal = 0.080, .high = 0.350};
    move(fast, 3s);
    ASSERT_EQ(last_, Quality::normal);
    const wire::Time from = now_;
    forget();
    while (last_ != Quality::draft) {
        ASSERT_LT(now_ - from, 1s);
        move(slow, 1ms);
    }
    EXPECT_LE(frames_[Quality::normal], 6);
    move(slow, 5s);
    EXPECT_EQ(switches_, 1);
    move(fast, 10s);
    EXPECT_EQ(last_, Quality::normal);
    EXPECT_EQ(switches_, 2);
}

// At the very edge, with every frame a little different.
TEST_F(PaceTest, DoesNotFlickerWhereAQualityIsJustAffordable) {
    for (double normal = 0.030; normal < 0.070; normal += 0.002) {
        SCOPED_TRACE(normal);
        pace_ = {};
        const Server edge{.draft = normal / 4, .normal = normal, .high = 4.5 * normal, .noise = 0.3};
        move(edge, 2s);
        forget();
        move(edge, 30s);
        EXPECT_LE(switches_, 6);
    }
}

// A quality whose cost is not what its work says is tried, found too dear and left alone ever longer.
TEST_F(PaceTest, DoesNotFlickerWhereTheGuessIsWrong) {
    const Server odd{.draft = 0.004, .normal = 0.090, .high = 0.4};
    move(odd, 120s);
    EXPECT_EQ(last_, Quality::draft);
    constexpr int tries = 7;  // after pauses of 2, 4, 8, 16, 32 and 32 seconds
    EXPECT_LE(switches_, 2 * tries);
    EXPECT_LE(frames_[Quality::normal], 3 * tries);
    EXPECT_GE(all(), 20 * 110);
}

TEST_F(PaceTest, ASingleHiccupChangesNothing) {
    const Server server{.draft = 0.008, .normal = 0.030, .high = 0.140};
    move(server, 3s);
    forget();
    for (int i = 0; i < 10; ++i) {
        const wire::Time sent = now_;
        now_ += 700ms;
        pace_.count(now_, sent, *last_, 0.03);
        move(server, 1s);
    }
    EXPECT_EQ(all(), frames_[Quality::normal]);
}

TEST_F(PaceTest, OneFixedQualityIsUsedAlways) {
    const Server slow{.draft = 0.1, .normal = 0.5, .high = 2};
    for (const Quality fixed : {Quality::draft, Quality::normal, Quality::high}) {
        pace_.set({.fixed = fixed, .target_rate = 20});
        forget();
        move(slow, 10s);
        EXPECT_EQ(all(), frames_[fixed]);
        EXPECT_EQ(pace_.for_single(), fixed);
        EXPECT_EQ(pace_.best(), fixed);
        EXPECT_EQ(pace_.at_rest(fixed, true), std::nullopt);
        EXPECT_EQ(pace_.at_rest(fixed, false), std::nullopt);
    }
}

TEST_F(PaceTest, AtRestGoesUpInTwoSteps) {
    EXPECT_EQ(pace_.at_rest(Quality::draft, false), Quality::normal);
    EXPECT_EQ(pace_.at_rest(Quality::draft, true), Quality::normal);
    EXPECT_EQ(pace_.at_rest(Quality::normal, false), std::nullopt);
    EXPECT_EQ(pace_.at_rest(Quality::normal, true), Quality::high);
    EXPECT_EQ(pace_.at_rest(Quality::high, false), std::nullopt);
    EXPECT_EQ(pace_.at_rest(Quality::high, true), std::nullopt);
}

// With two under way each takes twice as long from end to end, and is as dear as ever.
TEST_F(PaceTest, CostIsTheTimeBetweenFramesOfAFullPipeline) {
    for (int i = 0; i < 5; ++i) {
        now_ += 30ms;
        pace_.count(now_, now_ - 60ms, Quality::normal, 0.02);
    }
    EXPECT_NEAR(pace_.cost(Quality::normal)->count(), 0.030, 1e-9);
    EXPECT_NEAR(pace_.cost(Quality::draft)->count(), 0.010 + 0.020 / 4, 1e-9);
    EXPECT_NEAR(pace_.cost(Quality::high)->count(), 0.010 + 0.020 * 4.5, 1e-9);
}

TEST_F(PaceTest, WhatAPeerSaysOfItsTimesIsHarmless) {
    EXPECT_FALSE(pace_.cost(Quality::draft));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double said : {std::numeric_limits<double>::quiet_NaN(), -infinity, -1.0, 1e300, infinity}) {
        now_ += 20ms;
        pace_.count(now_, now_ - 20ms, Quality::draft, said);
        const double dearer = pace_.cost(Quality::normal)->count();
        EXPECT_GE(dearer, 0.019);
        EXPECT_LE(dearer, 0.081);
    }
    pace_.count(now_, now_ + 1s, Quality::draft, 0.1);  // a clock that stands still
    EXPECT_GE(pace_.cost(Quality::draft)->count(), 0);
    pace_.set({.fixed = {}, .target_rate = 1e300});
    EXPECT_EQ(pace_.while_moving(now_), Quality::draft);
}

}  // namespace
}  // namespace shearwater::model
