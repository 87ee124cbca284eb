// What a renderer's threads do with the jobs of its state machine.

#include "renderer/jobs/jobs.h"

#include <fitsio.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>

#include "common/volume/levels.h"
#include "protocol/wire/convert.h"
#include "tests/support/fits_fixture.h"

namespace shearwater::jobs {
namespace {

using namespace std::chrono_literals;

constexpr volume::Index3 n{70, 20, 16};
constexpr int level = 1;

class JobsTest : public testing::Test {
  protected:
    JobsTest() : jobs_(2, [this](leaf::JobEvent event) { on_event(std::move(event)); }) {}

    leaf::Share share_of(const std::string& path) const {
        return {.path = path,
                .lattice = {.n = n, .spacing = {1, 1, 1}},
                .box = {{0, 0, 0}, {50, 19, 15}},
                .place = 1};
    }
    std::string write(int compression, const std::vector<long>& tile = {}) {
        support::FitsImage image{.bitpix = 16, .axes = {n[0], n[1], n[2]}, .raw = {}};
        image.compression = compression;
        image.tile = tile;
        for (int i = 0; i < n[0] * n[1] * n[2]; ++i) {
            image.raw.push_back(i % 251);
        }
        const std::string path = scratch_.path("cube.fits");
        support::write_fits(path, {image});
        return path;
    }
    leaf::Draw draw(leaf::Job job, const std::optional<volume::Mapping>& sketch) const {
        const view::Lattice lattice{.n = n, .spacing = {1, 1, 1}};
        view::Factorisation factorisation =
            view::factorise(view::camera_on({}, lattice), {32, 24}, lattice, {});
        factorisation.slice_exponent = sketch ? level : 0;
        return {job, 9, factorisation, view::default_transfer_function(), sketch};
    }
    void on_event(leaf::JobEvent event) {
        const std::lock_guard lock(mutex_);
        events_.push_back(std::move(event));
        arrived_.notify_all();
    }
    // The next event of a kind; others before it are passed over, and counted if they are sketches.
    template <class Event>
    std::optional<Event> next() {
        std::unique_lock lock(mutex_);
        while (arrived_.wait_for(lock, 60s, [&] { return !events_.empty(); })) {
            const leaf::JobEvent event = std::move(events_.front());
            events_.pop_front();
            if (const auto* found = std::get_if<Event>(&event)) {
                return *found;
            }
            sketches_ += std::holds_alternative<leaf::Sketched>(event) ? 1 : 0;
        }
        return std::nullopt;
    }

