#pragma once
// The client's side of the conversation with a server, as a pure state machine: network events and wishes
// in, network effects, pictures and a status out. Knows no sockets, windows or clocks.
//
//   dial -> CubeDescription, TreeState -> SetView (the newest wins) -> Frame -> FrameShown -> ...
//
// While the view moves it asks for pictures that come fast enough, by lesser quality (pace.h) and, where the
// link is slow, size (link_gauge.h); when it rests, for a normal one and then for a high one, and then for
// none. Until the cube is loaded, pictures are of a sketch of it: none is refined, and the last view is
// answered once more, unasked, when it is. The wish is kept over a lost link and asked for again on the next.

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "client/model/link_gauge.h"
#include "client/model/meter.h"
#include "client/model/pace.h"
#include "client/model/picker.h"
#include "client/model/status.h"
#include "client/model/viewpoint.h"
#include "common/culling/settings.h"
#include "common/view/stereo.h"
#include "common/view/transfer_function.h"
#include "protocol/wire/events.h"
#include "protocol/wire/header.h"

namespace shearwater::model {

// What a person wants to see.
struct Wish {
    Viewpoint viewpoint;
    view::TransferFunction tf = view::default_transfer_function();
    view::ImageSize size;                 // at most what view::validate allows
    std::optional<bool> level_of_detail;  // else as the server has it
    view::Classify classify = view::Classify::post;
    culling::Settings culling;
    std::optional<view::StereoSettings> stereo;  // a pair of pictures of that size
    std::optional<volume::Box> crop;             // of the cube; one of another cube's counts for nothing
    std::optional<volume::Scaling> scaling;  // of the cube's values, for all who look at it; else as it is
    bool operator==(const Wish&) const = default;
};

enum class Change {
    dragging,  // one of many in a row
    single,    // unless another was made a moment ago
};

// What a dial that came to nothing is followed by, until there has been a link.
enum class Redial {
    always,      // others: the server may come later
    once_linked  // none: it is refused
};

class Session {
  public:
    // The view moves until the last change is this old.
    static constexpr std::chrono::milliseconds rest_after{200};
    // Between dials: doubled from one failure to the next.
    static constexpr std::chrono::milliseconds first_retry{250};
    static constexpr std::chrono::milliseconds longest_retry{5000};
    // While two views are unanswered, between further ones; and the most that may be unanswered.
    static constexpr std::chrono::milliseconds busy_interval{40};
    static constexpr std::size_t most_unanswered = 256;
    // Before a view is asked for again whose picture lacked parts although the tree is whole.
    static constexpr std::chrono::milliseconds again_after{1000};

    // `name`: what a person calls the server; else its route.
    explicit Session(wire::Route server, Redial redial = Redial::always, const std::string& name = {})
        : server_(std::move(server)),
          redial_(redial),
          name_(name.empty() ? wire::to_string(server_) : base::printable(name)) {}

    void start(wire::Time now);
    void handle(const wire::NetEvent& event, wire::Time now);
    // What is to be seen from now on. The same wish again changes nothing.
    void want(const Wish& wish, Change change, wire::Time now);
    // How well to draw it from now on.
    void set_effort(const Effort& effort, wire::Time now);
    // What is to be seen at a point of the picture as it is wanted now. Of several the newest is answered,
    // and none while there is no link.
    void pick(Purpose purpose, const view::Vec2& at);
    // Dials at once when waiting or refused.
    void retry(wire::Time now);

    // Everything that came about since the last call.
    std::vector<wire::NetEffect> take_effects() { return std::exchange(effects_, {}); }
    std::optional<Picture> take_picture() { return std::exchange(picture_, std::nullopt); }
    // What the last picture is of; nothing before the first.
    const std::optional<Wish>& picture_wish() const { return picture_wish_; }
    std::optional<Picked> take_picked() { return std::exchange(picked_, std::nullopt); }

    Status status(wire::Time now) const;

  private:
    // A view that was sent and may still be answered.
    struct Sent {
        std::uint64_t revision;
        Wish wish;
        view::ImageSize size;  // asked for
        int eyes;
        view::Quality quality;
        bool deflated;
        wire::Time at;
        bool tree_ready;  // else its picture had to wait for the cube, which is no latency
    };

    void dial(wire::Time now);
    void on_up();
    void on_down(const wire::LinkDown& down, wire::Time now);
    void on_message(const wire::Received& received, wire::Time now);
    void on_cube(Cube cube, wire::Time now);
    void on_tree(Tree tree, wire::Time now);
    void on_frame(const wire::Received& received, wire::Time now);
    void on_tick(wire::Time now);
    // Ends the link, and waits to dial again.
    void give_up(const wire::Fault& fault, wire::Time now);
    void wait(std::string words, wire::Time now);

    bool is_worth_asking_again(wire::Time now) const;
    bool is_moving(wire::Time now) const { return wish_ && now - changed_at_ < rest_after; }
    // The cube's picture of the newest view sent has come, and no other is wanted.
    bool has_come() const { return frame_ && frame_->revision == revision_ && !frame_->sketch && !unsent_; }
    void refine(wire::Time now);
    void send_if_due(wire::Time now);
    void send_view(wire::Time now);
    std::optional<volume::Box> crop_of_cube() const;
    void forget_older_than(std::uint64_t revision);
    bool on_link(wire::LinkId link) const { return linked_ && link == link_; }

    wire::Route server_;
    Redial redial_;
    std::string name_;
    std::vector<wire::NetEffect> effects_;
    std::optional<Picture> picture_;
    std::optional<Wish> picture_wish_;

    // The link.
    Connection connection_ = Connection::connecting;
    std::string words_;
    bool has_been_up_ = false;
    bool linked_ = false;  // a dial is under way or has come up
    wire::LinkId link_{0};
    std::chrono::milliseconds retry_after_ = first_retry;
    wire::Time retry_at_{};
    std::uint64_t before_link_ = 0;  // the newest revision sent before this link came up

    // What the server told.
    std::optional<Cube> cube_;
    bool described_ = false;  // on this link
    Tree tree_;
    std::optional<FrameNote> frame_;

    // What is wanted, and how well it was asked for.
    std::optional<Wish> wish_;
    view::Quality quality_ = view::Quality::normal;
    bool one_of_many_ = false;  // changes
    bool small_ = false;        // the newest view was asked for below its size
    bool unsent_ = false;
    wire::Time changed_at_{};
    wire::Time sent_at_{};
    std::uint64_t revision_ = 0;  // of the newest view sent
    std::deque<Sent> sent_;       // the one last answered first, then the unanswered
    std::uint64_t answered_ = 0;
    int ready_at_frame_ = 0;  // nodes that were ready when the last frame came

    Meter meter_;
    Pace pace_;
    LinkGauge link_gauge_;
    Picker picker_;
    std::optional<Picked> picked_;
};

}  // namespace shearwater::model
