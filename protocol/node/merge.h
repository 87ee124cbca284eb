#pragma once
// One frame's windows from a junction's children, and the merging of them: the work a junction does on
// its pool.

#include <vector>

#include "common/image/image.h"
#include "common/view/factorisation.h"
#include "common/volume/box.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/message.h"

namespace shearwater::node {

// A part of the cube that a frame lacks.
struct Missing {
    int place;
    volume::Box box;
    bool operator==(const Missing&) const = default;
};

struct MergeJob {
    struct Part {
        volume::Box box;                         // the child's
        std::vector<image::SpanWindow> windows;  // viewing the payload
        wire::Payload payload;
        wire::pb::LeafStats stats;
        bool present = false;  // otherwise the child gave nothing
    };

    std::uint64_t frame = 0;
    view::Factorisation factorisation;
    std::vector<Part> parts;
    std::vector<Missing> missing;

    std::size_t bytes() const;  // that the parts came in
};

struct Merged {
    std::uint64_t frame = 0;
    std::vector<image::Window> windows;  // at most one a face
    std::vector<Missing> missing;
    wire::pb::LeafStats stats;  // of all below, and this merge
};

// Merges in visibility order, front to back: at the head into pixels to warp, at a junction into what it
// sends up.
Merged merge(const MergeJob& job);
wire::Message merge_coded(const MergeJob& job);

// Names the missing parts in a message.
void put(const std::vector<Missing>& missing, google::protobuf::RepeatedPtrField<wire::pb::Missing>& entries);

// What a leaf sends up: windows, what they lack and what they cost, coding them included.
wire::Message to_message(const Merged& drawn);

}  // namespace shearwater::node
