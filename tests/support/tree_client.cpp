#include "tests/support/tree_client.h"

#include "protocol/wire/picture.h"

namespace shearwater::support {

namespace pb = wire::pb;
using namespace std::chrono_literals;

namespace {
constexpr wire::LinkId server_link{1};
}

TreeClient::TreeClient(const wire::Address& server, const link::Secret& secret) {
    hub_.emplace(io_, secret, "test client", [this](const wire::NetEvent& event) { on_event(event); });
    hub_->perform(wire::Dial{server_link, server, pb::ROLE_CLIENT});
}

bool TreeClient::wait_until(const std::function<bool()>& holds, std::chrono::seconds patience) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!holds()) {
        if (std::chrono::steady_clock::now() > deadline) {
            return false;
        }
        io_.run_one_for(20ms);
    }
    return true;
}

bool TreeClient::wait_ready() {
    return wait_until([this] { return state_.ready() || down_; }) && state_.ready();
}

std::uint64_t TreeClient::ask(wire::View view) {
    view.revision = ++revision_;
    asked_[revision_] = {view.size, view.stereo ? 2 : 1};
    send(wire::message(wire::to_wire(view)));
    return revision_;
}

void TreeClient::send(wire::Message message) {
    hub_->perform(wire::Send{server_link, std::move(message)});
}

std::optional<Shot> TreeClient::next(std::uint64_t revision) {
    std::optional<Shot> found;
    wait_until([&] {
        while (!shots_.empty() && !found) {
            if (shots_.front().revision >= revision) {
                found = std::move(shots_.front());
            }
            shots_.pop_front();
        }
        return found || down_;
    });
    return found;
}

std::optional<Shot> TreeClient::wait_whole(std::uint64_t revision) {
    while (auto shot = next(revision)) {
        if (shot->missing.empty() && !shot->sketch) {
            return shot;
        }
    }
    return std::nullopt;
}

std::optional<Shot> TreeClient::draw(const wire::View& view) {
    return wait_whole(ask(view));
}

void TreeClient::on_event(const wire::NetEvent& event) {
    if (std::holds_alternative<wire::LinkUp>(event)) {
        up_ = true;
    } else if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
        down_ = *down;
    } else if (const auto* received = std::get_if<wire::Received>(&event)) {
        const wire::Body& body = received->message.body;
        if (const auto* state = std::get_if<pb::TreeState>(&body)) {
            state_ = *state;
        } else if (const auto* cube = std::get_if<pb::CubeDescription>(&body)) {
            if (const auto lattice = wire::lattice_from(cube->lattice())) {
                lattice_ = *lattice;
            }
        } else if (std::holds_alternative<pb::Frame>(body)) {
            on_frame(received->message);
        }
    }
}

void TreeClient::on_frame(const wire::Message& message) {
    const auto& frame = std::get<pb::Frame>(message.body);
    ++frames_received_;
    Shot shot{.revision = frame.revision(),
              .image = {},
              .right = {},
              .missing = {},
              .sketch = frame.sketch(),
              .stats = frame.stats()};
    for (const pb::Missing& missing : frame.missing()) {
        if (const auto box = wire::box_from(missing.box())) {
            shot.missing.push_back(*box);
        }
    }
    const Asked& asked = asked_[frame.revision()];
    if (auto eyes = wire::pictures_from(message, asked.size, asked.eyes)) {
        shot.image = std::move(eyes->front());
        if (asked.eyes > 1) {
            shot.right = std::move(eyes->back());
        }
        shots_.push_back(std::move(shot));
    }
    if (acknowledging_) {
        pb::FrameShown shown;
        shown.set_number(frame.number());
        send(wire::message(shown));
    }
}

}  // namespace shearwater::support
