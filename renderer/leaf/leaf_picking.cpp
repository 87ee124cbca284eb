// The leaf's part in picking: what single rays meet of its voxels.

#include "protocol/wire/convert.h"
#include "renderer/leaf/leaf.h"

namespace shearwater::leaf {

namespace pb = wire::pb;

void Leaf::on_probe(wire::LinkId link, const pb::Probe& probe, Effects& effects) {
    auto ray = wire::ray_from(probe);
    auto tf = wire::transfer_function_from(probe.transfer_function());
    if (!ray || !tf) {
        const wire::Fault fault = ray ? tf.error() : ray.error();
        effects.net.emplace_back(wire::CloseLink{link, fault.reason, fault.text});
        return;
    }
    const bool can_tell = share_ && ray->lattice == share_->lattice && phase_ == pb::PHASE_READY &&
                          sampling_.size() < most_sampling;
    if (!can_tell) {
        const wire::RayPart nothing{probe.number(), {}, true};
        member_.tell_parent(wire::message(wire::to_wire(nothing)), effects.net);
        return;
    }
    sampling_.insert(++last_job_);
    effects.jobs.emplace_back(SampleRay{last_job_, probe.number(), *std::move(ray), *std::move(tf)});
}

void Leaf::on_sampled(const RaySampled& sampled, Effects& effects) {
    if (sampling_.erase(sampled.job) == 0) {
        return;  // nobody waits for it any more
    }
    member_.tell_parent(wire::message(wire::to_wire(sampled.part)), effects.net);
}

}  // namespace shearwater::leaf
