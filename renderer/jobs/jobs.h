#pragma once
// Carries out a leaf's jobs: counting, loading and finding coarse opacity functions on one thread, drawing on
// another, finding all of them in the background on a third, looking what pictures show on a fourth, each
// with workers that share its loops, and following single rays on a fifth. So a sketch can be drawn while the
// rest is loading, what the next picture shows is known while one is drawn, and a pick need not wait for any.

#include <boost/asio/thread_pool.hpp>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>

#include "common/base/workers.h"
#include "common/volume/source.h"
#include "protocol/node/lookout.h"
#include "renderer/cache/function_cache.h"
#include "renderer/jobs/link_source.h"
#include "renderer/leaf/leaf.h"
#include "renderer/shear/brick_volume.h"
#include "renderer/shear/classification.h"
#include "renderer/shear/sketch.h"

namespace shearwater::jobs {

class Jobs {
  public:
    // `tell` is called from the jobs' threads and must only pass the event on. Opacity functions are kept in
    // `kept`, if anywhere.
    Jobs(int threads, std::function<void(leaf::JobEvent)> tell,
         std::optional<cache::FunctionCache> kept = std::nullopt);
    ~Jobs();  // stops what runs
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    void perform(leaf::Effect effect);

  private:
    using Source = std::shared_ptr<volume::VoxelSource>;

    std::stop_token begin(leaf::Job job);
    void end(leaf::Job job);
    void count(const leaf::Count& count, const std::stop_token& stop);
    void load(const leaf::Load& load, const std::stop_token& stop);
    void draw(const leaf::Draw& draw, const std::stop_token& stop);
    // Tells the functions if they are kept.
    bool find_kept(const leaf::Find& find, const std::stop_token& stop);
    void find(const leaf::Find& find, bool coarse, base::Workers& workers, const std::stop_token& stop);
    void sample_ray(const leaf::SampleRay& job);
    void sketch(leaf::Job job, const leaf::Share& share, int level, volume::VoxelSource& source,
                const std::stop_token& stop);
    base::Result<Source> open(leaf::Job job, const leaf::Share& share, const std::stop_token& stop);
    void tell_memory();

    using Volume = std::shared_ptr<const shear::BrickVolume>;
    struct Drawable {
        Volume volume;
        shear::Classifier classifier = {};
    };
    // A sketch becomes drawable by the limits it is to be drawn by.
    struct SketchToDraw {
        shear::Sketch sketch;
        std::optional<Drawable> by_limits = {};
    };
    Drawable* drawable(const leaf::Draw& draw);
    // What the drawing thread draws from is changed there, once what is being drawn is finished.
    void put(std::optional<Drawable> cube, std::optional<cache::Origin> origin = std::nullopt);
    void put(SketchToDraw sketch);

    std::function<void(leaf::JobEvent)> tell_;
    base::Workers loaders_, drawers_, finders_, lookers_;
    // Touched by the drawing thread only.
    std::optional<Drawable> cube_;
    std::optional<SketchToDraw> sketch_;
    std::chrono::steady_clock::time_point memory_told_;
    std::mutex mutex_;
    std::map<leaf::Job, std::stop_source> running_;
    std::map<leaf::Job, std::shared_ptr<LinkSource>> link_sources_;
    // The cube, for the finding and the picking thread, and what file it is if it is one that this machine
    // can see.
    struct FoundIn {
        Volume volume;
        std::optional<cache::Origin> origin;
    };
    FoundIn found_in();
    std::optional<cache::Content> content_of(const FoundIn& in, const leaf::Find& find) const;
    std::optional<cache::FunctionCache> kept_;
    FoundIn found_in_;
    node::Lookout lookout_;  // touched by the looking thread only
    boost::asio::thread_pool drawing_{1}, loading_{1}, finding_{1}, looking_{1}, picking_{1};
};

}  // namespace shearwater::jobs
