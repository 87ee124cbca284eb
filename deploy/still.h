#pragma once
// A client without a window: asks a server for the pictures of a script. A pure state machine, like all that
// speak on links.

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "deploy/picture.h"
#include "deploy/script.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/events.h"

namespace shearwater::deploy {

class Still {
  public:
    // The options say how all pictures are drawn; what they show is the script's.
    Still(wire::Route server, const ViewOptions& options, view::ImageSize size, Script script);

    std::vector<wire::NetEffect> start(wire::Time now);
    std::vector<wire::NetEffect> handle(const wire::NetEvent& event, wire::Time now);

    // The last picture, once it is whole, or why there is none.
    bool done() const { return finished_ || failed_.has_value(); }
    base::Result<Picture> take();

    // The share done, for a progress bar: of loading, or, where there are several, of the pictures too.
    double progress() const;

  private:
    // For values that a function goes by, once all is loaded.
    static constexpr std::chrono::seconds patience{20};

    void on_state(const wire::pb::TreeState& state);
    void on_cube(const wire::pb::CubeDescription& cube, wire::Time now,
                 std::vector<wire::NetEffect>& effects);
    void on_frame(const wire::Message& message, wire::Time now, std::vector<wire::NetEffect>& effects);
    bool prepare_next();
    void ask(wire::Time now, std::vector<wire::NetEffect>& effects);
    void ask_ahead(wire::Time now, std::vector<wire::NetEffect>& effects);
    void fail(base::Code code, std::string detail);

    wire::Route server_;
    ViewOptions options_;
    Script script_;
    wire::View view_;                   // the newest asked for
    std::deque<int> to_ask_;            // pictures
    std::optional<flight::Shot> next_;  // the first of them
    std::optional<KnownCube> known_;    // once there is what is needed to ask
    std::optional<wire::Time> ready_;   // since when all is loaded
    std::vector<Seconds> times_;
    Picture picture_;
    wire::Time started_{};
    struct Asked {
        std::uint64_t revision;
        int picture;
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
