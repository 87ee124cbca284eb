#include "server/head/canvases.h"

#include <utility>

namespace shearwater::head {

const image::Canvas& Canvases::lay(node::MergeJob& job) {
    const auto [canvas, is_new] = by_frame_.try_emplace(job.frame->number);
    if (is_new) {
        canvas->second = std::exchange(spare_, {});
        canvas->second.begin(job.frame->factorisation);
    }
    node::merge_into(canvas->second, job);
    return canvas->second;
}

bool Canvases::done_with(std::uint64_t frame) {
    auto canvas = by_frame_.extract(frame);
    if (canvas.empty()) {
        return false;
    }
    spare_ = std::move(canvas.mapped());
    return true;
}

}  // namespace shearwater::head
