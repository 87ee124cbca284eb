#pragma once
// The server as a pure state machine: the root of the tree and its control plane. Daemons join and are
// given places; clients send views and are sent pictures, at most two of them on their way to each.
//
//   all have a sketch -> a client that welcomes them is sent pictures of it -> all are ready -> and now,
//   unasked, the cube's picture of what it looks at

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/volume/mapping.h"
#include "protocol/node/branch.h"
#include "protocol/node/lookout.h"
#include "protocol/node/merge.h"
#include "protocol/wire/convert.h"
#include "server/head/functions.h"
#include "server/head/picks.h"
#include "server/head/roster.h"
#include "server/head/sharing.h"

namespace shearwater::head {

// Who finds out what is visible: the server; or its renderers, each for a part of the picture, once they have
// the functions of all blocks. Automatic: those, where they are on other machines and there are many blocks.
enum class Deciding { automatic, by_server, by_renderers };

// How values become codes, by limits given or cut from the histogram by percentile; and what else a server's
// owner decides.
struct Limits {
    std::optional<volume::Limits> range;
    double percentile = 99.5;
    volume::Stretch stretch = volume::Stretch::linear;
    int bits = 8;
    bool level_of_detail = true;  // for clients that do not say
    Deciding deciding = Deciding::automatic;
};

// ---- jobs carried out away from the network's thread ----

// A frame is one picture or two eyes', which are drawn, merged and warped as frames of their own: the first
// has the frame's number, the second the next. Of each, all merges, one by one, with as much of the warp as
// each allows; then
struct Lay {
    node::MergeJob merge;
    std::shared_ptr<const wire::View> view;
    view::Camera camera;  // the eye's
};
// once all are laid, the coding of all;
struct Finish {
    std::uint64_t frame;
    std::size_t eyes;
    std::shared_ptr<const wire::View> view;
    wire::Time asked;         // when the view arrived
    bool sketch = false;      // it is of the sketch
    double look_seconds = 0;  // until it was known what is visible
    int lookers = 0;          // renderers that found it out; 0: the server did, if anybody
};
// or, of each that was begun, an end without a picture.
struct GiveUp {
    std::uint64_t frame;
};
// What an eye's rays may see is looked at before it is asked for (node::Look, by its number), by what
// renderers have told of their blocks (node::Learn, node::Forget); and they are given that of all blocks, for
// those to look who are asked to.
struct Give {
    std::uint64_t request;
    culling::FunctionKey key;
    std::uint64_t number;
    int first_direction;
};
struct ReadVoxels {
    wire::pb::NeedVoxels need;  // of a box inside the cube
};
// The cube's value at a point of it, in voxels, for a pick.
struct Measure {
    std::uint64_t number;
    volume::Index3 n{};  // of the cube
    view::Vec3 at;
};
using Job =
    std::variant<Lay, Finish, GiveUp, node::Look, node::Learn, node::Forget, Give, ReadVoxels, Measure>;

struct Finished {
    std::uint64_t number;
    wire::Message frame;  // pb::Frame
};
struct Given {
    std::uint64_t request;
    std::optional<wire::Message> functions;  // pb::GiveFunctions; none where there are no such any more
};
struct VoxelsRead {
    wire::Message voxels;  // pb::Voxels
};
struct Measured {
    std::uint64_t number;
    double value;  // not a number where there is none, or it cannot be read
};
using JobEvent = std::variant<Finished, node::Looked, Given, VoxelsRead, Measured>;

struct Effects {
    std::vector<wire::NetEffect> net;
    std::vector<Job> jobs;
};

class Head {
  public:
    static constexpr std::size_t frames_in_flight = 2;  // a client
    static constexpr std::size_t max_clients = 64;
    static constexpr std::size_t max_eyes = 2;
    // Of so many blocks and more it pays to share (Deciding::automatic).
    static constexpr std::size_t many_blocks = std::size_t{1} << 15;
    static_assert(frames_in_flight * max_eyes * max_clients < node::Branch::max_pending);

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
        std::vector<std::uint64_t> in_flight;    // numbers of frames begun and not yet shown
        bool incomplete = false;                 // the newest picture lacked something
        bool sketched = false;                   // the newest view begun is drawn from the sketch
        std::optional<volume::Scaling> scaling;  // that the newest view had
        wire::Time begun{};
    };
    struct Eye {
        view::Camera camera;
        bool begun = false;   // some of it is laid
        bool merged = false;  // all of it is, or is being
        // What is asked for once it is known what is visible.
        std::optional<wire::pb::Render> render = {};
        view::Factorisation factorisation = {};
        wire::Time look_begun = {};
        double look_seconds = 0;
        int lookers = 0;
    };
    struct FrameInWork {
        wire::LinkId client;
        std::shared_ptr<const wire::View> view;
        wire::Time asked;
        bool sketch = false;  // it is drawn from the sketch
        std::vector<Eye> eyes;

