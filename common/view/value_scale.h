#pragma once
// The units in which people say where on a cube's values something lies, and the way between them.

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/base/result.h"
#include "common/volume/mapping.h"
#include "common/volume/summary.h"

namespace shearwater::view {

enum class Unit {
    stretched,   // s, 0 to 1 between the cube's limits
    value,       // as in the file, BUNIT
    percentile,  // of the valid voxels, 0 to 100
    sigma,       // robust standard deviations above the median
};

// "stretched", "value", "percentile", "sigma".
std::string_view name(Unit unit);
std::optional<Unit> unit_named(std::string_view name);

// Conversions rise with what they convert. They go on beyond the limits and beyond the least and the largest
// value: a stretch as an odd function, shares evenly (volume::Summary).
class ValueScale {
  public:
    explicit ValueScale(volume::Mapping mapping, std::shared_ptr<const volume::Summary> summary = nullptr)
        : mapping_(mapping), summary_(std::move(summary)) {}

    // Why a unit means nothing here, in a user's words; empty when it does.
    std::string fault_of(Unit unit) const;
    bool has(Unit unit) const { return fault_of(unit).empty(); }

    // Of units that it has. Positions are finite and within what transfer functions may hold.
    double from_s(Unit unit, double s) const;
    double to_s(Unit unit, double position) const;

  private:
    double value_of(double s) const;
    double s_of(double value) const;

    volume::Mapping mapping_;
    std::shared_ptr<const volume::Summary> summary_;
};

}  // namespace shearwater::view
