#include "deploy/still.h"

#include <algorithm>
#include <numeric>

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

Still::Still(wire::Route server, const ViewOptions& options, view::ImageSize size, Script script)
    : server_(std::move(server)), options_(options), script_(std::move(script)) {
    to_ask_.resize(static_cast<std::size_t>(script_.pictures));
    std::iota(to_ask_.begin(), to_ask_.end(), 0);
    view_.size = size;
    view_.quality = options_.quality_value();
    view_.level_of_detail = options_.drawing.level_of_detail();
    view_.classify = options_.drawing.classification();
    view_.culling = options_.drawing.culling_settings();
    view_.stereo = options_.stereo.settings();
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
            on_cube(*cube, now, effects);
        } else if (std::holds_alternative<pb::Frame>(body)) {
            on_frame(received->message, now, effects);
        }
    } else if (std::holds_alternative<wire::Tick>(event)) {
        ready_ = progress_ < 1 ? std::nullopt : std::optional(ready_.value_or(now));
        if (!known_ && ready_ && now - *ready_ > patience) {
            fail(base::Code::timed_out, "the server does not tell what values the cube has");
        } else if (!times_.empty()) {
            ask_ahead(now, effects);
        }
    }
    return effects;
}

// What is told of a sketch is about to change, unless nothing depends on it.
void Still::on_cube(const pb::CubeDescription& cube, wire::Time now, std::vector<wire::NetEffect>& effects) {
    if (known_) {
        return;
    }
    const auto lattice = wire::lattice_from(cube.lattice());
    if (!lattice) {
        return fail(base::Code::corrupt, lattice.error().text);
    }
    std::optional<view::ValueScale> scale;
    if (script_.unit != view::Unit::stretched) {
        const bool by_values = script_.unit != view::Unit::value;
        if (cube.provisional() || (by_values && (!cube.has_values() || cube.values().provisional()))) {
            return;
        }
        const auto mapping = wire::mapping_from(cube.mapping());
        const auto values = wire::summary_from(cube.values());
        if (!mapping || !values) {
            return fail(base::Code::corrupt, mapping ? values.error().text : mapping.error().text);
        }
        scale.emplace(*mapping, std::make_shared<const volume::Summary>(*values));
    }
    known_ = KnownCube{*lattice, std::move(scale)};
    ask(now, effects);
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

bool Still::prepare_next() {
    if (!next_) {
        auto shot = script_.shot(to_ask_.front(), *known_);
        if (!shot) {
            failed_ = shot.error();
            return false;
        }
        next_ = *std::move(shot);
    }
    return true;
}

void Still::ask(wire::Time now, std::vector<wire::NetEffect>& effects) {
    const auto crop = options_.crop.box_of(known_->lattice);
    if (!crop) {
        failed_ = crop.error();
    }
    if (!crop || !prepare_next()) {
        return;
    }
    const int picture = to_ask_.front();
    to_ask_.pop_front();
    view_.camera = next_->camera;
    view_.tf = std::move(next_->tf);
    view_.crop = *crop;
    view_.scaling = next_->scaling;
    next_.reset();
    asked_.push_back({++view_.revision, picture, now});
    effects.emplace_back(wire::Send{server_link, wire::message(wire::to_wire(view_))});
}

// One at a time, for of two that wait to be sent the newer takes the other's place; and none by other limits,
// for which the server gives up all that it draws.
void Still::ask_ahead(wire::Time now, std::vector<wire::NetEffect>& effects) {
    const auto in_flight = static_cast<int>(asked_.size());
    if (in_flight < script_.in_flight && !to_ask_.empty() && prepare_next() &&
        (in_flight == 0 || next_->scaling == view_.scaling)) {
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
    auto decoded = wire::pictures_from(message, view_.size, view_.stereo ? 2 : 1);
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
    const auto mode = options_.stereo.mode();
    picture_.image =
        mode ? image::composed(decoded->front(), decoded->back(), *mode) : std::move(decoded->front());
    times_.push_back({.load = load_seconds_,
                      .preprocess = 0,
                      .look = frame.stats().look_seconds(),
                      .render = leaves.render_seconds(),
                      .composite = leaves.composite_seconds(),
                      .warp = frame.stats().warp_seconds(),
                      .encode = frame.stats().encode_seconds(),
                      .total = seconds(asked->at, seen),
                      .interval = seconds(times_.empty() ? asked->at : seen_, seen)});
    if (script_.keep) {
        if (const auto kept = script_.keep(asked->picture, picture_.image); !kept) {
            failed_ = kept.error();
            return;
        }
    }
    // The server passed over the older ones, which waited while a newer came.
    for (auto passed = asked; passed != asked_.begin();) {
        to_ask_.push_front((--passed)->picture);
    }
    asked_.erase(asked_.begin(), asked + 1);
    seen_ = seen;
    picture_.samples = leaves.samples();
    picture_.bricks_total = leaves.bricks_total();
    picture_.bricks_empty = leaves.bricks_empty();
    picture_.bricks_culled = leaves.bricks_culled();
    picture_.bricks_rendered = leaves.bricks_rendered();
    picture_.culling_by = frame.stats().lookers() > 0        ? "renderers"
                          : frame.stats().look_seconds() > 0 ? "server"
                                                             : "nobody";
    picture_.window_bytes = leaves.window_bytes();
    picture_.frame_bytes = message.payload_size();
    finished_ = static_cast<int>(times_.size()) >= script_.pictures;
    ask_ahead(seen, effects);
}

double Still::progress() const {
    const double pictures = script_.pictures;
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
