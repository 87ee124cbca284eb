#pragma once
// A transfer function that a window was opened with, until the cube is known that it is put onto.

#include <optional>
#include <string>

#include "client/model/status.h"
#include "common/view/anchored_function.h"
#include "protocol/wire/events.h"

namespace shearwater::model {

class Anchoring {
  public:
    // For values of a cube, from when all is loaded.
    static constexpr std::chrono::seconds patience{20};

    explicit Anchoring(view::AnchoredFunction function) : function_(std::move(function)) {}

    // What it is by all that is known, where that is news. By a sketch's values first, and once more by the
    // cube's, unless the person has made another of it meanwhile.
    std::optional<view::TransferFunction> settle(const Status& status, const view::TransferFunction& shown,
                                                 wire::Time now);

    bool pending() const { return pending_; }
    // Why it cannot be used, or empty.
    const std::string& fault() const { return fault_; }

  private:
    view::AnchoredFunction function_;
    bool pending_ = true;
    std::optional<view::TransferFunction> first_;  // by the sketch's values
    std::optional<wire::Time> ready_;
    std::string fault_;
};

}  // namespace shearwater::model
