#pragma once
// A whole tree in one process on a clock of its own: the daemons' state machines as they are, links that
// are queues, jobs done on the spot. What happens next is drawn by a seed, so that a run can be had again.

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "common/base/workers.h"
#include "common/tree/plan.h"
#include "common/volume/source.h"
#include "compositor/junction/junction.h"
#include "protocol/node/lookout.h"
#include "protocol/wire/convert_pick.h"
#include "renderer/leaf/leaf.h"
#include "renderer/shear/brick_volume.h"
#include "server/head/head.h"
#include "server/head/pictures.h"

namespace shearwater::support {

// Carries messages between nodes in the order of each link, links in any order.
class Fabric {
  public:
    using Deliver = std::function<void(const wire::NetEvent&)>;

    explicit Fabric(std::uint64_t seed) : random_(seed) {}

    // A node listens on the port that is its number. Gone: its links break, what was on its way to it is
    // lost.
    void add(int node, Deliver deliver);
    void remove(int node);
    void perform(int node, std::vector<wire::NetEffect> effects);
    // Puts work for a node among what may happen next; lost when the node goes.
    void later(int node, std::function<void()> work);

    // One thing happens; false when nothing can.
    bool step();
    void pass_time(std::chrono::milliseconds time);  // and a tick at every node
    wire::Time now() const { return now_; }
    std::mt19937_64& random() { return random_; }

  private:
    struct End {
        int node;
        wire::LinkId id;
        auto operator<=>(const End&) const = default;
    };
    struct Node {
        Deliver deliver;
        std::deque<std::function<void()>> work;
    };

    void dial(int node, const wire::Dial& dial);
    void close(const End& end, wire::pb::Reason reason, const std::string& text);

    std::mt19937_64 random_;
    wire::Time now_{};
    std::uint64_t accepted_ = wire::first_accepted;
    std::map<int, Node> nodes_;
    std::map<End, End> peers_;
    std::map<End, std::deque<wire::NetEvent>> inbox_;  // by the receiving end
};

// A server, its compositors and renderers, and one client that asks for one view over and over.
class Simulation {
  public:
    // A sketch of a level above 0 is made where the source is concurrent.
    Simulation(std::uint64_t seed, const tree::Topology& topology, const volume::Index3& n,
               volume::VoxelSource& source, int sketch_level = 0,
               head::Deciding deciding = head::Deciding::automatic);
    ~Simulation();

    void start_daemon(tree::Place place);
    void kill_daemon(tree::Place place);
    bool running(tree::Place place) const { return daemons_.contains(place); }

    // Lets things happen until nothing does or `holds`; time passes in between, at most for `patience`.
    bool run_until(const std::function<bool()>& holds,
                   std::chrono::seconds patience = std::chrono::seconds(300));
    void run_some(int steps);

    std::uint64_t ask(const wire::View& view);
    void pick(const wire::PickRequest& wanted);
    // The answers to picks that have come, the newest last.
    const std::vector<wire::PickAnswer>& picked() const { return picked_; }
    const std::optional<wire::Message>& newest_frame() const { return frame_; }
    // The newest of a sketch, and how many of any kind have come.
    const std::optional<wire::Message>& newest_sketch() const { return sketch_; }
    int frames() const { return frames_; }
    bool answered(std::uint64_t revision) const;
    bool answered_whole(std::uint64_t revision) const;

    // How often the head has looked so far what a picture shows, and a renderer what a part of it does.
    int head_looks() const { return head_looks_; }
    int renderer_looks() const { return renderer_looks_; }
    // How many functions renderers have been asked to find so far.
    int finds() const { return finds_; }
    // That renderers have left out of frames so far.
    std::uint64_t culled_bricks() const { return culled_bricks_; }

    head::Head& head() { return head_; }
    // Frames that the head has begun to lay and neither finished nor given up.
    std::size_t pictures() const { return pictures_.size(); }
    Fabric& fabric() { return fabric_; }
    const tree::Plan& plan() const { return head_.roster().plan(); }

  private:
    struct Daemon;
    struct Renderer;
    struct Compositor;

    void perform(head::Effects effects);
    void finish(const head::Finish& job);
    void on_client_event(const wire::NetEvent& event);

    static constexpr int server_node = 0;
    static constexpr int client_node = 1000;

    Fabric fabric_;
    volume::VoxelSource& source_;
    base::Workers workers_{1};
    head::Head head_;
    head::Pictures pictures_;
    node::Lookout lookout_;
    std::map<tree::Place, std::unique_ptr<Daemon>> daemons_;
    std::uint64_t revision_ = 0;
    std::optional<wire::Message> frame_, sketch_;
    int frames_ = 0;
    std::uint64_t culled_bricks_ = 0;
    std::vector<wire::PickAnswer> picked_;
    int finds_ = 0, head_looks_ = 0, renderer_looks_ = 0;
};

}  // namespace shearwater::support