        bool merged() const;  // it is being finished: the last of the warp is to come
        Finish finish(std::uint64_t number) const;
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
    void settle_sketch(wire::Time now, Effects& effects);
    void settle_mapping(Effects& effects);
    void on_scaling(Session& session, const std::optional<volume::Scaling>& scaling, wire::Time now,
                    Effects& effects);
    void remap(const volume::Mapping& mapping, wire::Time now, Effects& effects);
    void tell_mapping(bool anew, Effects& effects);
    volume::Mapping mapping_from(const volume::Histogram& histogram) const;
    std::optional<volume::Mapping> own_mapping() const;  // as the limits say; unset until it can be known
    void describe_cube(wire::LinkId client, Effects& effects) const;
    void tell_cube(Effects& effects) const;  // all clients
    void give_up_frames(Session& session, const std::function<bool(const FrameInWork&)>& which,
                        Effects& effects);
    void give_up_refinements(wire::LinkId client, Session& session, Effects& effects);
    // The mapping to draw the sketch by, where that is what a view is drawn from now.
    std::optional<volume::Mapping> sketch_for(const wire::View& view) const;
    void begin_serving(wire::Time now, Effects& effects);
    void give_up(std::uint64_t number, const FrameInWork& frame, Effects& effects);
    std::pair<FrameInWork*, Eye*> find_eye(std::uint64_t number);
    void on_finished(Finished finished, wire::Time now, Effects& effects);
    void begin_frames(wire::LinkId client, Session& session, wire::Time now, Effects& effects);
    std::vector<view::Factorisation> factorise(const wire::View& view,
                                               const std::vector<view::Camera>& cameras, bool sketch) const;
    void begin_eyes(std::uint64_t number, FrameInWork& frame, const std::optional<volume::Mapping>& sketch,
                    wire::Time now, Effects& effects);
    // The functions that a view's frame goes by, where what is hidden is to be left out and something is
    // known of that.
    std::optional<Functions::Needed> needed_functions(wire::LinkId client, const wire::View& view, int level);
    bool shares_looking() const;
    void begin_look(std::uint64_t number, const wire::View& view, Eye& eye, const Functions::Needed& needed,
                    wire::Time now, Effects& effects);
    void on_looked(std::uint64_t number, const culling::VisibleBlocks& visible, wire::Time now,
                   Effects& effects);
    void settle_replies(wire::Time now, Effects& effects);
    void on_given(Given given, wire::Time now, Effects& effects);
    void settle_functions(wire::Time now, Effects& effects);
    wire::Parsed<view::Factorisation> ray_of(const wire::PickRequest& pick) const;
    void on_pick(wire::LinkId client, const wire::pb::Pick& pick, wire::Time now, Effects& effects);
    void forget_picks(wire::LinkId client);
    void settle_picks(Effects& effects);
    void on_measured(const Measured& measured, Effects& effects);
    void collect(wire::Time now, Effects& effects);
    static void fault(wire::LinkId link, const wire::Fault& fault, Effects& effects);

    Roster roster_;
    Limits limits_;
    node::Branch branch_;
    Functions functions_;
    Sharing sharing_;
    Picks picks_;
    std::optional<volume::Mapping> mapping_;
    bool asked_for_ = false;                        // mapping_, by a client
    std::optional<volume::Mapping> sketch_;         // set once all have one: by its own limits
    std::optional<wire::pb::ValueSummary> values_;  // of the sketch's voxels, until all are counted
    bool serving_ = false;
    std::map<wire::LinkId, wire::LinkUp> joining_;  // daemons' control links that have not yet joined
    std::map<wire::LinkId, Session> sessions_;
    std::map<std::uint64_t, FrameInWork> frames_;
    std::uint64_t last_frame_ = 0;
    wire::Time last_state_{};
};

}  // namespace shearwater::head
