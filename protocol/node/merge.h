#pragma once
// One band's windows from a junction's children, and the merging of them: the work a junction does on its
// pool.

#include <memory>
#include <vector>

#include "common/image/canvas.h"
#include "common/view/bands.h"
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

// What is said of a frame with its last band.
struct Account {
    std::vector<Missing> missing;
    wire::pb::LeafStats stats;  // of all below
};

// What all of a frame's merges share. They are done one after another, and add up what they take.
struct MergedFrame {
    std::uint64_t number = 0;
    view::Factorisation factorisation;
    std::vector<view::Band> bands;
    double seconds = 0;
};

// The bands [first, end) of a frame, of which only the last has anything.
struct MergeJob {
    std::shared_ptr<MergedFrame> frame;
    std::size_t first = 0, end = 0;
    std::vector<image::SpanWindow> windows;  // front to back
    std::vector<wire::Payload> payloads;     // that they view
    Account account;                         // of the last job

    bool last() const { return end == frame->bands.size(); }
    std::size_t bytes() const;  // that the windows came in
};

// Merges front to back: at the head into pixels to warp, at a junction into what it sends up. The last one's
// account is that of the frame with its merges here.
void merge_into(image::Canvas& canvas, MergeJob& job);
wire::Message merge_coded(MergeJob& job);

// What is missing, and both of an account, into a message.
void put(const std::vector<Missing>& missing, google::protobuf::RepeatedPtrField<wire::pb::Missing>& entries);
void put(const Account& account, wire::pb::Windows& body);
// A child's account added to that of the frame. The slowest path counts for time, every node for work.
void add(const wire::pb::LeafStats& part, wire::pb::LeafStats& sum);

}  // namespace shearwater::node
