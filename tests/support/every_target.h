#pragma once
// Kernels are compiled for several sets of vector instructions, and the best that the processor has is taken.

#include <hwy/highway.h>

#include <cstdint>

namespace shearwater::support {

// Calls body(name) with each set that this processor has as the one that kernels are dispatched to, plain
// scalar code included.
template <class Body>
void for_every_target(const Body& body) {
    const auto choose = [](std::int64_t targets) {
        hwy::SetSupportedTargetsForTest(targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
        const std::int64_t target = rest & -rest;
        choose(target);
        body(hwy::TargetName(target));
        choose(0);
    }
}

}  // namespace shearwater::support
