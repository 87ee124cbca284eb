#include "client/model/link_gauge.h"

#include <algorithm>
#include <cmath>

namespace shearwater::model {

namespace {

constexpr std::size_t most_passages = 8;

double pixels_of(const view::ImageSize& size) {
    return static_cast<double>(size.width) * size.height;
}

}  // namespace

void LinkGauge::count(const Carried& picture) {
    const double pixels = pixels_of(picture.size);
    const auto bytes = static_cast<double>(picture.bytes);
    // The peer's figure is its own affair: not a number counts as none.
    const double seconds = picture.coding.count() > 0 ? std::min(picture.coding.count(), 1.0) : 0;
    std::optional<Coding>& known = codings_[picture.deflated ? 1 : 0];
    if (!known) {
        known = Coding{bytes / pixels, seconds / pixels};
    } else {
        constexpr double newest = 0.3;
        known->bytes += newest * (bytes / pixels - known->bytes);
        known->seconds += newest * (seconds / pixels - known->seconds);
    }
    if (picture.bytes >= enough_to_tell && picture.arriving.count() > 0) {
        passages_.push_back({picture.bytes, picture.arriving});
        if (passages_.size() > most_passages) {
            passages_.pop_front();
        }
    }
}

std::optional<double> LinkGauge::speed() const {
    if (passages_.empty()) {
        return std::nullopt;
    }
    double bytes = 0;
    Seconds arriving{};
    for (const Passage& passage : passages_) {
        bytes += static_cast<double>(passage.bytes);
        arriving += passage.arriving;
    }
    return bytes / arriving.count();
}

LinkGauge::Seconds LinkGauge::cost(const Coding& coding, double pixels) const {
    return Seconds(pixels * (coding.bytes / *speed() + coding.seconds));
}

bool LinkGauge::wants_deflate(const view::ImageSize& size) {
    const auto& plain = coding(false);
    if (!speed() || !plain) {
        return deflate_;
    }
    const double pixels = pixels_of(size);
    if (pixels * plain->bytes / *speed() <= quick.count()) {
        deflate_ = false;
    } else if (const auto& deflated = coding(true)) {
        // What is stays, unless the other is better by more than chance.
        constexpr double clearly = 0.9;
        const Seconds now = cost(deflate_ ? *deflated : *plain, pixels);
        const Seconds other = cost(deflate_ ? *plain : *deflated, pixels);
        deflate_ = other < clearly * now ? !deflate_ : deflate_;
    } else {
        deflate_ = true;  // to see
    }
    return deflate_;
}

view::ImageSize LinkGauge::size_at_rate(const view::ImageSize& full, double frames_per_second) {
    const auto& used = coding(deflate_) ? coding(deflate_) : coding(!deflate_);
    if (!speed() || !used) {
        return full;
    }
    const double allowed = share / frames_per_second * *speed();  // bytes
    const double wanted =
        std::clamp(std::sqrt(allowed / std::max(1.0, used->bytes * pixels_of(full))), least_scale, 1.0);
    // Pictures of a size of their own each would flicker.
    constexpr double too_large = 0.93, too_small = 1.25;
    if (wanted < too_large * scale_ || wanted > too_small * scale_ || wanted >= 1) {
        scale_ = wanted;
    }
    if (scale_ >= 1) {
        return full;
    }
    constexpr int least_side = 16;
    const int width = std::max(least_side, static_cast<int>(std::lround(full.width * scale_)));
    const int height = std::max(
        least_side, static_cast<int>(std::lround(static_cast<double>(width) * full.height / full.width)));
    return {std::min(width, full.width), std::min(height, full.height)};
}

}  // namespace shearwater::model
