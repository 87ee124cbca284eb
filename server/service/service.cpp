#include "server/service/service.h"

#include <boost/asio/post.hpp>
#include <cstring>
#include <limits>
#include <utility>

#include "common/base/stopwatch.h"
#include "common/volume/interpolate.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/picture.h"

namespace shearwater::service {

namespace pb = wire::pb;

Service::Service(int threads, std::unique_ptr<volume::VoxelSource> cube,
                 std::function<void(head::JobEvent)> tell)
    : cube_(std::move(cube)), tell_(std::move(tell)), workers_(threads), lookers_(threads) {
    boost::asio::post(learning_, [] { base::run_in_background(); });
}

Service::~Service() {
    for (boost::asio::thread_pool* const pool : {&frames_, &looking_, &learning_, &reading_}) {
        pool->stop();
    }
    for (boost::asio::thread_pool* const pool : {&frames_, &looking_, &learning_, &reading_}) {
        pool->join();
    }
}

void Service::perform(head::Job job) {
    if (auto* band = std::get_if<head::Lay>(&job)) {
        boost::asio::post(frames_, [this, work = std::move(*band)]() mutable {
            pictures_.lay(work.merge, *work.view, work.camera, workers_);
        });
    } else if (auto* frame = std::get_if<head::Finish>(&job)) {
        boost::asio::post(frames_, [this, work = std::move(*frame)] { finish(work); });
    } else if (auto* given_up = std::get_if<head::GiveUp>(&job)) {
        boost::asio::post(frames_, [this, number = given_up->frame] { pictures_.give_up(number); });
    } else if (auto* look = std::get_if<node::Look>(&job)) {
        boost::asio::post(looking_,
                          [this, work = std::move(*look)] { tell_(lookout_.look(work, lookers_)); });
    } else if (auto* learn = std::get_if<node::Learn>(&job)) {
        boost::asio::post(learning_, [this, work = std::move(*learn)] { lookout_.learn(work); });
    } else if (auto* forget = std::get_if<node::Forget>(&job)) {
        boost::asio::post(learning_, [this, work = std::move(*forget)] { lookout_.forget(work); });
    } else if (auto* give = std::get_if<head::Give>(&job)) {
        boost::asio::post(learning_, [this, work = std::move(*give)] {
            tell_(head::Given{work.request,
                              lookout_.give(work.request, work.key, work.number, work.first_direction)});
        });
    } else if (auto* read = std::get_if<head::ReadVoxels>(&job)) {
        boost::asio::post(reading_, [this, work = std::move(*read)] { read_voxels(work); });
    } else if (const auto* measuring = std::get_if<head::Measure>(&job)) {
        boost::asio::post(reading_, [this, work = *measuring] { measure(work); });
    }
}

void Service::finish(const head::Finish& job) {
    auto picture = pictures_.take(job.frame, job.eyes);
    pb::Frame frame;
    frame.set_number(job.frame);
    frame.set_revision(job.view->revision);
    frame.set_sketch(job.sketch);
    node::put(picture.account.missing, *frame.mutable_missing());
    const wire::Time encode_begin = std::chrono::steady_clock::now();
    wire::Message message = wire::frame_message(std::move(frame), job.view->size, static_cast<int>(job.eyes),
                                                std::move(picture.coded), job.view->deflate);
    pb::FrameStats* const stats = std::get<pb::Frame>(message.body).mutable_stats();
    *stats->mutable_leaves() = picture.account.stats;
    stats->set_warp_seconds(picture.warp_seconds);
    stats->set_encode_seconds(picture.encode_seconds + base::seconds_since(encode_begin));
    stats->set_look_seconds(job.look_seconds);
    stats->set_lookers(static_cast<std::uint32_t>(job.lookers));
    stats->set_total_seconds(base::seconds_since(job.asked));
    tell_(head::Finished{job.frame, std::move(message)});
}

void Service::read_voxels(const head::ReadVoxels& job) {
    constexpr std::int64_t most_voxels = (std::int64_t{64} << 20) / 4;
    pb::Voxels voxels;
    voxels.set_place(job.need.place());
    voxels.set_request(job.need.request());
    *voxels.mutable_box() = job.need.box();
    base::Buffer payload;
    const auto box = wire::box_from(job.need.box());
    if (!box || box->voxels() > most_voxels) {
        voxels.set_error("more voxels at a time than are sent");
    } else {
        std::vector<float> values(static_cast<std::size_t>(box->voxels()));
        if (const auto read = cube_->read(*box, values); read) {
            payload.resize(values.size() * sizeof(float));
            std::memcpy(payload.data(), values.data(), payload.size());
        } else {
            voxels.set_error(read.error().message());
        }
    }
    tell_(head::VoxelsRead{wire::message(std::move(voxels), std::move(payload))});
}

void Service::measure(const head::Measure& job) {
    const auto value = volume::value_at(*cube_, job.n, {job.at.x, job.at.y, job.at.z});
    tell_(head::Measured{job.number, value ? *value : std::numeric_limits<double>::quiet_NaN()});
}

}  // namespace shearwater::service
