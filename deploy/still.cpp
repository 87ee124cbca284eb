#include "deploy/still.h"

#include <algorithm>

#include "protocol/wire/picture.h"
#include "protocol/wire/words.h"

namespace shearwater::deploy {

namespace pb = wire::pb;

namespace {

constexpr wire::LinkId server_link{1};

double seconds(wire::Time from, wire::Time to) {
    return std::chrono::duration<double>(to - from).count();
}

}  // namespace

Still::Still(wire::Address server, ViewOptions options, view::TransferFunction tf, view::ImageSize size,
             const Repeat& repeat)
    : server_(std::move(server)), options_(std::move(options)), repeat_(repeat) {
    view_.size = size;
    view_.tf = std::move(tf);
    view_.quality = options_.quality_value();
    view_.level_of_detail = options_.level_of_detail();
    view_.classify = options_.classify_value();
    view_.culling = options_.culling.settings();
}

std::vector<wire::NetEffect> Still::start(wire::Time now) {
    started_ = now;
    return {wire::Dial{server_link, server_, pb::ROLE_CLIENT}};
}

void Still::fail(base::Code code, std::string detail) {
    if (!failed_) {
        failed_ = base::error(code, "draw at " + wire::to_string(server_), std::move(detail));
    }
}

std::vector<wire::NetEffect> Still::handle(const wire::NetEvent& event, wire::Time now) {
    std::vector<wire::NetEffect> effects;
    if (done()) {
        return effects;
    }
    if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
        fail(base::Code::io, down->text);
    } else if (const auto* received = std::get_if<wire::Received>(&event)) {
        const wire::Body& body = received->message.body;
        if (const auto* state = std::get_if<pb::TreeState>(&body)) {
            on_state(*state);
        } else if (const auto* cube = std::get_if<pb::CubeDescription>(&body)) {
            const auto lattice = wire::lattice_from(cube->lattice());
            if (!lattice) {
                fail(base::Code::corrupt, lattice.error().text);
            } else if (!lattice_) {
                lattice_ = *lattice;
                ask(now, effects);
            }
        } else if (std::holds_alternative<pb::Frame>(body)) {
            on_frame(received->message, now, effects);
        }
    } else if (std::holds_alternative<wire::Tick>(event) && !times_.empty()) {
        ask_ahead(now, effects);
    }
    return effects;
}

void Still::on_state(const pb::TreeState& state) {
    double sum = 0;
    double renderers = 0;
    picture_.memory.clear();
    for (const pb::Node& node : state.nodes()) {
        if (node.phase() == pb::PHASE_FAILED) {
            fail(base::Code::io, base::printable(node.error(), 400));
        }
        if (node.role() == pb::ROLE_RENDERER) {
            sum += wire::loaded_share(node.phase(), node.fraction());
            renderers += 1;
        }
        if (node.peak_bytes() > 0) {
            picture_.memory.push_back({base::printable(node.name()), node.peak_bytes()});
        }
    }
    progress_ = renderers > 0 ? sum / renderers : 0;
}

void Still::ask(wire::Time now, std::vector<wire::NetEffect>& effects) {
    const auto camera = options_.camera(*lattice_);
    if (!camera) {
        failed_ = camera.error();
        return;
    }
    view_.camera = *camera;
    options_.orbit.azimuth += repeat_.turn;
    asked_.push_back({++view_.revision, now});
    effects.emplace_back(wire::Send{server_link, wire::message(wire::to_wire(view_))});
    if (repeat_.edit) {
        repeat_.edit(view_.tf);
    }
}

// One at a time, for of two that wait to be sent the newer takes the other's place.
void Still::ask_ahead(wire::Time now, std::vector<wire::NetEffect>& effects) {
    const auto in_flight = static_cast<int>(asked_.size());
    if (in_flight < repeat_.in_flight && static_cast<int>(times_.size()) + in_flight < repeat_.times) {
        ask(now, effects);
    }
}

void Still::on_frame(const wire::Message& message, wire::Time now, std::vector<wire::NetEffect>& effects) {
    const auto& frame = std::get<pb::Frame>(message.body);
    pb::FrameShown shown;
    shown.set_number(frame.number());
    effects.emplace_back(wire::Send{server_link, wire::message(shown)});
    const auto asked = std::ranges::find(asked_, frame.revision(), &Asked::revision);
    if (frame.missing_size() > 0 || asked == asked_.end()) {
        return;  // the server sends it again when it is whole, if it is the newest
    }
    auto decoded = wire::picture_from(message, view_.size);
    if (!decoded) {
        fail(base::Code::corrupt, decoded.error().text);
        return;
    }
    const wire::Time seen = std::chrono::steady_clock::now();
    const pb::LeafStats& leaves = frame.stats().leaves();
    if (times_.empty()) {
        load_seconds_ = seconds(started_, now) - frame.stats().warp_seconds() - leaves.render_seconds();
        progress_ = 1;
    }
    picture_.image = *std::move(decoded);
    times_.push_back({.load = load_seconds_,
                      .preprocess = 0,
                      .render = leaves.render_seconds(),
                      .composite = leaves.composite_seconds(),
                      .warp = frame.stats().warp_seconds(),
                      .encode = frame.stats().encode_seconds(),
                      .total = seconds(asked->at, seen),
                      .interval = seconds(times_.empty() ? asked->at : seen_, seen)});
    asked_.erase(asked_.begin(), asked + 1);
    seen_ = seen;
    picture_.samples = leaves.samples();
    picture_.bricks_total = leaves.bricks_total();
    picture_.bricks_empty = leaves.bricks_empty();
    picture_.bricks_culled = leaves.bricks_culled();
    picture_.bricks_rendered = leaves.bricks_rendered();
    picture_.window_bytes = leaves.window_bytes();
    picture_.frame_bytes = message.payload_size();
    finished_ = static_cast<int>(times_.size()) >= repeat_.times;
    ask_ahead(seen, effects);
}

double Still::progress() const {
    const double pictures = repeat_.times;
    return pictures > 1 ? (progress_ + static_cast<double>(times_.size())) / (1 + pictures) : progress_;
}

base::Result<Picture> Still::take() {
    if (failed_) {
        return *failed_;
    }
    picture_.seconds = median(times_);
    picture_.each = std::move(times_);
    return std::move(picture_);
}

}  // namespace shearwater::deploy
