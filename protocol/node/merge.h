#pragma once
// One frame's windows from a junction's children, and the merging of them: the work a junction does on
// its pool.

#include <optional>
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
        volume::Box box;        // the child's
        wire::Message windows;  // a pb::Windows; without one where the child gave nothing
        bool present = false;
    };

    std::uint64_t frame = 0;
    view::Factorisation factorisation;
    std::vector<Part> parts;
    std::vector<Missing> missing;
};

struct Merged {
    std::uint64_t frame = 0;
    std::vector<image::Window> windows;  // at most one a face
    std::vector<Missing> missing;
    wire::pb::LeafStats stats;  // of all below, and this merge
};

// Merges in visibility order, front to back. The parts' windows have been through windows_from.
Merged merge(const MergeJob& job);

// Names the missing parts in a message.
void put(const std::vector<Missing>& missing, google::protobuf::RepeatedPtrField<wire::pb::Missing>& entries);

// What a junction sends up, or a leaf: windows, what they lack and what they cost.
wire::Message to_message(const Merged& merged);

}  // namespace shearwater::node
