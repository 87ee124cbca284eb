#include "renderer/jobs/jobs.h"

#include <boost/asio/post.hpp>
#include <boost/asio/use_future.hpp>
#include <chrono>

#include "common/base/check.h"
#include "common/base/memory.h"
#include "common/base/stopwatch.h"
#include "common/cube/open.h"
#include "common/volume/counting_source.h"
#include "common/volume/statistics.h"
#include "protocol/node/merge.h"
#include "renderer/culling/culler.h"
#include "renderer/shear/ray_samples.h"
#include "renderer/shear/render.h"

namespace shearwater::jobs {

Jobs::Jobs(int threads, std::function<void(leaf::JobEvent)> tell, std::optional<cache::FunctionCache> kept)
    : tell_(std::move(tell)),
      loaders_(threads),
      drawers_(threads),
      finders_(threads, base::Workers::Priority::background),
      lookers_(threads),
      kept_(std::move(kept)) {
    boost::asio::post(finding_, [] { base::run_in_background(); });
}

Jobs::~Jobs() {
    {
        const std::lock_guard lock(mutex_);
        for (auto& [job, source] : running_) {
            source.request_stop();
        }
    }
    loading_.join();
    drawing_.join();
    finding_.join();
    looking_.join();
    picking_.join();
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
        boost::asio::post(loading_, [this, job = std::move(*counting), stop = begin(counting->job)] {
            count(job, stop);
            end(job.job);
        });
    } else if (auto* loading = std::get_if<leaf::Load>(&effect)) {
        boost::asio::post(loading_, [this, job = std::move(*loading), stop = begin(loading->job)] {
            load(job, stop);
            end(job.job);
        });
    } else if (auto* finding = std::get_if<leaf::Find>(&effect)) {
        boost::asio::post(loading_, [this, job = std::move(*finding), stop = begin(finding->job)] {
            if (find_kept(job, stop)) {
                end(job.job);
                return;
            }
            find(job, true, loaders_, stop);
            boost::asio::post(finding_, [this, job, stop] {
                find(job, false, finders_, stop);
                end(job.job);
            });
        });
    } else if (auto* sampling = std::get_if<leaf::SampleRay>(&effect)) {
        boost::asio::post(picking_, [this, job = std::move(*sampling)] { sample_ray(job); });
    } else if (auto* learning = std::get_if<leaf::Learn>(&effect)) {
        boost::asio::post(looking_, [this, job = std::move(*learning)] {
            lookout_.learn(job.learn);
            tell_(leaf::Learned{job.job});
        });
    } else if (auto* forgotten = std::get_if<node::Forget>(&effect)) {
        boost::asio::post(looking_, [this, job = std::move(*forgotten)] { lookout_.forget(job); });
    } else if (auto* looking = std::get_if<leaf::Look>(&effect)) {
        boost::asio::post(looking_, [this, job = std::move(*looking)] {
            tell_(leaf::Looked{job.job, lookout_.look(job.look, lookers_)});
        });
    } else if (auto* drawing = std::get_if<leaf::Draw>(&effect)) {
        boost::asio::post(drawing_, [this, job = std::move(*drawing), stop = begin(drawing->job)] {
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

void Jobs::put(std::optional<Drawable> cube, std::optional<cache::Origin> origin) {
    {
        const std::lock_guard lock(mutex_);
        found_in_ = {cube ? cube->volume : nullptr, std::move(origin)};
    }
    boost::asio::post(drawing_, boost::asio::use_future([&] {
                          cube_.reset();  // before what takes its place
                          cube_ = std::move(cube);
                      }))
        .wait();
}

void Jobs::put(SketchToDraw sketch) {
    boost::asio::post(drawing_, boost::asio::use_future([&] { sketch_ = std::move(sketch); })).wait();
}

// None where single rows cost as much as all: of voxels from the tree, or compressed in larger tiles.
void Jobs::sketch(leaf::Job job, const leaf::Share& share, int level, volume::VoxelSource& source,
                  const std::stop_token& stop) {
    if (level == 0 || !source.gives_rows()) {
        return;
    }
    // What cannot be read is told by the pass over all voxels.
    if (auto read = shear::Sketch::read(source, share.box, share.lattice.n, level, loaders_, stop)) {
        volume::Histogram histogram = read->histogram();
        put(SketchToDraw{*std::move(read)});
        tell_(leaf::Sketched{job, std::move(histogram)});
    }
}

void Jobs::count(const leaf::Count& job, const std::stop_token& stop) {
    const auto source = open(job.job, job.share, stop);
    if (!source) {
        tell_(leaf::Counted{job.job, source.error()});
        return;
    }
    sketch(job.job, job.share, job.sketch_level, **source, stop);
    const auto progress = [&](double fraction) { tell_(leaf::Advanced{job.job, fraction}); };
    tell_(leaf::Counted{job.job, volume::count_values(**source, job.share.box, job.share.lattice.n, loaders_,
                                                      progress, stop)});
    tell_memory();
}

void Jobs::load(const leaf::Load& job, const std::stop_token& stop) {
    put(std::nullopt);
    // As the file is before it is read: whatever is written to it meanwhile makes it another.
    std::optional<cache::Origin> origin = cache::origin_of(job.share.path, job.share.hdu, job.share.plane);
    const auto source = open(job.job, job.share, stop);
    if (!source) {
        tell_(leaf::Loaded{job.job, source.error()});
        return;
    }
    sketch(job.job, job.share, job.sketch_level, **source, stop);
    const auto progress = [&](double fraction) { tell_(leaf::Advanced{job.job, fraction}); };
    const auto& n = job.share.lattice.n;
    std::optional<volume::CountingSource> counting;
    if (job.count) {
        counting.emplace(**source, job.share.box, n);
    }
    volume::VoxelSource& voxels = counting ? *counting : **source;
    auto bricks = shear::BrickVolume::load(voxels, job.share.box, n, job.mapping, loaders_, progress, stop);
    if (!bricks) {
        tell_(leaf::Loaded{job.job, bricks.error()});
        return;
    }
    if (const auto kept = bricks->keep_copies(job.share.copies, loaders_, stop); !kept) {
        tell_(leaf::Loaded{job.job, kept.error()});
        return;
    }
    if (dynamic_cast<const LinkSource*>(source->get()) != nullptr) {
        origin.reset();
    }
    put(Drawable{std::make_shared<const shear::BrickVolume>(*std::move(bricks))}, std::move(origin));
    base::release_free_memory();
    tell_memory();
    tell_(leaf::Loaded{job.job, {}, counting ? std::optional(counting->histogram()) : std::nullopt});
}

Jobs::Drawable* Jobs::drawable(const leaf::Draw& draw) {
    if (!draw.sketch) {
        sketch_.reset();
        return cube_ ? &*cube_ : nullptr;
    }
    if (!sketch_ || sketch_->sketch.level() != draw.factorisation.level()) {
        return nullptr;
    }
    std::optional<Drawable>& by_limits = sketch_->by_limits;
    if (!by_limits || by_limits->volume->mapping() != *draw.sketch) {
        by_limits.emplace(
            std::make_shared<const shear::BrickVolume>(sketch_->sketch.volume(*draw.sketch, drawers_)));
    }
    return &*by_limits;
}

void Jobs::draw(const leaf::Draw& job, const std::stop_token& stop) {
    if (stop.stop_requested()) {
        return;
    }
    const auto begin = std::chrono::steady_clock::now();
    Drawable* const from = drawable(job);
    base::check(from != nullptr, "what is to be drawn is there");
    const std::vector<view::Band> bands = view::bands_of(job.factorisation);
    double coding = 0;
    wire::Message last = wire::windows_message(job.frame, bands.size(), {});
    const auto on_bands = [&](const shear::DrawnBands& drawn) {
        const auto coding_begin = std::chrono::steady_clock::now();
        wire::Message message =
            wire::windows_message(job.frame, drawn.bands, image::encode({&drawn.window, 1}));
        coding += base::seconds_since(coding_begin);
        if (drawn.bands == bands.size()) {
            last = std::move(message);  // what the frame cost goes with it
        } else {
            tell_(leaf::Drawn{job.job, std::move(message), false});
        }
    };
    const auto& classification =
        from->classifier.classify(*from->volume, job.tf, job.factorisation.classify, drawers_);
    const shear::RenderStats stats =
        shear::render_bands(*from->volume, classification, job.factorisation, bands, drawers_, on_bands,
                            {.stop = stop, .visible = job.visible ? &*job.visible : nullptr});
    if (stop.stop_requested()) {
        return;
    }
    node::Account account;
    // One of the threads codes at a time, and the others render.
    account.stats.set_render_seconds(base::seconds_since(begin) - coding / drawers_.threads());
    account.stats.set_composite_seconds(coding);
    account.stats.set_samples(stats.samples);
    account.stats.set_bricks_total(stats.bricks_total);
    account.stats.set_bricks_empty(stats.bricks_empty);
    account.stats.set_bricks_culled(stats.bricks_culled);
    account.stats.set_bricks_rendered(stats.bricks_rendered);
    node::put(account, std::get<wire::pb::Windows>(last.body));
    tell_(leaf::Drawn{job.job, std::move(last), true});
    if (begin - memory_told_ > std::chrono::milliseconds(500)) {
        memory_told_ = begin;
        tell_memory();
    }
}

Jobs::FoundIn Jobs::found_in() {
    const std::lock_guard lock(mutex_);
    return found_in_;
}

std::optional<cache::Content> Jobs::content_of(const FoundIn& in, const leaf::Find& job) const {
    if (!kept_ || !in.origin || in.volume == nullptr) {
        return std::nullopt;
    }
    return cache::Content{.origin = *in.origin,
                          .n = in.volume->cube(),
                          .box = in.volume->box(),
                          .mapping = in.volume->mapping(),
                          .block_edge = job.block_edge,
                          .side = job.side,
                          .key = job.key};
}

bool Jobs::find_kept(const leaf::Find& job, const std::stop_token& stop) {
    const auto content = content_of(found_in(), job);
    auto table = content && !stop.stop_requested() ? kept_->find(*content) : std::nullopt;
    if (!table) {
        return false;
    }
    tell_(leaf::Found{job.job, *std::move(table), false});
    return true;
}

void Jobs::find(const leaf::Find& job, bool coarse, base::Workers& workers, const std::stop_token& stop) {
    const FoundIn in = found_in();
    // Octants are of voxels. Without a volume another is being loaded, and this job is told to stop.
    if (in.volume == nullptr || stop.stop_requested() || (coarse && job.key.level > 0)) {
        return;
    }
    culling::FunctionTable table =
        culling::functions_of(*in.volume, job.key, culling::BlockGrid(in.volume->cube(), job.block_edge),
                              culling::DirectionGrid(job.side), coarse, workers, stop);
    if (stop.stop_requested()) {
        return;
    }
    if (const auto content = coarse ? std::nullopt : content_of(in, job)) {
        kept_->keep(*content, table);
    }
    tell_(leaf::Found{job.job, std::move(table), coarse});
    if (!coarse) {
        tell_memory();
    }
}

void Jobs::sample_ray(const leaf::SampleRay& job) {
    const Volume volume = found_in().volume;
    const bool is_there = volume != nullptr && volume->cube() == job.ray.lattice.n;
    wire::RayPart part{job.number, {}, !is_there};
    if (is_there) {
        const shear::OpacityTable table(job.tf, volume->mapping().levels());
        part.samples = shear::sample_ray(*volume, table, job.ray);
    }
    tell_(leaf::RaySampled{job.job, std::move(part)});
}

void Jobs::tell_memory() {
    const base::MemoryUse use = base::memory_use();
    tell_(leaf::Memory{use.resident, use.peak});
}

}  // namespace shearwater::jobs
