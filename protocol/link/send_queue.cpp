#include "protocol/link/send_queue.h"

#include <algorithm>

namespace shearwater::link {
namespace {

Outgoing encoded(const wire::Message& message, std::uint16_t version) {
    return {wire::type_of(message.body), wire::encode_head(message, version), message.payload};
}

}  // namespace

bool SendQueue::push(const wire::Message& message, std::uint16_t version) {
    Outgoing outgoing = encoded(message, version);
    if (std::holds_alternative<wire::pb::SetView>(message.body) ||
        std::holds_alternative<wire::pb::Pong>(message.body)) {
        drop_older(outgoing.type);
    }
    const bool fits =
        waiting_.size() < max_messages_ && outgoing.size() <= max_bytes_ - std::min(bytes_, max_bytes_);
    if (!fits && !waiting_.empty()) {
        return false;
    }
    append(std::move(outgoing));
    return true;
}

void SendQueue::push_last(const wire::Message& message, std::uint16_t version) {
    append(encoded(message, version));
}

std::vector<Outgoing> SendQueue::pop() {
    constexpr std::size_t most_messages = 16;
    constexpr std::size_t small = std::size_t{1} << 16;  // bytes
    std::vector<Outgoing> batch;
    std::size_t large = 0;
    while (!waiting_.empty() && batch.size() < most_messages) {
        large += waiting_.front().size() > small ? 1U : 0U;
        if (large > 1) {
            break;
        }
        bytes_ -= waiting_.front().size();
        batch.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
    }
    return batch;
}

void SendQueue::clear() {
    waiting_.clear();
    bytes_ = 0;
}

void SendQueue::append(Outgoing outgoing) {
    bytes_ += outgoing.size();
    waiting_.push_back(std::move(outgoing));
}

void SendQueue::drop_older(std::uint16_t type) {
    const auto older = std::ranges::find(waiting_, type, &Outgoing::type);
    if (older != waiting_.end()) {
        bytes_ -= older->size();
        waiting_.erase(older);
    }
}

}  // namespace shearwater::link
