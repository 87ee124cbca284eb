#include "server/head/pictures.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/base/check.h"
#include "common/base/stopwatch.h"

namespace shearwater::head {

namespace {

// What another frame of the same pair adds: renderers draw one after the other, and both lack the same parts
// mostly.
void add(const node::Account& other, node::Account& to) {
    for (const node::Missing& part : other.missing) {
        if (std::ranges::find(to.missing, part) == to.missing.end()) {
            to.missing.push_back(part);
        }
    }
    const double render = to.stats.render_seconds() + other.stats.render_seconds();
    const double composite = to.stats.composite_seconds() + other.stats.composite_seconds();
    node::add(other.stats, to.stats);
    to.stats.set_render_seconds(render);
    to.stats.set_composite_seconds(composite);
}

}  // namespace

void Pictures::lay(node::MergeJob& job, const wire::View& view, const view::Camera& camera,
                   base::Workers& workers) {
    const auto [found, is_new] = by_frame_.try_emplace(job.frame->number);
    Making& making = found->second;
    if (is_new) {
        making.frame = job.frame;
        if (!spare_.empty()) {
            making.canvas = std::move(spare_.back());
            spare_.pop_back();
        }
        making.canvas.begin(job.frame->factorisation);
        making.warp.emplace(job.frame->factorisation, making.canvas.windows(), job.frame->bands, camera,
                            view.size, view.tf.background);
        const auto pixels = making.warp->picture().pixels().size();
        const auto height = static_cast<std::size_t>(view.size.height);
        making.pieces.emplace(pixels, image::Warp::stripe_rows * pixels / height);
    }
    node::merge_into(making.canvas, job);
    if (job.last()) {
        making.account = std::move(job.account);
    }
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<std::size_t> stripes = making.warp->advance(job.end, workers);
    const auto warped = std::chrono::steady_clock::now();
    workers.for_each(static_cast<std::int64_t>(stripes.size()), [&](std::int64_t n) {
        making.pieces->code(stripes[static_cast<std::size_t>(n)], making.warp->picture().pixels());
    });
    making.warp_seconds += std::chrono::duration<double>(warped - begin).count();
    making.encode_seconds += base::seconds_since(warped);
}

Pictures::Picture Pictures::take(std::uint64_t first, std::size_t frames) {
    Picture picture;
    for (std::uint64_t frame = first; frame < first + frames; ++frame) {
        const auto found = by_frame_.find(frame);
        base::check(found != by_frame_.end() && found->second.warp->done(),
                    "a picture that is taken is whole");
        Making& making = found->second;
        const auto begin = std::chrono::steady_clock::now();
        base::Buffer coded = making.pieces->join();
        if (frame == first) {
            picture.coded = std::move(coded);
            picture.account = std::move(making.account);
        } else {
            // Code behind code is that of the pictures' pixels behind one another.
            picture.coded.insert(picture.coded.end(), coded.begin(), coded.end());
            add(making.account, picture.account);
        }
        picture.warp_seconds += making.warp_seconds;
        picture.encode_seconds += making.encode_seconds + base::seconds_since(begin);
        give_up(frame);
    }
    return picture;
}

bool Pictures::give_up(std::uint64_t frame) {
    auto making = by_frame_.extract(frame);
    if (making.empty()) {
        return false;
    }
    making.mapped().warp.reset();  // it views the canvas
    if (spare_.size() < most_spare) {
        spare_.push_back(std::move(making.mapped().canvas));
    }
    return true;
}

}  // namespace shearwater::head