    support::TemporaryFolder scratch_;
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<leaf::JobEvent> events_;
    int sketches_ = 0;
    Jobs jobs_;
};

// What another has found of the same cube is told at once, the same to the byte; of another mapping it is
// not.
TEST_F(JobsTest, FunctionsThatAreKeptAreNotFoundAgain) {
    const leaf::Share share = share_of(write(0));
    const std::string folder = scratch_.path("kept");
    const view::TransferFunction tf{
        .opacity_pins = {view::Flat{0.5}}, .colour_pins = {{0, {1, 1, 1}}}, .background = {}};
    const leaf::Find find{9, {culling::Footprint::column, culling::members_of(tf).at(0).basis, 0}, 32, 12};
    std::vector<std::string> logged;
    // The coarse functions, if they are told first, and all.
    const auto found = [&](const volume::Mapping& mapping) {
        std::pair<int, culling::FunctionTable> functions;
        Jobs jobs(
            1, [this](leaf::JobEvent event) { on_event(std::move(event)); },
            cache::FunctionCache(folder, [&](const std::string& line) { logged.push_back(line); }));
        jobs.perform(leaf::Load{1, share, mapping});
        const auto loaded = next<leaf::Loaded>();
        EXPECT_TRUE(loaded && loaded->status);
        jobs.perform(find);
        auto told = next<leaf::Found>();
        while (told && told->coarse) {
            ++functions.first;
            told = next<leaf::Found>();
        }
        EXPECT_TRUE(told);
        functions.second = told ? told->table : culling::FunctionTable{};
        return functions;
    };
    const auto first = found({0, 250});
    EXPECT_EQ(first.first, 1);
    EXPECT_FALSE(first.second.codes.empty());
    const auto again = found({0, 250});
    EXPECT_EQ(again.first, 0) << "kept";
    EXPECT_EQ(again.second, first.second);
    EXPECT_EQ(found({0, 251}).first, 1);
    EXPECT_TRUE(logged.empty());
}

TEST_F(JobsTest, ASketchComesBeforeTheCount) {
    jobs_.perform(leaf::Count{1, share_of(write(0)), level});
    const auto sketched = next<leaf::Sketched>();
    ASSERT_TRUE(sketched);
    EXPECT_EQ(sketched->job, 1U);
    EXPECT_EQ(sketched->histogram.valid(), 25U * 10 * 8)
        << "the box ends on nodes that others own, or beyond";
    const auto counted = next<leaf::Counted>();
    ASSERT_TRUE(counted && counted->histogram);
    EXPECT_EQ(counted->histogram->valid(), 50U * 20 * 16);
}

// A ray is followed beside a picture that is drawn, and before there is anything to follow it in.
TEST_F(JobsTest, ARayIsFollowedInWhatIsLoaded) {
    const view::Lattice lattice{.n = n, .spacing = {1, 1, 1}};
    const leaf::SampleRay ray{3, 7,
                              view::factorise_ray(view::camera_on({}, lattice), {32, 24}, {16, 12}, lattice),
                              view::default_transfer_function()};
    jobs_.perform(ray);
    const auto before = next<leaf::RaySampled>();
    ASSERT_TRUE(before);
    EXPECT_TRUE(before->part.incomplete && before->part.samples.empty());
    jobs_.perform(leaf::Load{1, share_of(write(0)), {.lo = 0, .hi = 250}, 0});
    ASSERT_TRUE(next<leaf::Loaded>());
    jobs_.perform(draw(2, {}));
    jobs_.perform(ray);
    const auto after = next<leaf::RaySampled>();
    ASSERT_TRUE(after);
    EXPECT_EQ(after->job, 3U);
    EXPECT_EQ(after->part.number, 7U);
    EXPECT_FALSE(after->part.incomplete || after->part.samples.empty());
}

TEST_F(JobsTest, NoSketchIsMadeWhereNoneIsWanted) {
    jobs_.perform(leaf::Count{1, share_of(write(0)), 0});
    ASSERT_TRUE(next<leaf::Counted>());
    EXPECT_EQ(sketches_, 0);
}

TEST_F(JobsTest, ASketchIsMadeOfAFileWhoseRowsAreCompressed) {
    jobs_.perform(leaf::Count{1, share_of(write(0)), level});
    const auto plain = next<leaf::Sketched>();
    ASSERT_TRUE(next<leaf::Counted>());
    leaf::Share share = share_of(write(RICE_1));
    share.hdu = 1;
    jobs_.perform(leaf::Count{2, share, level});
    const auto compressed = next<leaf::Sketched>();
    ASSERT_TRUE(plain && compressed);
    EXPECT_EQ(compressed->histogram.filled(), plain->histogram.filled());
}

TEST_F(JobsTest, NoSketchIsMadeOfAFileThatIsCompressedInLargerTiles) {
    leaf::Share share = share_of(write(RICE_1, {n[0], 2, 1}));
    share.hdu = 1;
    jobs_.perform(leaf::Count{1, share, level});
    const auto counted = next<leaf::Counted>();
    ASSERT_TRUE(counted && counted->histogram);
    EXPECT_EQ(counted->histogram->valid(), 50U * 20 * 16);
    EXPECT_EQ(sketches_, 0);
}

// The load asks for voxels that never come; the sketch is drawn nevertheless, by one pair of limits and
// another.
TEST_F(JobsTest, ASketchIsDrawnWhileALoadGoesOn) {
    jobs_.perform(leaf::Count{1, share_of(write(0)), level});
    ASSERT_TRUE(next<leaf::Counted>());
    jobs_.perform(leaf::Load{2, share_of(scratch_.path("nowhere.fits")), {.lo = 0, .hi = 250}, 0});
    ASSERT_TRUE(next<leaf::VoxelsWanted>());
    std::vector<std::size_t> bytes;
    for (const double hi : {250.0, 250.0, 1e6}) {
        jobs_.perform(draw(3, volume::Mapping{.lo = 0, .hi = hi}));
        const auto drawn = next<leaf::Drawn>();
        ASSERT_TRUE(drawn);
        bytes.push_back(drawn->windows.payload_size());
    }
    EXPECT_GT(bytes[0], 0U);
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_LT(bytes[2], bytes[0]) << "by these all is as dark as can be";
    jobs_.perform(leaf::Stop{2});
    const auto loaded = next<leaf::Loaded>();
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->status.error().code, base::Code::cancelled);
}

// Where limits were given there is one pass over the voxels, and it counts them too.
TEST_F(JobsTest, ALoadCountsWhatACountWould) {
    const leaf::Share share = share_of(write(0));
    jobs_.perform(leaf::Count{1, share, 0});
    const auto counted = next<leaf::Counted>();
    ASSERT_TRUE(counted && counted->histogram);
    jobs_.perform(leaf::Load{2, share, {.lo = 0, .hi = 250}, 0, true});
    const auto loaded = next<leaf::Loaded>();
    ASSERT_TRUE(loaded && loaded->status && loaded->histogram);
    EXPECT_EQ(loaded->histogram->filled(), counted->histogram->filled());
    EXPECT_EQ(loaded->histogram->blank(), counted->histogram->blank());
    jobs_.perform(leaf::Load{3, share, {.lo = 0, .hi = 250}, 0, false});
    const auto uncounted = next<leaf::Loaded>();
    ASSERT_TRUE(uncounted && uncounted->status);
    EXPECT_FALSE(uncounted->histogram);
}

TEST_F(JobsTest, WhatIsToldToStopBeforeItBeginsReadsNothing) {
    const leaf::Share share = share_of(write(0));
    jobs_.perform(leaf::Load{1, share_of(scratch_.path("nowhere.fits")), {}, 0});  // keeps the thread
    ASSERT_TRUE(next<leaf::VoxelsWanted>());
    jobs_.perform(leaf::Count{2, share, level});
    jobs_.perform(leaf::Stop{2});
    jobs_.perform(leaf::Stop{1});
    ASSERT_TRUE(next<leaf::Loaded>());
    const auto counted = next<leaf::Counted>();
    ASSERT_TRUE(counted);
    EXPECT_EQ(counted->histogram.error().code, base::Code::cancelled);
    EXPECT_EQ(sketches_, 0);
}

}  // namespace
}  // namespace shearwater::jobs
