#include "protocol/node/merge.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "common/image/over_windows.h"

namespace shearwater::node {
namespace {

// Adds what a merge took to its frame, and to the account that goes with the frame's last.
class Timed {
  public:
    explicit Timed(MergeJob& job) : job_(job) {}
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;
    ~Timed() {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
        job_.frame->seconds += spent.count();
        if (job_.last()) {
            wire::pb::LeafStats& stats = job_.account.stats;
            stats.set_composite_seconds(stats.composite_seconds() + job_.frame->seconds);
        }
    }

  private:
    MergeJob& job_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

std::size_t MergeJob::bytes() const {
    return std::accumulate(
        payloads.begin(), payloads.end(), std::size_t{0},
        [](std::size_t sum, const wire::Payload& payload) { return sum + payload->size(); });
}

void merge_into(image::Canvas& canvas, MergeJob& job) {
    const Timed timed(job);
    const std::vector<view::Band>& bands = job.frame->bands;
    for (std::size_t band = job.first; band < job.end; ++band) {
        canvas.lay(bands[band], band + 1 == job.end ? job.windows : std::vector<image::SpanWindow>());
    }
}

wire::Message merge_coded(MergeJob& job) {
    const auto merged = [&job] {
        const Timed timed(job);
        const std::uint64_t frame = job.frame->number;
        return job.windows.size() == 1
                   ? wire::windows_message(frame, {job.end, job.windows.front()}, job.payloads.front())
                   : wire::windows_message(frame, job.end, image::merge_coded(job.windows));
    };
    wire::Message message = merged();
    if (job.last()) {
        put(job.account, std::get<wire::pb::Windows>(message.body));
    }
    return message;
}

void put(const std::vector<Missing>& missing,
         google::protobuf::RepeatedPtrField<wire::pb::Missing>& entries) {
    for (const Missing& part : missing) {
        wire::pb::Missing* const entry = entries.Add();
        entry->set_place(static_cast<std::uint32_t>(part.place));
        *entry->mutable_box() = wire::to_wire(part.box);
    }
}

void put(const Account& account, wire::pb::Windows& body) {
    *body.mutable_stats() = account.stats;
    put(account.missing, *body.mutable_missing());
}

void add(const wire::pb::LeafStats& part, wire::pb::LeafStats& sum) {
    sum.set_render_seconds(std::max(sum.render_seconds(), part.render_seconds()));
    sum.set_composite_seconds(std::max(sum.composite_seconds(), part.composite_seconds()));
    sum.set_samples(sum.samples() + part.samples());
    sum.set_bricks_total(sum.bricks_total() + part.bricks_total());
    sum.set_bricks_empty(sum.bricks_empty() + part.bricks_empty());
    sum.set_bricks_rendered(sum.bricks_rendered() + part.bricks_rendered());
    sum.set_bricks_culled(sum.bricks_culled() + part.bricks_culled());
    sum.set_window_bytes(sum.window_bytes() + part.window_bytes());
}

}  // namespace shearwater::node
