#pragma once
// The server as a pure state machine: the root of the tree and its control plane. Daemons join and are
// given places; clients send views and are sent pictures, at most two of them on their way to each.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/volume/mapping.h"
#include "protocol/node/branch.h"
#include "protocol/node/merge.h"
#include "protocol/wire/convert.h"
#include "server/head/roster.h"

namespace shearwater::head {

// How values become codes: limits given, or cut from the histogram by percentile.
struct Limits {
    std::optional<volume::Limits> range;
    double percentile = 99.5;
    volume::Stretch stretch = volume::Stretch::linear;
    int bits = 8;
};

// ---- jobs carried out away from the network's thread ----

// Of a frame: all merges but the last, one by one; then
struct Lay {
    node::MergeJob merge;
};
// the last, the warp and the coding;
struct Finish {
    node::MergeJob merge;
    wire::View view;
    wire::Time asked;  // when the view arrived
};
// or an end without a picture.
struct GiveUp {
    std::uint64_t frame;
};
struct ReadVoxels {
    wire::pb::NeedVoxels need;  // of a box inside the cube
};
using Job = std::variant<Lay, Finish, GiveUp, ReadVoxels>;

struct Finished {
    std::uint64_t number;
    wire::Message frame;  // pb::Frame
};
struct VoxelsRead {
    wire::Message voxels;  // pb::Voxels
};
using JobEvent = std::variant<Finished, VoxelsRead>;

struct Effects {
    std::vector<wire::NetEffect> net;
    std::vector<Job> jobs;
};

class Head {
  public:
    static constexpr std::size_t frames_in_flight = 2;  // a client
    static constexpr std::size_t max_clients = 64;
    static_assert(frames_in_flight * max_clients < node::Branch::max_pending);

    Head(Roster roster, Limits limits);

    Effects handle(const wire::NetEvent& event, wire::Time now);
    Effects handle(JobEvent event, wire::Time now);

    const Roster& roster() const { return roster_; }
    const std::optional<volume::Mapping>& mapping() const { return mapping_; }
    // Every renderer has been ready or has failed once, and pictures are made.
    bool serving() const { return serving_; }
    std::size_t clients() const { return sessions_.size(); }

  private:
    struct Session {
        std::optional<wire::View> wanted;  // the newest not yet begun
        std::optional<wire::View> latest;  // the newest begun
        wire::Time asked{};
        std::vector<std::uint64_t> in_flight;  // numbers of frames begun and not yet shown
        bool incomplete = false;               // the newest picture lacked something
        wire::Time begun{};
    };
    struct FrameInWork {
        wire::LinkId client;
        wire::View view;
        wire::Time asked;
        bool begun = false;   // some of it is laid
        bool merged = false;  // it is being finished: only the warp is to come
    };

    void on_link_up(const wire::LinkUp& up, Effects& effects);
    void on_received(const wire::Received& received, wire::Time now, Effects& effects);
    void on_link_down(wire::LinkId link, Effects& effects);
    void on_tick(wire::Time now, Effects& effects);

    void on_join(wire::LinkId link, const wire::pb::Join& join, Effects& effects);
    void on_report(wire::LinkId link, const wire::pb::Report& report, Effects& effects);
    void on_client_message(Session& session, const wire::Received& received, wire::Time now,
                           Effects& effects);
    void give_orders(tree::Place place, Effects& effects) const;

    void tell_state(Effects& effects);
    void settle_mapping(Effects& effects);
    void describe_cube(wire::LinkId client, Effects& effects) const;
    void give_up_refinements(wire::LinkId client, Session& session, Effects& effects);
    void give_up(std::uint64_t number, const FrameInWork& frame, Effects& effects);
    void begin_frames(wire::LinkId client, Session& session, wire::Time now, Effects& effects);
    void collect(Effects& effects);
    static void fault(wire::LinkId link, const wire::Fault& fault, Effects& effects);

    Roster roster_;
    Limits limits_;
    node::Branch branch_;
    std::optional<volume::Mapping> mapping_;
    bool serving_ = false;
    std::map<wire::LinkId, wire::LinkUp> joining_;  // daemons' control links that have not yet joined
    std::map<wire::LinkId, Session> sessions_;
    std::map<std::uint64_t, FrameInWork> frames_;
    std::uint64_t last_frame_ = 0;
    wire::Time last_state_{};
};

}  // namespace shearwater::head
