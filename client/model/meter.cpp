#include "client/model/meter.h"

namespace shearwater::model {

void Meter::count(wire::Time now, std::chrono::duration<double> latency, std::size_t bytes) {
    entries_.push_back({now, latency.count(), static_cast<double>(bytes)});
    while (entries_.size() > 1 && entries_.front().at + window < now) {
        entries_.pop_front();
    }
}

Rates Meter::rates(wire::Time now) const {
    if (entries_.empty()) {
        return {};
    }
    Rates rates;
    int fresh = 0;
    wire::Time first = now;
    double latency = 0, bytes = 0;
    for (const Entry& entry : entries_) {
        if (entry.at + window >= now) {
            first = fresh == 0 ? entry.at : first;
            ++fresh;
            latency += entry.latency;
            bytes += entry.bytes;
        }
    }
    if (fresh == 0) {
        return {0, entries_.back().latency, entries_.back().bytes};
    }
    rates.latency_seconds = latency / fresh;
    rates.bytes_per_frame = bytes / fresh;
    const double span = std::chrono::duration<double>(entries_.back().at - first).count();
    rates.frames_per_second = fresh > 1 && span > 0 ? (fresh - 1) / span : 0;
    return rates;
}

}  // namespace shearwater::model
