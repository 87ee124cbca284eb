#pragma once
// A message in memory: one of the schema's bodies and, for some, a raw payload.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <variant>

#include "common/base/buffer.h"
#include "common/base/result.h"
#include "protocol/wire/shearwater.pb.h"

namespace shearwater::wire {

// The order fixes the variant only; numbers on the wire are in header.cpp.
using Body = std::variant<pb::Challenge, pb::Hello, pb::Welcome, pb::Goodbye, pb::Ping, pb::Pong,  //
                          pb::Join, pb::Assign, pb::Report,                                        //
                          pb::Adopt, pb::HistogramReport, pb::SetMapping, pb::NeedVoxels, pb::Voxels,
                          pb::Render, pb::Cancel, pb::Windows, pb::WantFunctions, pb::Functions,       //
                          pb::CubeDescription, pb::TreeState, pb::SetView, pb::Frame, pb::FrameShown,  //
                          pb::Pick, pb::Picked, pb::Probe, pb::Probed,                                 //
                          pb::GiveFunctions, pb::Look, pb::Replied>;

// Shared, never changed: a junction passes on what it received without a copy.
using Payload = std::shared_ptr<const base::Buffer>;

struct Message {
    Body body;
    Payload payload;  // null: none

    std::size_t payload_size() const { return payload ? payload->size() : 0; }
};

template <class T>
Message message(T body, base::Buffer payload = {}) {
    Message m{std::move(body), nullptr};
    if (!payload.empty()) {
        m.payload = std::make_shared<const base::Buffer>(std::move(payload));
    }
    return m;
}
template <class T>
Message message(T body, std::span<const std::byte> payload) {
    return message(std::move(body), base::Buffer(payload.begin(), payload.end()));
}

// The body's name as the schema spells it.
std::string_view name(const Body& body);

// Why a link ended, in words for people: "the peer does not know the secret".
std::string_view text_of(pb::Reason reason);

}  // namespace shearwater::wire
