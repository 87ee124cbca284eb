#include "protocol/node/merge.h"

#include <algorithm>
#include <chrono>

#include "common/base/check.h"

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

}  // namespace

Merged merge(const MergeJob& job) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<volume::Box> boxes;
    for (const MergeJob::Part& part : job.parts) {
        boxes.push_back(part.box);
    }
    Merged merged{.frame = job.frame, .windows = {}, .missing = job.missing, .stats = {}};
    std::vector<image::WindowView16> views;
    for (const int index : view::visibility_order(job.factorisation, boxes)) {
        const MergeJob::Part& part = job.parts[static_cast<std::size_t>(index)];
        if (!part.present) {
            continue;
        }
        const auto windows = wire::windows_from(part.windows, job.factorisation);
        base::check(windows.has_value(), "windows were validated on arrival");
        views.insert(views.end(), windows->begin(), windows->end());
        add_stats(merged.stats, std::get<wire::pb::Windows>(part.windows.body).stats());
        merged.stats.set_window_bytes(merged.stats.window_bytes() + part.windows.payload_size());
    }
    merged.windows = image::merge_front_to_back(views);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    merged.stats.set_composite_seconds(merged.stats.composite_seconds() + spent.count());
    return merged;
}

void put(const std::vector<Missing>& missing,
         google::protobuf::RepeatedPtrField<wire::pb::Missing>& entries) {
    for (const Missing& part : missing) {
        wire::pb::Missing* const entry = entries.Add();
        entry->set_place(static_cast<std::uint32_t>(part.place));
        *entry->mutable_box() = wire::to_wire(part.box);
    }
}

wire::Message to_message(const Merged& merged) {
    wire::Message message = wire::windows_message(merged.frame, merged.windows);
    auto& body = std::get<wire::pb::Windows>(message.body);
    *body.mutable_stats() = merged.stats;
    put(merged.missing, *body.mutable_missing());
    return message;
}

}  // namespace shearwater::node
