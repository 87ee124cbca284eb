#include "server/head/pictures.h"

#include <chrono>
#include <utility>

#include "common/base/check.h"
#include "common/base/stopwatch.h"

namespace shearwater::head {

void Pictures::lay(node::MergeJob& job, const wire::View& view, base::Workers& workers) {
    const auto [found, is_new] = by_frame_.try_emplace(job.frame->number);
    Making& making = found->second;
    if (is_new) {
        making.frame = job.frame;
        making.canvas = std::exchange(spare_, {});
        making.canvas.begin(job.frame->factorisation);
        making.warp.emplace(job.frame->factorisation, making.canvas.windows(), job.frame->bands, view.camera,
                            view.size, view.tf.background);
    }
    node::merge_into(making.canvas, job);
    const auto begin = std::chrono::steady_clock::now();
    making.warp->advance(job.end, workers);
    making.warp_seconds += base::seconds_since(begin);
}

Pictures::Picture Pictures::take(std::uint64_t frame) {
    const auto found = by_frame_.find(frame);
    base::check(found != by_frame_.end(), "a picture that is taken was begun");
    Picture picture{found->second.warp->take(), found->second.warp_seconds};
    give_up(frame);
    return picture;
}

bool Pictures::give_up(std::uint64_t frame) {
    auto making = by_frame_.extract(frame);
    if (making.empty()) {
        return false;
    }
    making.mapped().warp.reset();
    spare_ = std::move(making.mapped().canvas);
    return true;
}

}  // namespace shearwater::head
