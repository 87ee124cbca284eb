#include "protocol/node/merge.h"

#include <algorithm>
#include <chrono>

namespace shearwater::node {
namespace {

// The slowest path counts for time, every node for work.
void add_stats(wire::pb::LeafStats& sum, const wire::pb::LeafStats& part) {
    sum.set_render_seconds(std::max(sum.render_seconds(), part.render_seconds()));
    sum.set_composite_seconds(std::max(sum.composite_seconds(), part.composite_seconds()));
    sum.set_samples(sum.samples() + part.samples());
    sum.set_bricks_total(sum.bricks_total() + part.bricks_total());
    sum.set_bricks_empty(sum.bricks_empty() + part.bricks_empty());
    sum.set_bricks_rendered(sum.bricks_rendered() + part.bricks_rendered());
    sum.set_window_bytes(sum.window_bytes() + part.window_bytes());
}

using Clock = std::chrono::steady_clock;

void add_composite(wire::pb::LeafStats& stats, Clock::time_point since) {
    const std::chrono::duration<double> spent = Clock::now() - since;
    stats.set_composite_seconds(stats.composite_seconds() + spent.count());
}

// All that the children gave, front to back.
struct Given {
    std::vector<image::SpanWindow> windows;
    wire::pb::LeafStats stats;
};
Given front_to_back(const MergeJob& job) {
    std::vector<volume::Box> boxes;
    for (const MergeJob::Part& part : job.parts) {
        boxes.push_back(part.box);
    }
    Given given;
    for (const int index : view::visibility_order(job.factorisation, boxes)) {
        const MergeJob::Part& part = job.parts[static_cast<std::size_t>(index)];
        if (!part.present) {
            continue;
        }
        given.windows.insert(given.windows.end(), part.windows.begin(), part.windows.end());
        add_stats(given.stats, part.stats);
    }
    given.stats.set_window_bytes(given.stats.window_bytes() + job.bytes());
    return given;
}

wire::Message message_of(std::uint64_t frame, image::CodedWindows windows,
                         const std::vector<Missing>& missing, const wire::pb::LeafStats& stats) {
    wire::Message message = wire::windows_message(frame, std::move(windows));
    auto& body = std::get<wire::pb::Windows>(message.body);
    *body.mutable_stats() = stats;
    put(missing, *body.mutable_missing());
    return message;
}

}  // namespace

std::size_t MergeJob::bytes() const {
    std::size_t sum = 0;
    for (const Part& part : parts) {
        sum += part.payload ? part.payload->size() : 0;
    }
    return sum;
}

Merged merge(const MergeJob& job) {
    const auto begin = Clock::now();
    const Given given = front_to_back(job);
    Merged merged{.frame = job.frame, .windows = {}, .missing = job.missing, .stats = given.stats};
    merged.windows = image::merge_front_to_back(given.windows);
    add_composite(merged.stats, begin);
    return merged;
}

wire::Message merge_coded(const MergeJob& job) {
    const auto begin = Clock::now();
    Given given = front_to_back(job);
    image::CodedWindows merged = image::merge_coded(given.windows);
    add_composite(given.stats, begin);
    return message_of(job.frame, std::move(merged), job.missing, given.stats);
}

void put(const std::vector<Missing>& missing,
         google::protobuf::RepeatedPtrField<wire::pb::Missing>& entries) {
    for (const Missing& part : missing) {
        wire::pb::Missing* const entry = entries.Add();
        entry->set_place(static_cast<std::uint32_t>(part.place));
        *entry->mutable_box() = wire::to_wire(part.box);
    }
}

wire::Message to_message(const Merged& drawn) {
    const auto begin = Clock::now();
    image::CodedWindows coded = image::encode(drawn.windows);
    wire::pb::LeafStats stats = drawn.stats;
    add_composite(stats, begin);
    return message_of(drawn.frame, std::move(coded), drawn.missing, stats);
}

}  // namespace shearwater::node
