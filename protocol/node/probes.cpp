#include "protocol/node/probes.h"

#include <algorithm>

namespace shearwater::node {

void Probes::begin(std::uint64_t number, const view::Factorisation& ray, std::set<std::size_t> children,
                   bool incomplete, wire::Time now) {
    rays_.begin(number, Ray{{number, {}, incomplete}, ray.faces[0].sign}, std::move(children), now);
}

// A ray meets a sub-volume's slices one after another, and no other's between them: their order is that of
// visibility. Should two children claim a slice, one of them has it.
void Probes::answer(std::size_t child, const wire::RayPart& part) {
    rays_.answer(part.number, child, [&](Ray& ray) {
        const auto before = [&](const view::RaySample& a, const view::RaySample& b) {
            return ray.sign > 0 ? a.slice < b.slice : a.slice > b.slice;
        };
        std::vector<view::RaySample>& all = ray.samples;
        const auto own = static_cast<std::ptrdiff_t>(all.size());
        all.insert(all.end(), part.samples.begin(), part.samples.end());
        std::sort(all.begin() + own, all.end(), before);
        std::inplace_merge(all.begin(), all.begin() + own, all.end(), before);
        const auto repeated = std::ranges::unique(all, {}, &view::RaySample::slice);
        all.erase(repeated.begin(), repeated.end());
        all.resize(std::min(all.size(), wire::most_ray_samples));
        ray.incomplete = ray.incomplete || part.incomplete;
    });
}

std::vector<wire::RayPart> Probes::take_complete() {
    std::vector<wire::RayPart> parts;
    for (Ray& ray : rays_.take_complete()) {
        parts.push_back(std::move(static_cast<wire::RayPart&>(ray)));
    }
    return parts;
}

}  // namespace shearwater::node
