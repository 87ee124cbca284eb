#pragma once
// The vector instructions that this machine can run, one set after the other.

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace shearwater::support {

// Calls body() with each set of instructions chosen; kernels that are dispatched at run time use it.
template <class Body>
void for_each_target(const Body& body) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        body();
    }
    hwy::SetSupportedTargetsForTest(0);
}

}  // namespace shearwater::support
