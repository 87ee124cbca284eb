#pragma once
// One point of a face's intermediate image, by Catmull-Rom's cubic interpolation. This is the definition of
// what resample_span (resample_span.h) does by the row.

#include "common/image/layer.h"

namespace shearwater::image {

// Where a ray lies in the intermediate image, in the face's pixels.
struct Place {
    double i = 0, j = 0;
};

// Within the gamut: alpha from 0 to 1, and no colour above it. Transparent outside the cube's outline, in
// which the picture ends as sharply as the cube does.
RgbaF resample(const Layer& layer, const Place& place);

}  // namespace shearwater::image
