#include "renderer/jobs/link_source.h"

#include <bit>
#include <cstring>

namespace shearwater::jobs {

static_assert(std::endian::native == std::endian::little,
              "voxels travel little-endian and are taken as they come");

base::Status LinkSource::read(const volume::Box& box, std::span<float> out) {
    const std::string operation = "receive voxels " + volume::to_string(box);
    std::unique_lock lock(mutex_);
    answer_.reset();
    ask_(box);
    if (!arrived_.wait(lock, stop_, [this] { return answer_.has_value(); })) {
        return base::error(base::Code::cancelled, operation, "stopped");
    }
    const auto& body = std::get<wire::pb::Voxels>(answer_->body);
    if (!body.error().empty()) {
        return base::error(base::Code::io, operation, body.error());
    }
    if (answer_->payload_size() != out.size_bytes()) {
        return base::error(base::Code::corrupt, operation, "the answer is of another size");
    }
    std::memcpy(out.data(), answer_->payload->data(), out.size_bytes());
    answer_.reset();
    return {};
}

void LinkSource::deliver(wire::Message voxels) {
    {
        const std::lock_guard lock(mutex_);
        answer_ = std::move(voxels);
    }
    arrived_.notify_all();
}

}  // namespace shearwater::jobs
