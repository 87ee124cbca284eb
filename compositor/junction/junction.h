#pragma once
// The compositor daemon as a pure state machine: it takes its place, adopts its children, passes requests
// down and merged windows up.

#include <deque>
#include <string>
#include <vector>

#include "protocol/node/branch.h"
#include "protocol/node/member.h"
#include "protocol/node/merge.h"
#include "protocol/wire/events.h"

namespace shearwater::junction {

// The one job a junction has: node::merge_coded, away from the network's thread if it takes long.
struct Merge {
    node::MergeJob job;
};

struct Memory {
    std::uint64_t resident = 0;
    std::uint64_t peak = 0;
};
struct MergeDone {
    wire::Message windows;  // what came of it
};

struct Effects {
    std::vector<wire::NetEffect> net;
    std::vector<Merge> merges;
};

class Junction {
  public:
    explicit Junction(node::MemberOptions options) : member_(std::move(options)) {}

    Effects start();
    Effects handle(const wire::NetEvent& event, wire::Time now);
    Effects handle(MergeDone done);
    void handle(const Memory& memory) { memory_ = memory; }

    const std::string& refusal() const { return member_.refusal(); }

  private:
    void on_assigned(Effects& effects);
    void on_parent_message(const wire::Received& received, wire::Time now, Effects& effects);
    void on_child_message(const wire::Received& received, Effects& effects);
    void send_histogram(node::Branch::Counted counted, Effects& effects);
    void report(Effects& effects);

    node::Member member_;
    node::Branch branch_;
    Memory memory_;
    wire::Time last_report_{};
};

}  // namespace shearwater::junction
