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
        const auto pixels = making.warp->picture().pixels().size();
        const auto height = static_cast<std::size_t>(view.size.height);
        making.pieces.emplace(pixels, image::Warp::stripe_rows * pixels / height);
    }
    node::merge_into(making.canvas, job);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<std::size_t> stripes = making.warp->advance(job.end, workers);
    const auto warped = std::chrono::steady_clock::now();
    workers.for_each(static_cast<std::int64_t>(stripes.size()), [&](std::int64_t n) {
        making.pieces->code(stripes[static_cast<std::size_t>(n)], making.warp->picture().pixels());
    });
    making.warp_seconds += std::chrono::duration<double>(warped - begin).count();
    making.encode_seconds += base::seconds_since(warped);
}

Pictures::Picture Pictures::take(std::uint64_t frame) {
    const auto found = by_frame_.find(frame);
    base::check(found != by_frame_.end() && found->second.warp->done(), "a picture that is taken is whole");
    Making& making = found->second;
    const auto begin = std::chrono::steady_clock::now();
    Picture picture{.coded = making.pieces->join(),
                    .warp_seconds = making.warp_seconds,
                    .encode_seconds = making.encode_seconds + base::seconds_since(begin)};
    give_up(frame);
    return picture;
}

bool Pictures::give_up(std::uint64_t frame) {
    auto making = by_frame_.extract(frame);
    if (making.empty()) {
        return false;
    }
    making.mapped().warp.reset();  // it views the canvas
    spare_ = std::move(making.mapped().canvas);
    return true;
}

}  // namespace shearwater::head
