#pragma once
// A client for tests: speaks to a real server over TCP, one step at a time on the calling thread.

#include <boost/asio/io_context.hpp>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/result.h"
#include "common/image/image.h"
#include "common/volume/box.h"
#include "protocol/link/hub.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/events.h"

namespace shearwater::support {

struct Shot {
    std::uint64_t revision = 0;
    image::Image<image::Rgba8> image;  // of two eyes: the left one's
    image::Image<image::Rgba8> right;
    std::vector<volume::Box> missing;
    bool sketch = false;
    wire::pb::FrameStats stats;
};

class TreeClient {
  public:
    TreeClient(const wire::Address& server, const link::Secret& secret);

    // Each waits at most `patience` (of real time, generous: no test is about speed) and says whether it
    // came about.
    bool wait_until(const std::function<bool()>& holds,
                    std::chrono::seconds patience = std::chrono::seconds(240));
    bool wait_connected() {
        return wait_until([this] { return up_ || down_; }) && up_;
    }
    bool wait_ready();
    bool wait_described() {
        return wait_until([this] { return lattice_ || down_; }) && lattice_;
    }

    // Asks for a view; its revision is set here and returned.
    std::uint64_t ask(wire::View view);
    // The next frame of at least that revision, whole or not.
    std::optional<Shot> next(std::uint64_t revision);
    // Asks, and waits for the whole picture, of the cube.
    std::optional<Shot> draw(const wire::View& view);
    std::optional<Shot> wait_whole(std::uint64_t revision);

    // While false, frames are taken but not acknowledged.
    void acknowledge(bool yes) { acknowledging_ = yes; }
    void send(wire::Message message);

    const std::optional<view::Lattice>& lattice() const { return lattice_; }
    const wire::pb::TreeState& state() const { return state_; }
    const std::optional<wire::LinkDown>& down() const { return down_; }
    std::size_t frames_received() const { return frames_received_; }

  private:
    void on_event(const wire::NetEvent& event);
    void on_frame(const wire::Message& message);

    boost::asio::io_context io_;
    std::optional<link::Hub> hub_;
    bool up_ = false;
    bool acknowledging_ = true;
    std::optional<wire::LinkDown> down_;
    std::optional<view::Lattice> lattice_;
    wire::pb::TreeState state_;
    std::uint64_t revision_ = 0;
    struct Asked {
        view::ImageSize size;
        int eyes;
    };
    std::map<std::uint64_t, Asked> asked_;
    std::deque<Shot> shots_;
    std::size_t frames_received_ = 0;
};

}  // namespace shearwater::support
