#pragma once
// The renderer daemon as a pure state machine: events of the network and of its own jobs in, effects out.
//
//   assigned -> counting -> waiting (for the limits) -> loading -> ready
//
// With the limits already known, counting and waiting are left out. The first pass over the voxels, whichever
// it is, begins with a sketch where the server wants one and it can be had: from then on that can be drawn,
// until the cube is. Rendering is one job at a time, in the order asked for.

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "common/base/result.h"
#include "common/culling/function_store.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "common/volume/histogram.h"
#include "common/volume/mapping.h"
#include "protocol/node/lookout.h"
#include "protocol/node/member.h"
#include "protocol/wire/convert_look.h"
#include "protocol/wire/convert_pick.h"
#include "protocol/wire/events.h"
#include "renderer/leaf/given_functions.h"

namespace shearwater::leaf {

// What the leaf holds: which voxels of which cube.
struct Share {
    std::string path;
    int hdu = 0;
    std::int64_t plane = 0;
    view::Lattice lattice;
    volume::Box box;
    int place = 0;
    int copies = 1;  // of its codes to keep
};

// ---- jobs the daemon carries out away from the network's thread, and what comes of them ----
// A job has a number; what a cancelled job still says is ignored.
using Job = std::uint64_t;

struct Count {
    Job job;
    Share share;
    int sketch_level = 0;  // of the sketch to begin with, which is kept; 0: none
};
struct Load {
    Job job;
    Share share;
    volume::Mapping mapping;
    int sketch_level = 0;  // as for Count
    bool count = false;    // values too, on their way: they were not counted before
};
// Goes on beside counting and loading. Drawing the cube lets go of the sketch.
struct Draw {
    Job job;
    std::uint64_t frame;
    view::Factorisation factorisation;
    view::TransferFunction tf;
    std::optional<volume::Mapping> sketch;          // draw the sketch, by these limits
    std::optional<culling::VisibleBlocks> visible;  // else all are
};
// Goes on beside all others, in the background. First coarse functions are told, then
// all.
struct Find {
    Job job;
    culling::FunctionKey key;
    std::int64_t block_edge;
    int side;  // of the direction grid
};
// Goes on beside all others.
struct SampleRay {
    Job job;
    std::uint64_t number;
    view::Factorisation ray;
    view::TransferFunction tf;
};
// Of functions of all of the cube's blocks, and by them; one after the other, and beside all others.
struct Learn {
    Job job;
    node::Learn learn;
};
struct Look {
    Job job;
    node::Look look;
};
struct Stop {  // whatever of this job still runs
    Job job;
};
struct HandVoxels {  // an answer to a VoxelsWanted
    Job job;
    wire::Message voxels;
};
using Effect = std::variant<Count, Load, Draw, Find, SampleRay, Learn, node::Forget, Look, Stop, HandVoxels>;

struct Advanced {
    Job job;
    double fraction;
};
struct Sketched {  // the job goes on
    Job job;
    volume::Histogram histogram;  // of the sketch's voxels
};
struct Counted {
    Job job;
    base::Result<volume::Histogram> histogram;
};
struct Loaded {
    Job job;
    base::Status status;
    std::optional<volume::Histogram> histogram = {};  // where it was to count
};
struct Drawn {  // some of the frame's bands
    Job job;
    wire::Message windows;  // pb::Windows
    bool last;              // the frame is done
};
struct Found {  // of all blocks that it has a part of
    Job job;
    culling::FunctionTable table;
    bool coarse;  // the job goes on
};
struct RaySampled {
    Job job;
    wire::RayPart part;
};
struct Learned {
    Job job;
};
struct Looked {
    Job job;
    node::Looked looked;
};
// A job that cannot see the cube's file asks for a part of it over the tree, one at a time.
struct VoxelsWanted {
    Job job;
    volume::Box box;
};
struct Memory {
    std::uint64_t resident;
    std::uint64_t peak;
};
using JobEvent = std::variant<Advanced, Sketched, Counted, Loaded, Drawn, Found, RaySampled, Learned, Looked,
                              VoxelsWanted, Memory>;

struct Effects {
    std::vector<wire::NetEffect> net;
    std::vector<Effect> jobs;
};

class Leaf {
  public:
    static constexpr std::size_t max_waiting = 64;     // frames; the oldest beyond are dropped
    static constexpr std::size_t most_sampling = 64;   // rays; those beyond are answered with nothing
    static constexpr std::size_t most_replying = 512;  // requests to all leaves; likewise

    explicit Leaf(node::MemberOptions options) : member_(std::move(options)) {}

