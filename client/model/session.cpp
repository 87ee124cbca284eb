#include "client/model/session.h"

#include <algorithm>

#include "client/model/intake.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/picture.h"

namespace shearwater::model {

namespace {

namespace pb = wire::pb;
using Seconds = std::chrono::duration<double>;

// Dialling again would end the same way until a person changes something.
bool is_final(pb::Reason reason) {
    return reason == pb::REASON_BAD_SECRET || reason == pb::REASON_BAD_VERSION;
}

// What the system says of a dial, without the address before it.
std::string why_unreachable(const wire::LinkDown& down, const std::string& address) {
    const std::string before = address + ": ";
    const std::string_view text = down.text;
    const bool names_it = text.starts_with(before);
    return text.empty() ? "" : " (" + base::printable(text.substr(names_it ? before.size() : 0)) + ")";
}

// What became of a link, and what to do about it. Of a command these are its own words.
std::string words_for(const wire::LinkDown& down, const wire::Route& server, const std::string& name,
                      bool has_been_up) {
    if (!server.command.empty() &&
        (down.reason == pb::REASON_UNREACHABLE || down.reason == pb::REASON_LOST)) {
        return base::printable(down.text, 500);
    }
    if (!has_been_up && (down.reason == pb::REASON_TIMED_OUT || down.reason == pb::REASON_LOST)) {
        return name + " answers, but not as a Shearwater server does. Is that its port?";
    }
    switch (down.reason) {
        case pb::REASON_BAD_SECRET:
            return "The secret is not the one that " + name +
                   " has. Who serves there was told which file it is in.";
        case pb::REASON_BAD_VERSION:
            return name +
                   " speaks another version of the protocol. Install the same Shearwater at both ends.";
        case pb::REASON_UNREACHABLE:
            return "No server answers at " + name + why_unreachable(down, wire::to_string(server)) +
                   ". Is it running there, on that port?";
        case pb::REASON_SHUTDOWN:
            return "The server was stopped.";
        case pb::REASON_TIMED_OUT:
            return "The server has fallen silent.";
        case pb::REASON_LOST:
            return "The connection broke.";
        case pb::REASON_TOO_MANY_LINKS:
            return "The server has as many clients as it takes.";
        default:
            break;
    }
    const std::string why = base::printable(down.text.empty() ? wire::text_of(down.reason) : down.text);
    return "The link ended: " + why + ".";
}

// A peer's figures are its own affair: what is no time counts as none.
Stages stages_of(const pb::FrameStats& stats, Seconds latency) {
    const auto time = [](double seconds) {
        constexpr double longest = 3600;
        return seconds > 0 ? std::min(seconds, longest) : 0.0;
    };
    return {.look = time(stats.look_seconds()),
            .render = time(stats.leaves().render_seconds()),
            .composite = time(stats.leaves().composite_seconds()),
            .warp = time(stats.warp_seconds()),
            .code = time(stats.encode_seconds()),
            .link = time(latency.count() - time(stats.total_seconds()))};
}

}  // namespace

void Session::start(wire::Time now) {
    dial(now);
}

void Session::dial(wire::Time) {
    link_ = wire::LinkId{static_cast<std::uint64_t>(link_) + 1};
    linked_ = true;
    connection_ = Connection::connecting;
    words_ = "Connecting to " + name_ + " ...";
    effects_.push_back(wire::Dial{link_, server_, pb::ROLE_CLIENT});
}

void Session::retry(wire::Time now) {
    if (connection_ == Connection::waiting || connection_ == Connection::refused) {
        retry_after_ = first_retry;
        dial(now);
    }
}

void Session::handle(const wire::NetEvent& event, wire::Time now) {
    if (const auto* up = std::get_if<wire::LinkUp>(&event); up != nullptr && on_link(up->link)) {
        on_up();
    } else if (const auto* received = std::get_if<wire::Received>(&event);
               received != nullptr && on_link(received->link)) {
        on_message(*received, now);
    } else if (const auto* down = std::get_if<wire::LinkDown>(&event);
               down != nullptr && on_link(down->link)) {
        on_down(*down, now);
    } else if (std::holds_alternative<wire::Tick>(event)) {
        on_tick(now);
    }
}

void Session::on_up() {
    connection_ = Connection::connected;
    has_been_up_ = true;
    words_ = "Connected to " + name_ + ".";
    described_ = false;
    sent_.clear();
    answered_ = revision_;
    before_link_ = revision_;
    link_gauge_ = {};
    picker_.give_up();
}

void Session::on_down(const wire::LinkDown& down, wire::Time now) {
    linked_ = false;
    wait(words_for(down, server_, name_, has_been_up_), now);
    if (is_final(down.reason) || (redial_ == Redial::once_linked && !has_been_up_)) {
        connection_ = Connection::refused;
    }
}

void Session::give_up(const wire::Fault& fault, wire::Time now) {
    effects_.push_back(wire::CloseLink{link_, fault.reason, fault.text});
    linked_ = false;
    wait("The server sent what it must not (" + base::printable(fault.text) + ").", now);
}

void Session::wait(std::string words, wire::Time now) {
    connection_ = Connection::waiting;
    words_ = std::move(words);
    tree_ = {};
    retry_at_ = now + retry_after_;
    retry_after_ = std::min(2 * retry_after_, longest_retry);
}

void Session::on_message(const wire::Received& received, wire::Time now) {
    const wire::Message& message = received.message;
    if (const auto* description = std::get_if<pb::CubeDescription>(&message.body)) {
        auto cube = cube_from(*description);
        if (!cube) {
            return give_up(cube.error(), now);
        }
        on_cube(std::move(*cube), now);
    } else if (const auto* state = std::get_if<pb::TreeState>(&message.body)) {
        auto tree = tree_from(*state);
        if (!tree) {
            return give_up(tree.error(), now);
        }
        on_tree(std::move(*tree), now);
    } else if (std::holds_alternative<pb::Frame>(message.body)) {
        on_frame(received, now);
    } else if (const auto* picked = std::get_if<pb::Picked>(&message.body)) {
        const auto answer = picker_.answer(*picked, cube_);
        if (!answer) {
            return give_up(answer.error(), now);
        }
        picked_ = *answer ? *answer : picked_;
    } else {
        const std::string what = std::string(wire::name(message.body)) + " is not for a client";
        give_up({pb::REASON_BAD_TYPE, what}, now);
    }
}

// Other limits alone are no other view. Those wished for are of the cube before.
void Session::on_cube(Cube cube, wire::Time now) {
    if (wish_ && cube_ && (cube_->lattice != cube.lattice || cube_->name != cube.name)) {
        wish_->scaling.reset();
    }
    const bool is_known = described_ && cube_->lattice == cube.lattice;
    cube_ = std::move(cube);
    described_ = true;
    if (!is_known) {
        unsent_ = wish_.has_value();
        quality_ = pace_.for_single();
        send_if_due(now);
    }
}

// A frame that lacks parts is asked for again when more of the tree is there.
void Session::on_tree(Tree tree, wire::Time now) {
    tree_ = std::move(tree);
    const int ready = tree_.in_phase(pb::PHASE_READY);
    if (frame_ && !frame_->missing.empty() && ready > ready_at_frame_ && wish_) {
        unsent_ = true;
        send_if_due(now);
    }
    ready_at_frame_ = std::min(ready_at_frame_, ready);
}

void Session::on_frame(const wire::Received& received, wire::Time now) {
    const wire::Message& message = received.message;
    const auto& frame = std::get<pb::Frame>(message.body);
    if (frame.revision() <= before_link_ || frame.revision() > revision_) {
        return give_up({pb::REASON_INVALID, "frame: of a view that was not asked for"}, now);
    }
    pb::FrameShown shown;
    shown.set_number(frame.number());
    effects_.push_back(wire::Send{link_, wire::message(std::move(shown))});
    const auto sent = std::find_if(sent_.begin(), sent_.end(),
                                   [&](const Sent& view) { return view.revision == frame.revision(); });
    if (sent == sent_.end()) {
        return;  // overtaken by a newer one
    }
    auto missing = missing_from(frame);
    if (!missing) {
        return give_up(missing.error(), now);
    }
    auto eyes = wire::pictures_from(message, sent->size, sent->eyes);
    if (!eyes) {
        return give_up(eyes.error(), now);
    }
    const Seconds latency = now - sent->at;
    if (sent->revision > answered_ && sent->tree_ready) {
        meter_.count(now, latency, message.payload_size());
        pace_.count(now, sent->at, sent->quality, frame.stats().leaves().render_seconds());
    }
    link_gauge_.count({.bytes = message.payload_size(),
                       .size = sent->size,
                       .deflated = sent->deflated,
                       .coding = Seconds(frame.stats().encode_seconds()),
                       .arriving = received.arriving});
    const pb::LeafStats& leaves = frame.stats().leaves();
    frame_ = FrameNote{
        .revision = sent->revision,
        .size = sent->size,
        .quality = sent->quality,
        .missing = std::move(*missing),
        .sketch = frame.sketch(),
        .bytes = message.payload_size(),
        .stages = stages_of(frame.stats(), latency),
        .samples = frame.stats().leaves().samples(),
        .opaque_bricks = leaves.bricks_total() - std::min(leaves.bricks_total(), leaves.bricks_empty()),
        .culled_bricks = leaves.bricks_culled()};
    picture_ = Picture{sent->revision, sent->quality, frame_->missing.empty(), std::move(eyes->front()), {}};
    if (sent->eyes > 1) {
        picture_->right = std::move(eyes->back());
    }
    picture_wish_ = sent->wish;
    retry_after_ = first_retry;
    ready_at_frame_ = tree_.in_phase(pb::PHASE_READY);
    forget_older_than(frame.revision());
    refine(now);
    send_if_due(now);
}

void Session::on_tick(wire::Time now) {
    if (connection_ == Connection::waiting && now >= retry_at_) {
        dial(now);
    }
    if (wish_ && is_worth_asking_again(now)) {
        unsent_ = true;
    }
    refine(now);
    send_if_due(now);
}

// A view at rest is asked for once more, better.
void Session::refine(wire::Time now) {
    if (!wish_ || is_moving(now)) {
        return;
    }
    one_of_many_ = false;
    // A picture below its size is no better than a draft.
    if (const auto next = pace_.at_rest(small_ ? view::Quality::draft : quality_, has_come())) {
        quality_ = *next;
        unsent_ = true;
    }
}

// The tree is whole and nothing is under way, and yet the newest picture lacks parts: they were lost while
// it was drawn.
bool Session::is_worth_asking_again(wire::Time now) const {
    return tree_.ready && frame_ && !frame_->missing.empty() && answered_ == revision_ &&
           now - sent_at_ >= again_after;
}

void Session::want(const Wish& wish, Change change, wire::Time now) {
    if (wish_ == wish) {
        return;
    }
    one_of_many_ = change == Change::dragging || is_moving(now);
    wish_ = wish;
    quality_ = pace_.for_single();
    changed_at_ = now;
    unsent_ = true;
    send_if_due(now);
}

void Session::pick(Purpose purpose, const view::Vec2& at) {
    const bool in_picture =
        wish_ && at.x >= 0 && at.y >= 0 && at.x <= wish_->size.width && at.y <= wish_->size.height;
    if (in_picture && described_ && connection_ == Connection::connected) {
        wire::PickRequest request{.camera = camera(wish_->viewpoint, cube_->lattice),
                                  .size = wish_->size,
                                  .at = at,
                                  .tf = wish_->tf,
                                  .crop = crop_of_cube()};
        effects_.push_back(wire::Send{link_, picker_.ask(purpose, std::move(request))});
    }
}

void Session::set_effort(const Effort& effort, wire::Time now) {
    pace_.set(effort);
    refine(now);
    send_if_due(now);
}

// One of another cube's counts for nothing.
std::optional<volume::Box> Session::crop_of_cube() const {
    const bool is_of_cube = wish_->crop && view::validate_crop(*wish_->crop, cube_->lattice.n);
    return is_of_cube ? wish_->crop : std::nullopt;
}

// One view unanswered keeps the server busy and a second one waits at it; further ones only replace that.
void Session::send_if_due(wire::Time now) {
    if (!unsent_ || !described_ || connection_ != Connection::connected) {
        return;
    }
    const std::uint64_t unanswered = revision_ - answered_;
    if (unanswered < 2 || (unanswered < most_unanswered && now - sent_at_ >= busy_interval)) {
        send_view(now);
    }
}

void Session::send_view(wire::Time now) {
    if (one_of_many_) {
        quality_ = pace_.while_moving(now);
    }
    const view::ImageSize size = one_of_many_ && !pace_.effort().fixed
                                     ? link_gauge_.size_at_rate(wish_->size, pace_.effort().target_rate)
                                     : wish_->size;
    small_ = size != wish_->size;
    const view::Camera seen = camera(wish_->viewpoint, cube_->lattice);
    const bool fits = wish_->stereo && view::validate(*wish_->stereo, seen, size);
    const wire::View view{.revision = ++revision_,
                          .camera = seen,
                          .size = size,
                          .tf = wish_->tf,
                          .quality = quality_,
                          .deflate = link_gauge_.wants_deflate(size),
                          .level_of_detail = wish_->level_of_detail,
                          .sketch = true,
                          .classify = wish_->classify,
                          .culling = wish_->culling,
                          .stereo = fits ? wish_->stereo : std::nullopt,
                          .crop = crop_of_cube(),
                          .scaling = wish_->scaling};
    effects_.push_back(wire::Send{link_, wire::message(wire::to_wire(view))});
    sent_.push_back({revision_, *wish_, view.size, view.stereo ? 2 : 1, view.quality, view.deflate, now,
                     tree_.nodes.empty() || tree_.ready});
    sent_at_ = now;
    unsent_ = false;
}

// Views before the one just answered were passed over; that one may be answered again.
void Session::forget_older_than(std::uint64_t revision) {
    answered_ = std::max(answered_, revision);
    while (!sent_.empty() && sent_.front().revision < revision) {
        sent_.pop_front();
    }
}

Status Session::status(wire::Time now) const {
    Status status;
    status.connection = connection_;
    status.words = words_;
    if (connection_ == Connection::waiting) {
        status.retry_in = std::max(0.0, Seconds(retry_at_ - now).count());
    }
    status.sent = revision_;
    status.cube = cube_;
    status.tree = tree_;
    status.frame = frame_;
    status.rates = meter_.rates(now);
    status.link_speed = link_gauge_.speed();
    status.refining = connection_ == Connection::connected && described_ && wish_ && !is_moving(now) &&
                      (quality_ != pace_.best() || small_ || !has_come());
    return status;
}

}  // namespace shearwater::model
