#include "protocol/wire/message.h"

namespace shearwater::wire {

std::string_view name(const Body& body) {
    return std::visit([](const auto& b) -> std::string_view { return b.GetDescriptor()->name(); }, body);
}

std::string_view text_of(pb::Reason reason) {
    switch (reason) {
        case pb::REASON_NONE:
            return "no reason given";
        case pb::REASON_SHUTDOWN:
            return "the other side is shutting down";
        case pb::REASON_BAD_MAGIC:
            return "the other side does not speak this protocol";
        case pb::REASON_BAD_VERSION:
            return "the two sides have no protocol version in common";
        case pb::REASON_BAD_SECRET:
            return "the two sides do not share the same secret";
        case pb::REASON_BAD_TYPE:
            return "a message that has no place on this link";
        case pb::REASON_TOO_LARGE:
            return "a message beyond its limit of size";
        case pb::REASON_MALFORMED:
            return "a broken message";
        case pb::REASON_INVALID:
            return "a message with a value out of range";
        case pb::REASON_TIMED_OUT:
            return "the other side has gone silent";
        case pb::REASON_STALLED:
            return "the other side does not take what it is sent";
        case pb::REASON_QUEUE_FULL:
            return "the other side is too slow, too much is waiting for it";
        case pb::REASON_TOO_MANY_LINKS:
            return "the other side has no room for another link";
        case pb::REASON_NO_PLACE:
            return "the tree has no vacant place for it";
        case pb::REASON_REPLACED:
            return "another link took its place";
        case pb::REASON_LOST:
            return "the connection broke";
        case pb::REASON_UNREACHABLE:
            return "no connection could be made";
        default:
            return "an unknown reason";
    }
}

}  // namespace shearwater::wire
