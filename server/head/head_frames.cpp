// The head's frames: begun as clients' views come in, given up when nobody waits for them, merged, finished.
// A frame is of one picture or of two eyes'; each is asked for and merged by itself, and they are sent
// together.

#include <algorithm>

#include "common/volume/levels.h"
#include "server/head/head.h"

namespace shearwater::head {

namespace pb = wire::pb;

bool Head::FrameInWork::merged() const {
    return std::ranges::all_of(eyes, &Eye::merged);
}

Finish Head::FrameInWork::finish(std::uint64_t number) const {
    Finish finish{.frame = number, .eyes = eyes.size(), .view = view, .asked = asked, .sketch = sketch};
    for (const Eye& eye : eyes) {
        finish.look_seconds = std::max(finish.look_seconds, eye.look_seconds);
        finish.lookers = std::max(finish.lookers, eye.lookers);
    }
    return finish;
}

// Of the frame that an eye's number is of, and of the eye.
std::pair<Head::FrameInWork*, Head::Eye*> Head::find_eye(std::uint64_t number) {
    const auto after = frames_.upper_bound(number);
    if (after == frames_.begin()) {
        return {};
    }
    auto& [first, frame] = *std::prev(after);
    const std::uint64_t eye = number - first;
    return eye < frame.eyes.size() ? std::pair(&frame, &frame.eyes[eye]) : std::pair<FrameInWork*, Eye*>();
}

void Head::on_finished(Finished finished, wire::Time now, Effects& effects) {
    const auto frame = frames_.find(finished.number);
    if (frame == frames_.end()) {
        return;  // its client has gone
    }
    const wire::LinkId client = frame->second.client;
    frames_.erase(frame);
    if (const auto session = sessions_.find(client); session != sessions_.end()) {
        tell_state(effects);  // what is known of the tree is as new as the picture
        session->second.incomplete = std::get<pb::Frame>(finished.frame.body).missing_size() > 0;
        effects.net.emplace_back(wire::Send{client, std::move(finished.frame)});
        begin_frames(client, session->second, now, effects);
        collect(now, effects);
    }
}

// Of a session's frames those that are still drawn and need not be.
void Head::give_up_frames(Session& session, const std::function<bool(const FrameInWork&)>& which,
                          Effects& effects) {
    std::erase_if(frames_, [&](const auto& entry) {
        const auto& [number, frame] = entry;
        const bool is_left = !frame.merged() && which(frame);
        if (is_left) {
            give_up(number, frame, effects);
            std::erase(session.in_flight, number);
        }
        return is_left;
    });
}

// A view that is wanted in a lower quality than one under way has begun to move, and need not wait for what
// is no longer looked at. Views of the same quality are left: else none of a drag's would be finished.
void Head::give_up_refinements(wire::LinkId client, Session& session, Effects& effects) {
    const auto is_finer = [&](const FrameInWork& frame) {
        return frame.client == client &&
               static_cast<int>(frame.view->quality) > static_cast<int>(session.wanted->quality);
    };
    give_up_frames(session, is_finer, effects);
}

// All is loaded. Whoever has looked at the sketch is to see the cube.
void Head::begin_serving(wire::Time now, Effects& effects) {
    serving_ = true;
    for (auto& [link, session] : sessions_) {
        if (!session.sketched) {
            continue;
        }
        const auto is_sketch = [&](const FrameInWork& frame) { return frame.client == link && frame.sketch; };
        give_up_frames(session, is_sketch, effects);
        if (!session.wanted) {
            session.wanted = session.latest;
            session.asked = now;
        }
    }
}

std::optional<volume::Mapping> Head::sketch_for(const wire::View& view) const {
    if (serving_ || !sketch_ || !view.sketch) {
        return std::nullopt;
    }
    return mapping_ ? mapping_ : sketch_;
}

// One that is merged goes on being finished, and what comes of it finds nobody.
void Head::give_up(std::uint64_t number, const FrameInWork& frame, Effects& effects) {
    for (const Eye& eye : frame.eyes) {
        branch_.cancel(number, effects.net);
        if (eye.begun && !frame.merged()) {
            effects.jobs.emplace_back(GiveUp{number});
        }
        ++number;
    }
}

// The cameras' factorisations. What a sketch has is drawn, whatever level the view would have.
std::vector<view::Factorisation> Head::factorise(const wire::View& view,
                                                 const std::vector<view::Camera>& cameras,
                                                 bool sketch) const {
    const view::Lattice& lattice = roster_.cube().lattice;
    const int sketch_level = roster_.cube().sketch_level;
    auto sampling =
        view::sampling(view.quality, view.level_of_detail.value_or(limits_.level_of_detail), view.classify);
    sampling.opaque = view.culling.opaque();
    const auto crop = sketch && view.crop
                          ? std::optional(view::widened_to_nodes(*view.crop, sketch_level, lattice.n))
                          : view.crop;
    auto each = view::factorise(cameras, view.size, lattice, sampling, crop);
    if (sketch) {
        for (view::Factorisation& factorisation : each) {
            factorisation.slice_exponent = sketch_level;
            factorisation.classify = view::Classify::post;
        }
    }
    return each;
}

void Head::begin_frames(wire::LinkId client, Session& session, wire::Time now, Effects& effects) {
    while (session.wanted && session.in_flight.size() < frames_in_flight) {
        const std::optional<volume::Mapping> sketch = sketch_for(*session.wanted);
        if (!serving_ && !sketch) {
            return;
        }
        session.latest = std::exchange(session.wanted, std::nullopt);
        session.begun = now;
        session.sketched = sketch.has_value();
        const wire::View& view = *session.latest;
        FrameInWork frame{.client = client,
                          .view = std::make_shared<const wire::View>(view),
                          .asked = session.asked,
                          .sketch = sketch.has_value(),
                          .eyes = {}};
        for (const view::Camera& camera : wire::cameras_of(view)) {
            frame.eyes.push_back({.camera = camera});
        }
        const std::uint64_t number = last_frame_ + 1;
        last_frame_ += frame.eyes.size();
        session.in_flight.push_back(number);
        begin_eyes(number, frames_.emplace(number, std::move(frame)).first->second, sketch, now, effects);
    }
}

// Each with a number of its own, the first with the frame's.
void Head::begin_eyes(std::uint64_t number, FrameInWork& frame, const std::optional<volume::Mapping>& sketch,
                      wire::Time now, Effects& effects) {
    const wire::View& view = *frame.view;
    const auto factorisations = factorise(view, wire::cameras_of(view), frame.sketch);
    const auto needed =
        sketch ? std::nullopt : needed_functions(frame.client, view, factorisations.front().level());
    for (std::size_t n = 0; n < frame.eyes.size(); ++n, ++number) {
        pb::Render render;
        if (sketch) {
            *render.mutable_sketch() = wire::to_wire(*sketch);
        }
        render.set_frame(number);
        *render.mutable_factorisation() = wire::to_wire(factorisations[n]);
        *render.mutable_transfer_function() = wire::to_wire(view.tf);
        if (needed) {
            frame.eyes[n].render = std::move(render);
            frame.eyes[n].factorisation = factorisations[n];
            begin_look(number, view, frame.eyes[n], *needed, now, effects);
        } else {
            branch_.begin(factorisations[n], render, now, effects.net);
        }
    }
}

void Head::collect(wire::Time now, Effects& effects) {
    settle_replies(now, effects);
    settle_functions(now, effects);
    settle_picks(effects);
    settle_sketch(now, effects);
    settle_mapping(effects);
    for (node::MergeJob& job : branch_.take_complete()) {
        const std::uint64_t number = job.frame->number;
        const auto [frame, eye] = find_eye(number);
        if (frame == nullptr) {
            continue;
        }
        eye->begun = true;
        eye->merged = job.last();
        effects.jobs.emplace_back(Lay{std::move(job), frame->view, eye->camera});
        if (frame->merged()) {
            const std::uint64_t first = number - static_cast<std::uint64_t>(eye - frame->eyes.data());
            effects.jobs.emplace_back(frame->finish(first));
        }
    }
}

}  // namespace shearwater::head
