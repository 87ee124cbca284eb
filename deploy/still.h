#pragma once
// A client without a window: asks a server for one view, some times over, and keeps the last picture.
// Between times the camera may turn. A pure state machine, like all that speak on links.

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/picture.h"
#include "deploy/view_options.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/events.h"

namespace shearwater::deploy {

struct Repeat {
    int times = 1;
    double turn = 0;  // degrees of azimuth from one picture to the next
    // Views asked for and not yet seen, once the first picture has come: while a window is turned the server
    // has the next before the last is there.
    int in_flight = 1;
    // What else is another from one picture to the next, if anything is.
    std::function<void(view::TransferFunction&)> edit = {};
};

class Still {
  public:
    Still(wire::Address server, ViewOptions options, view::TransferFunction tf, view::ImageSize size,
          const Repeat& repeat);

    std::vector<wire::NetEffect> start(wire::Time now);
    std::vector<wire::NetEffect> handle(const wire::NetEvent& event, wire::Time now);

    // The picture, once it is whole, or why there is none.
    bool done() const { return finished_ || failed_.has_value(); }
    base::Result<Picture> take();

    // The share done, for a progress bar: of loading, or, where there are several, of the pictures too.
    double progress() const;

  private:
    void on_state(const wire::pb::TreeState& state);
    void on_frame(const wire::Message& message, wire::Time now, std::vector<wire::NetEffect>& effects);
    void ask(wire::Time now, std::vector<wire::NetEffect>& effects);
    void ask_ahead(wire::Time now, std::vector<wire::NetEffect>& effects);
    void fail(base::Code code, std::string detail);

    wire::Address server_;
    ViewOptions options_;
    wire::View view_;
    Repeat repeat_;
    std::optional<view::Lattice> lattice_;
    std::vector<Seconds> times_;
    Picture picture_;
    wire::Time started_{};
    struct Asked {
        std::uint64_t revision;
        wire::Time at;
    };
    std::deque<Asked> asked_;  // and not seen
    wire::Time seen_{};        // when the last one was
    double progress_ = 0;
    double load_seconds_ = 0;
    bool finished_ = false;
    std::optional<base::Error> failed_;
};

}  // namespace shearwater::deploy
