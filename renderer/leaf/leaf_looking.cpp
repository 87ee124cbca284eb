// The leaf's part in saying what is visible: it is given the functions of all of the cube's blocks, and looks
// at its part of a picture by them.

#include <algorithm>
#include <utility>

#include "common/volume/levels.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_culling.h"
#include "renderer/leaf/leaf.h"

namespace shearwater::leaf {

namespace pb = wire::pb;

// The number of a job whose end replies to a request; none where there are too many already.
std::optional<Job> Leaf::begin_reply(std::uint64_t request) {
    if (replying_.size() >= most_replying) {
        return std::nullopt;
    }
    replying_[++last_job_] = request;
    return last_job_;
}

void Leaf::reply(Job job, std::string visible, Effects& effects) {
    if (const auto found = replying_.find(job); found != replying_.end()) {
        send_reply({found->second, false, std::move(visible)}, effects);
        replying_.erase(found);
    }
}

void Leaf::send_reply(const wire::Reply& reply, Effects& effects) const {
    member_.tell_parent(wire::message(wire::to_wire(reply)), effects.net);
}

void Leaf::on_give_functions(wire::LinkId link, const wire::Message& message, Effects& effects) {
    const auto given = wire::given_functions_from(message);
    if (!given) {
        effects.net.emplace_back(wire::CloseLink{link, given.error().reason, given.error().text});
        return;
    }
    const bool fits = share_ && phase_ == pb::PHASE_READY &&
                      given->part.side == culling::DirectionGrid::default_side &&
                      given->part.blocks == volume::Box{{}, culling::BlockGrid(share_->lattice.n).counts()} &&
                      given->key.level <= volume::coarsest_level(share_->lattice.n) && given_.take(*given);
    const std::optional<Job> job = fits ? begin_reply(given->request) : std::nullopt;
    if (!job) {
        send_reply({given->request, true}, effects);
        return;
    }
    const volume::Index3& n = share_->lattice.n;
    effects.jobs.emplace_back(Learn{*job, {given->key, n, volume::whole(n), given->part, message.payload}});
}

void Leaf::on_look(wire::LinkId link, const pb::Look& look, Effects& effects) {
    auto wanted = wire::look_from(look);
    if (!wanted) {
        effects.net.emplace_back(wire::CloseLink{link, wanted.error().reason, wanted.error().text});
        return;
    }
    const auto own = share_ ? std::ranges::find(wanted->places, share_->place) : wanted->places.end();
    if (share_ && own == wanted->places.end()) {
        send_reply({wanted->request}, effects);  // others look at all of it
        return;
    }
    const bool can_look = share_ && phase_ == pb::PHASE_READY &&
                          wanted->factorisation.lattice == share_->lattice && given_.has(wanted->functions);
    const std::optional<Job> job = can_look ? begin_reply(wanted->request) : std::nullopt;
    if (!job) {
        send_reply({wanted->request, true}, effects);
        return;
    }
    const culling::ImagePart part{static_cast<int>(own - wanted->places.begin()),
                                  static_cast<int>(wanted->places.size())};
    effects.jobs.emplace_back(Look{
        *job,
        {wanted->request, std::move(wanted->factorisation), std::move(wanted->tf), wanted->settings, part}});
}

void Leaf::on_looked(const Looked& looked, Effects& effects) {
    reply(looked.job, wire::bits_of(looked.looked.visible.blocks), effects);
}

void Leaf::keep_given(std::span<const std::uint64_t> numbers, Effects& effects) {
    for (culling::FunctionKey& key : given_.keep(numbers)) {
        effects.jobs.emplace_back(node::Forget{std::move(key)});
    }
}

}  // namespace shearwater::leaf
