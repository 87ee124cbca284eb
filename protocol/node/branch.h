#pragma once
// What every node with children does, the server as much as a compositor: it knows its children's links,
// passes requests down, gathers their windows band by band, their histograms, and routes voxels.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/view/factorisation.h"
#include "common/volume/histogram.h"
#include "protocol/node/merge.h"
#include "protocol/node/probes.h"
#include "protocol/wire/convert_look.h"
#include "protocol/wire/events.h"

namespace shearwater::node {

class Branch {
  public:
    static constexpr std::size_t max_pending = 512;       // frames; more are cut short, oldest first
    static constexpr std::chrono::seconds patience{120};  // for a child's windows of one frame
    static constexpr std::chrono::seconds reply_patience{5};

    struct ChildSpec {
        int place;
        volume::Box box;
        volume::Box reads = box;  // of which its leaves may ask for voxels
        bool operator==(const ChildSpec&) const = default;
    };

    // Replaces the children. Links of places that stay are kept, the others closed.
    void configure(std::uint64_t epoch, const std::vector<ChildSpec>& children,
                   std::vector<wire::NetEffect>& effects);

    // An Adopt that fits: the link is the child's from now on, an older one is closed. Otherwise the link
    // is closed with a reason. Returns the child's place, or -1.
    int adopt(wire::LinkId link, const wire::pb::Adopt& adopt, std::vector<wire::NetEffect>& effects);
    bool is_child(wire::LinkId link) const { return child_of(link) != nullptr; }

    // Passes a frame down. What has no link is missing from the start.
    void begin(const view::Factorisation& factorisation, const wire::pb::Render& render, wire::Time now,
               std::vector<wire::NetEffect>& effects);
    void cancel(std::uint64_t frame, std::vector<wire::NetEffect>& effects);
    void cancel_all(std::vector<wire::NetEffect>& effects);
    bool pending(std::uint64_t frame) const { return pending_.contains(frame); }

    // Passes a ray on to the children that it may meet.
    void probe(const view::Factorisation& ray, const wire::pb::Probe& probe, wire::Time now,
               std::vector<wire::NetEffect>& effects);
    void forget_probe(std::uint64_t number) { probes_.forget(number); }
    // Rays of which every child has given its part or will not.
    std::vector<wire::RayPart> take_probed() { return probes_.take_complete(); }

    // Asks all children what they are to do together.
    void ask(std::uint64_t request, const wire::Message& question, wire::Time now,
             std::vector<wire::NetEffect>& effects);
    // Of requests that every child has replied to or will not.
    std::vector<wire::Reply> take_replies() { return replies_.take_complete(); }

    // A child's Windows, HistogramReport, Functions, Probed, Replied, NeedVoxels. Returns a request for
    // voxels that must go on up (or be served here), if that is what it was. A faulty message closes the
    // child's link.
    std::optional<wire::pb::NeedVoxels> receive(wire::LinkId link, const wire::Message& message,
                                                std::vector<wire::NetEffect>& effects);
    // Forgets the link; its child's share of pending frames is missing.
    void link_down(wire::LinkId link);
    void tick(wire::Time now);

    // Bands that every child has given or will not give, frame by frame in their order. A frame's last says
    // what it lacks.
    std::vector<MergeJob> take_complete();

    // What children count: all of their voxels, or, before, those of their sketches.
    enum class Counted { voxels, sketches };
    // The sum over all children, once each has reported.
    std::optional<volume::Histogram> histogram(Counted counted) const;
    // Whether the sum changed since this was last asked.
    bool take_histogram_news(Counted counted);

    // Sketches are made anew: those counted so far are of no account.
    void forget_sketches();

    // Passes a message down to every child, or voxels to the child that asked for them.
    void tell_children(const wire::Message& message, std::vector<wire::NetEffect>& effects) const;
    // What functions are wanted: of every child, and of whoever takes its place.
    void want_functions(const wire::Message& wanted, std::vector<wire::NetEffect>& effects);
    // Those that have come since: pb::Functions, sound.
    std::vector<wire::Message> take_functions() { return std::exchange(functions_, {}); }
    void deliver_voxels(const wire::Message& voxels, std::vector<wire::NetEffect>& effects);
    // What children have asked for and not been given: to be asked again of another parent, or of one that
    // was not there yet.
    std::vector<wire::pb::NeedVoxels> unanswered() const;

  private:
    struct Child {
        ChildSpec spec;
        std::optional<wire::LinkId> link;
        std::array<std::optional<volume::Histogram>, 2> histograms;  // by Counted
    };
    // A window that waits for the other children's of its band.
    struct Waiting {
        image::SpanWindow window;
        wire::Payload payload;  // that it views
    };
    // What a child has given of a frame.
    struct Part {
        std::size_t known = 0;                   // bands
        std::map<std::size_t, Waiting> windows;  // by band
        bool given_up = false;
    };
    struct Pending {
        std::shared_ptr<MergedFrame> frame;
        std::vector<int> order;   // of the children, front to back
        std::vector<Part> parts;  // one a child
        Account account;
        std::set<std::size_t> waiting;  // indices of children
        std::size_t passed_on = 0;      // bands
        wire::Time since;
    };

    const Child* child_of(wire::LinkId link) const;
    std::size_t index_of(const Child& child) const;
    void fault(wire::LinkId link, const wire::Fault& fault, std::vector<wire::NetEffect>& effects);
    void on_windows(const Child& child, const wire::Message& message, std::vector<wire::NetEffect>& effects);
    void on_probed(const Child& child, const wire::pb::Probed& probed, std::vector<wire::NetEffect>& effects);
    void on_replied(const Child& child, const wire::pb::Replied& replied,
                    std::vector<wire::NetEffect>& effects);
    void on_histogram(std::size_t index, const wire::pb::HistogramReport& report,
                      std::vector<wire::NetEffect>& effects);
    void give_up(Pending& pending, std::size_t index) const;
    void pass_on(std::uint64_t frame);
    static MergeJob take_bands(Pending& pending, std::size_t known);

    std::uint64_t epoch_ = 0;
    std::vector<Child> children_;
    std::map<std::uint64_t, Pending> pending_;
    std::vector<MergeJob> complete_;
    struct VoxelRoute {
        wire::LinkId link;
        std::optional<wire::pb::NeedVoxels> unanswered;
    };
    std::map<int, VoxelRoute> voxel_routes_;  // by the asking renderer's place
    std::array<bool, 2> histogram_news_{};    // by Counted
    std::optional<wire::Message> wanted_;     // pb::WantFunctions
    std::vector<wire::Message> functions_;
    Probes probes_;
    Gathering<wire::Reply> replies_{max_pending, reply_patience};
};

}  // namespace shearwater::node
