#pragma once
// Limits for faint structure on a background, as image viewers of astronomy have them by default.

#include "common/volume/histogram.h"
#include "common/volume/summary.h"

namespace shearwater::volume {

// The zscale limits of IRAF's display: values in rising order are nearly a straight line about the median,
// of the background's slope. The line is fitted to a thousand of them, those far off it left out step by
// step, and the limits are where it, steepened by 1 / `contrast`, meets the first and the last, or the least
// and the largest value, whichever is nearer. Those two where too few values are on a line. Of a summary with
// values.
Limits zscale_limits(const Summary& summary, double contrast = 0.25);

}  // namespace shearwater::volume
