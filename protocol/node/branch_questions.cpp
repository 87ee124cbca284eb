// What a branch asks its children and puts together from what they answer: rays, of the children they may
// meet; and what all renderers do together, of all.

#include "protocol/node/branch.h"

namespace shearwater::node {

void Branch::probe(const view::Factorisation& ray, const wire::pb::Probe& probe, wire::Time now,
                   std::vector<wire::NetEffect>& effects) {
    std::set<std::size_t> asked;
    bool incomplete = false;
    const wire::Message message = wire::message(probe);
    for (std::size_t i = 0; i < children_.size(); ++i) {
        if (view::window_of(ray, ray.faces[0], children_[i].spec.box).empty()) {
            continue;
        }
        if (children_[i].link) {
            asked.insert(i);
            effects.push_back(wire::Send{*children_[i].link, message});
        } else {
            incomplete = true;
        }
    }
    probes_.begin(probe.number(), ray, std::move(asked), incomplete, now);
}

void Branch::on_probed(const Child& child, const wire::pb::Probed& probed,
                       std::vector<wire::NetEffect>& effects) {
    if (const auto part = wire::ray_part_from(probed)) {
        probes_.answer(index_of(child), *part);
    } else {
        fault(*child.link, part.error(), effects);
    }
}

void Branch::ask(std::uint64_t request, const wire::Message& question, wire::Time now,
                 std::vector<wire::NetEffect>& effects) {
    std::set<std::size_t> asked;
    for (std::size_t i = 0; i < children_.size(); ++i) {
        if (children_[i].link) {
            asked.insert(i);
            effects.push_back(wire::Send{*children_[i].link, question});
        }
    }
    const bool incomplete = asked.size() < children_.size();
    replies_.begin(request, {request, incomplete}, std::move(asked), now);
}

void Branch::on_replied(const Child& child, const wire::pb::Replied& replied,
                        std::vector<wire::NetEffect>& effects) {
    if (const auto reply = wire::reply_from(replied)) {
        replies_.answer(reply->request, index_of(child), [&](wire::Reply& all) { all.add(*reply); });
    } else {
        fault(*child.link, reply.error(), effects);
    }
}

}  // namespace shearwater::node