    Effects start();
    Effects handle(const wire::NetEvent& event, wire::Time now);
    Effects handle(JobEvent event, wire::Time now);

    wire::pb::Phase phase() const { return phase_; }
    const std::string& error() const { return error_; }
    const std::string& refusal() const { return member_.refusal(); }

  private:
    struct Waiting {
        std::uint64_t frame;
        view::Factorisation factorisation;
        view::TransferFunction tf;
        std::optional<volume::Mapping> sketch;
        std::optional<culling::VisibleBlocks> visible;
    };
    struct WantedFunctions {
        std::uint64_t number;
        culling::FunctionKey key;
    };

    void on_assigned(Effects& effects);
    void on_parent_up(Effects& effects);
    void on_parent_down(Effects& effects);
    void on_parent_message(const wire::Received& received, Effects& effects);
    void on_render(wire::LinkId link, const wire::pb::Render& render, Effects& effects);
    void on_want_functions(wire::LinkId link, const wire::pb::WantFunctions& want, Effects& effects);
    void on_found(const Found& found, Effects& effects);
    void on_probe(wire::LinkId link, const wire::pb::Probe& probe, Effects& effects);
    void on_sampled(const RaySampled& sampled, Effects& effects);
    void on_give_functions(wire::LinkId link, const wire::Message& message, Effects& effects);
    void on_look(wire::LinkId link, const wire::pb::Look& look, Effects& effects);
    void on_looked(const Looked& looked, Effects& effects);
    void on_cancel(std::uint64_t frame, Effects& effects);
    void on_mapping(wire::LinkId link, const wire::pb::SetMapping& wanted, Effects& effects);

    void advance(Effects& effects);  // begins whatever the state calls for
    void begin_count(Effects& effects);
    void begin_load(Effects& effects);
    void stop_loading(Effects& effects);
    void find_next(Effects& effects);
    void stop_finding(Effects& effects);
    void forget_functions(Effects& effects);  // found and given
    void keep_given(std::span<const std::uint64_t> numbers, Effects& effects);
    std::optional<Job> begin_reply(std::uint64_t request);
    void reply(Job job, std::string visible, Effects& effects);
    void send_reply(const wire::Reply& reply, Effects& effects) const;
    int sketch_to_make() const { return sketched_ ? 0 : sketch_level_; }
    bool can_draw(const Waiting& wanted) const;
    void give_up_frames(Effects& effects);
    void draw_next(Effects& effects);
    // Of a frame of so many bands.
    void send_absent(std::uint64_t frame, std::size_t bands, Effects& effects) const;
    void send_histogram(const std::optional<volume::Histogram>& histogram, bool of_sketch, Effects& effects);
    void ask_for_voxels(Effects& effects) const;
    void enter(wire::pb::Phase phase, Effects& effects);
    void fail(const base::Error& error, Effects& effects);
    void report(Effects& effects) const;

    node::Member member_;
    std::optional<Share> share_;
    std::optional<wire::pb::Assign> work_;           // what share_ was made from
    std::optional<volume::Mapping> mapping_;         // wanted
    std::optional<volume::Mapping> load_mapping_;    // that load_job_ loads with; unset: it counts
    std::optional<volume::Mapping> loaded_mapping_;  // that the bricks are made with
    std::optional<volume::Histogram> histogram_;
    int sketch_level_ = 0;                       // wanted
    std::optional<volume::Histogram> sketched_;  // set: the sketch is there, with these values
    wire::pb::Phase phase_ = wire::pb::PHASE_JOINED;
    double fraction_ = 0;
    std::string error_;
    Memory memory_{};
    Job last_job_ = 0;
    Job load_job_ = 0;  // counting or loading; 0: none
    Job draw_job_ = 0;
    std::uint64_t drawing_ = 0;  // the frame of draw_job_
    std::size_t drawing_bands_ = 0;
    std::deque<Waiting> waiting_;
    std::optional<VoxelsWanted> wanted_;
    std::uint64_t request_ = 0;  // of wanted_
    // Functions that are to be found, the most wanted first; those that have been told since the parent came
    // up.
    std::vector<WantedFunctions> functions_;
    std::int64_t block_edge_ = 0;
    int side_ = 0;
    std::set<std::uint64_t> told_;
    std::uint64_t renewal_ = 0;
    Job find_job_ = 0;
    std::uint64_t finding_ = 0;  // number of find_job_
    std::set<Job> sampling_;
    GivenFunctions given_;
    std::map<Job, std::uint64_t> replying_;  // requests
    wire::Time last_report_{};
};

}  // namespace shearwater::leaf
