#include "renderer/jobs/jobs.h"

#include <boost/asio/post.hpp>
#include <chrono>

#include "common/base/memory.h"
#include "common/cube/open.h"
#include "common/volume/statistics.h"
#include "protocol/node/merge.h"
#include "renderer/shear/render.h"

namespace shearwater::jobs {

Jobs::Jobs(int threads, std::function<void(leaf::JobEvent)> tell)
    : tell_(std::move(tell)), workers_(threads) {}

Jobs::~Jobs() {
    {
        const std::lock_guard lock(mutex_);
        for (auto& [job, source] : running_) {
            source.request_stop();
        }
    }
    thread_.join();
}

std::stop_token Jobs::begin(leaf::Job job) {
    const std::lock_guard lock(mutex_);
    return running_[job].get_token();
}

void Jobs::end(leaf::Job job) {
    const std::lock_guard lock(mutex_);
    running_.erase(job);
    link_sources_.erase(job);
}

void Jobs::perform(leaf::Effect effect) {
    if (const auto* stopped = std::get_if<leaf::Stop>(&effect)) {
        const std::lock_guard lock(mutex_);
        if (const auto found = running_.find(stopped->job); found != running_.end()) {
            found->second.request_stop();
        }
    } else if (auto* handed = std::get_if<leaf::HandVoxels>(&effect)) {
        const std::lock_guard lock(mutex_);
        if (const auto found = link_sources_.find(handed->job); found != link_sources_.end()) {
            found->second->deliver(std::move(handed->voxels));
        }
    } else if (auto* counting = std::get_if<leaf::Count>(&effect)) {
        boost::asio::post(thread_, [this, job = std::move(*counting), stop = begin(counting->job)] {
            count(job, stop);
            end(job.job);
        });
    } else if (auto* loading = std::get_if<leaf::Load>(&effect)) {
        boost::asio::post(thread_, [this, job = std::move(*loading), stop = begin(loading->job)] {
            load(job, stop);
            end(job.job);
        });
    } else if (auto* drawing = std::get_if<leaf::Draw>(&effect)) {
        boost::asio::post(thread_, [this, job = std::move(*drawing), stop = begin(drawing->job)] {
            draw(job, stop);
            end(job.job);
        });
    }
}

base::Result<Jobs::Source> Jobs::open(leaf::Job job, const leaf::Share& share, const std::stop_token& stop) {
    auto cube = cube::open(share.path, {.hdu = share.hdu, .plane = share.plane, .stop = stop});
    if (cube && cube->info.n == share.lattice.n) {
        return Source(std::move(cube->source));
    }
    const bool not_here =
        cube || cube.error().code == base::Code::not_found || cube.error().code == base::Code::io;
    if (!not_here) {
        return cube.error();
    }
    auto source = std::make_shared<LinkSource>(
        [this, job](const volume::Box& box) {
            tell_(leaf::VoxelsWanted{job, box});
        },
        stop);
    const std::lock_guard lock(mutex_);
    link_sources_[job] = source;
    return Source(source);
}

void Jobs::count(const leaf::Count& job, const std::stop_token& stop) {
    const auto source = open(job.job, job.share, stop);
    if (!source) {
        tell_(leaf::Counted{job.job, source.error()});
        return;
    }
    const auto progress = [&](double fraction) { tell_(leaf::Advanced{job.job, fraction}); };
    tell_(leaf::Counted{job.job, volume::count_values(**source, job.share.box, job.share.lattice.n, workers_,
                                                      progress, stop)});
    tell_memory();
}

void Jobs::load(const leaf::Load& job, const std::stop_token& stop) {
    volume_.reset();
    classifier_ = {};
    const auto source = open(job.job, job.share, stop);
    if (!source) {
        tell_(leaf::Loaded{job.job, source.error()});
        return;
    }
    const auto progress = [&](double fraction) { tell_(leaf::Advanced{job.job, fraction}); };
    auto bricks = shear::BrickVolume::load(**source, job.share.box, job.share.lattice.n, job.mapping,
                                           workers_, progress, stop);
    if (!bricks) {
        tell_(leaf::Loaded{job.job, bricks.error()});
        return;
    }
    volume_ = *std::move(bricks);
    base::release_free_memory();
    tell_memory();
    tell_(leaf::Loaded{job.job, {}});
}

void Jobs::draw(const leaf::Draw& job, const std::stop_token& stop) {
    if (stop.stop_requested() || !volume_) {
        return;
    }
    const auto begin = std::chrono::steady_clock::now();
    shear::RenderStats stats;
    node::Merged drawn{.frame = job.frame, .windows = {}, .missing = {}, .stats = {}};
    const auto& classification = classifier_.classify(*volume_, job.tf, job.factorisation.classify, workers_);
    drawn.windows = shear::render(*volume_, classification, job.factorisation, workers_, &stats, stop);
    if (stop.stop_requested()) {
        return;
    }
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    drawn.stats.set_render_seconds(spent.count());
    drawn.stats.set_samples(stats.samples);
    drawn.stats.set_bricks_total(stats.bricks_total);
    drawn.stats.set_bricks_empty(stats.bricks_empty);
    drawn.stats.set_bricks_rendered(stats.bricks_rendered);
    tell_(leaf::Drawn{job.job, node::to_message(drawn)});
    if (begin - memory_told_ > std::chrono::milliseconds(500)) {
        tell_memory();
    }
}

void Jobs::tell_memory() {
    memory_told_ = std::chrono::steady_clock::now();
    const base::MemoryUse use = base::memory_use();
    tell_(leaf::Memory{use.resident, use.peak});
}

}  // namespace shearwater::jobs
