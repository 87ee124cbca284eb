#pragma once
// Who holds which place of the plan, how each is doing, and what each is told to do.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/tree/plan.h"
#include "common/view/geometry.h"
#include "common/volume/mapping.h"
#include "common/wcs/axis.h"
#include "protocol/wire/events.h"

namespace shearwater::head {

// The cube that a server serves.
struct CubeFacts {
    std::string name;  // for people: the file's
    std::string path;  // absolute, as renderers open it
    std::string object;
    std::string unit;
    int hdu = 0;
    std::int64_t plane = 0;
    view::Lattice lattice;
    int sketch_level = 0;  // of the sketch that is drawn until all is loaded (volume::sketch_level); 0: none
    int copies = 1;        // of their codes that renderers keep
    wcs::Axes world;       // of its axes
};

class Roster {
  public:
    Roster(tree::Plan plan, CubeFacts cube, std::uint64_t epoch, int bits);

    // Gives the daemon behind a control link a vacant place of its role: the one it was started for, or
    // the first. Nothing when there is none.
    std::optional<tree::Place> join(wire::LinkId link, const wire::pb::Join& join, const wire::LinkUp& peer);
    // The place that falls vacant, if the link held one.
    std::optional<tree::Place> leave(wire::LinkId link);
    bool holds_place(wire::LinkId link) const { return place_of(link).has_value(); }
    // False when the report is not about the link's own place.
    bool report(wire::LinkId link, const wire::pb::Report& report);
    // From now on renderers are ready only with their voxels held by this mapping.
    void expect(const volume::Mapping& mapping);

    // What the place's daemon must be told; nothing while it or its parent is not there.
    struct Order {
        wire::LinkId link;
        wire::pb::Assign assign;
    };
    std::optional<Order> order_for(tree::Place place, const std::optional<volume::Mapping>& mapping) const;

    bool all_ready() const;      // every renderer holds its bricks, every link of the tree is up
    bool all_settled() const;    // every renderer is ready or has failed
    bool any_elsewhere() const;  // some daemon is on another machine than the server
    wire::pb::TreeState state() const;
    // Whether anything people see changed since this was last asked.
    bool take_news();

    const tree::Plan& plan() const { return plan_; }
    const CubeFacts& cube() const { return cube_; }
    std::uint64_t epoch() const { return epoch_; }

  private:
    struct Holder {
        std::optional<wire::LinkId> link;  // nothing: vacant
        std::string name;
        std::string host;      // numeric address
        wire::Address listen;  // compositors
        wire::pb::Report report;
    };

    std::optional<tree::Place> place_of(wire::LinkId link) const;
    Holder& at(tree::Place place) { return holders_[static_cast<std::size_t>(place)]; }
    const Holder& at(tree::Place place) const { return holders_[static_cast<std::size_t>(place)]; }
    void describe_work(tree::Place place, wire::pb::Assign& assign) const;
    void check_loaded(Holder& holder, tree::Place place) const;

    tree::Plan plan_;
    CubeFacts cube_;
    std::uint64_t epoch_;
    int bits_;
    std::optional<wire::pb::Mapping> expected_;
    std::vector<Holder> holders_;  // by place; the server's own is never filled
    bool news_ = true;
};

}  // namespace shearwater::head
