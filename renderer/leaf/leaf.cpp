#include "renderer/leaf/leaf.h"

#include <algorithm>
#include <utility>

#include "common/volume/levels.h"
#include "protocol/node/merge.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_culling.h"

namespace shearwater::leaf {

namespace pb = wire::pb;
using namespace std::chrono_literals;

Effects Leaf::start() {
    Effects effects;
    member_.start(effects.net);
    return effects;
}

Effects Leaf::handle(const wire::NetEvent& event, wire::Time now) {
    Effects effects;
    switch (member_.handle(event, now, effects.net)) {
        case node::Member::News::assigned:
            on_assigned(effects);
            break;
        case node::Member::News::parent_up:
            on_parent_up(effects);
            break;
        case node::Member::News::parent_down:
            on_parent_down(effects);
            break;
        case node::Member::News::none:
        case node::Member::News::refused:
            break;
    }
    if (const auto* received = std::get_if<wire::Received>(&event);
        received && member_.is_parent(received->link)) {
        on_parent_message(*received, effects);
    }
    if (now - last_report_ > 1s) {
        last_report_ = now;
        report(effects);
    }
    return effects;
}

Effects Leaf::handle(JobEvent event, wire::Time now) {
    Effects effects;
    if (auto* advanced = std::get_if<Advanced>(&event)) {
        if (advanced->job == load_job_) {
            fraction_ = advanced->fraction;
            if (now - last_report_ > 100ms) {
                last_report_ = now;
                report(effects);
            }
        }
    } else if (auto* sketched = std::get_if<Sketched>(&event)) {
        if (sketched->job == load_job_) {
            sketched_ = std::move(sketched->histogram);
            send_histogram(sketched_, true, effects);
        }
    } else if (auto* counted = std::get_if<Counted>(&event)) {
        if (counted->job == load_job_) {
            load_job_ = 0;
            if (counted->histogram) {
                histogram_ = *std::move(counted->histogram);
                send_histogram(histogram_, false, effects);
                advance(effects);
            } else {
                fail(counted->histogram.error(), effects);
            }
        }
    } else if (auto* loaded = std::get_if<Loaded>(&event)) {
        if (loaded->job == load_job_) {
            load_job_ = 0;
            if (loaded->status) {
                if (loaded->histogram) {
                    histogram_ = std::move(loaded->histogram);
                    send_histogram(histogram_, false, effects);
                }
                loaded_mapping_ = load_mapping_;
                advance(effects);
            } else {
                fail(loaded->status.error(), effects);
            }
        }
    } else if (auto* drawn = std::get_if<Drawn>(&event)) {
        if (drawn->job == draw_job_) {
            member_.tell_parent(std::move(drawn->windows), effects.net);
            if (drawn->last) {
                draw_job_ = 0;
                draw_next(effects);
            }
        }
    } else if (const auto* found = std::get_if<Found>(&event)) {
        on_found(*found, effects);
    } else if (const auto* sampled = std::get_if<RaySampled>(&event)) {
        on_sampled(*sampled, effects);
    } else if (const auto* learned = std::get_if<Learned>(&event)) {
        reply(learned->job, {}, effects);
    } else if (const auto* looked = std::get_if<Looked>(&event)) {
        on_looked(*looked, effects);
    } else if (auto* wanted = std::get_if<VoxelsWanted>(&event)) {
        if (wanted->job == load_job_) {
            wanted_ = *wanted;
            ++request_;
            ask_for_voxels(effects);
        }
    } else if (auto* memory = std::get_if<Memory>(&event)) {
        memory_ = *memory;
    }
    return effects;
}

void Leaf::on_assigned(Effects& effects) {
    const pb::Assign& assign = *member_.assignment();
    const auto box = wire::box_from(assign.box());
    const auto lattice = wire::lattice_from(assign.cube().lattice());
    if (!box || !lattice || !volume::whole(lattice->n).contains(*box) ||
        std::cmp_greater(assign.sketch_level(), volume::coarsest_level(lattice->n))) {
        fail(base::error(base::Code::invalid_argument, "take a place",
                         "the server's box, lattice or level of a sketch is unusable"),
             effects);
        return;
    }
    if (!work_ || !node::same_work(*work_, assign) || phase_ == pb::PHASE_FAILED) {
        stop_loading(effects);
        forget_functions(effects);
        give_up_frames(effects);
        share_ = Share{.path = assign.cube().path(),
                       .hdu = static_cast<int>(assign.cube().hdu()),
                       .plane = assign.cube().plane(),
                       .lattice = *lattice,
                       .box = *box,
                       .place = 0,
                       .copies = assign.copies() == 2 ? 2 : 1};
        histogram_.reset();
        sketch_level_ = static_cast<int>(assign.sketch_level());
        sketched_.reset();
        loaded_mapping_.reset();
        error_.clear();
    }
    work_ = assign;
    share_->place = static_cast<int>(assign.place());
    mapping_.reset();
    if (assign.has_mapping()) {
        if (auto mapping = wire::mapping_from(assign.mapping())) {
            mapping_ = *mapping;
        }
    }
    advance(effects);
}

void Leaf::advance(Effects& effects) {
    if (!share_) {
        return;
    }
    if (mapping_) {
        if (loaded_mapping_ == mapping_) {
            enter(pb::PHASE_READY, effects);
            find_next(effects);
        } else if (load_job_ == 0 || load_mapping_ != mapping_) {
            begin_load(effects);
        }
    } else if (histogram_) {
        enter(pb::PHASE_WAITING, effects);
    } else if (load_job_ == 0) {
        begin_count(effects);
    }
}

void Leaf::begin_count(Effects& effects) {
    load_job_ = ++last_job_;
    load_mapping_.reset();
    effects.jobs.emplace_back(Count{load_job_, *share_, sketch_to_make()});
    enter(pb::PHASE_COUNTING, effects);
}

void Leaf::begin_load(Effects& effects) {
    stop_loading(effects);
    forget_functions(effects);
    if (loaded_mapping_) {
        loaded_mapping_.reset();
        give_up_frames(effects);
    }
    load_job_ = ++last_job_;
    load_mapping_ = mapping_;
    effects.jobs.emplace_back(Load{load_job_, *share_, *mapping_, sketch_to_make(), !histogram_});
    enter(pb::PHASE_LOADING, effects);
}

void Leaf::stop_loading(Effects& effects) {
    if (load_job_ != 0) {
        effects.jobs.emplace_back(Stop{load_job_});
        load_job_ = 0;
    }
    wanted_.reset();
}

void Leaf::on_parent_up(Effects& effects) {
    send_histogram(sketched_, true, effects);
    send_histogram(histogram_, false, effects);
    ask_for_voxels(effects);
}

void Leaf::on_parent_down(Effects& effects) {
    forget_functions(effects);
    functions_.clear();
    sampling_.clear();
    replying_.clear();
    // Nobody waits for these frames any more.
    waiting_.clear();
    if (draw_job_ != 0) {
        effects.jobs.emplace_back(Stop{draw_job_});
        draw_job_ = 0;
    }
}

void Leaf::on_parent_message(const wire::Received& received, Effects& effects) {
    const wire::Message& message = received.message;
    if (const auto* render = std::get_if<pb::Render>(&message.body)) {
        on_render(received.link, *render, effects);
    } else if (const auto* cancel = std::get_if<pb::Cancel>(&message.body)) {
        on_cancel(cancel->frame(), effects);
    } else if (const auto* probe = std::get_if<pb::Probe>(&message.body)) {
        on_probe(received.link, *probe, effects);
    } else if (std::holds_alternative<pb::GiveFunctions>(message.body)) {
        on_give_functions(received.link, message, effects);
    } else if (const auto* look = std::get_if<pb::Look>(&message.body)) {
        on_look(received.link, *look, effects);
    } else if (const auto* want = std::get_if<pb::WantFunctions>(&message.body)) {
        on_want_functions(received.link, *want, effects);
    } else if (const auto* mapping = std::get_if<pb::SetMapping>(&message.body)) {
        on_mapping(received.link, *mapping, effects);
    } else if (const auto* voxels = std::get_if<pb::Voxels>(&message.body)) {
        if (wanted_ && voxels->request() == request_) {
            effects.jobs.emplace_back(HandVoxels{wanted_->job, message});
            wanted_.reset();
        }
    }
}

void Leaf::on_mapping(wire::LinkId link, const pb::SetMapping& wanted, Effects& effects) {
    const auto mapping = wire::mapping_from(wanted.mapping());
    if (!mapping) {
        effects.net.emplace_back(wire::CloseLink{link, mapping.error().reason, mapping.error().text});
        return;
    }
    mapping_ = *mapping;
    if (wanted.anew()) {
        send_histogram(sketched_, true, effects);  // it is forgotten where it was sent before
    }
    advance(effects);
}

void Leaf::on_render(wire::LinkId link, const pb::Render& render, Effects& effects) {
    auto factorisation = wire::factorisation_from(render.factorisation());
    auto tf = wire::transfer_function_from(render.transfer_function());
    if (!factorisation || !tf) {
        const wire::Fault fault = factorisation ? tf.error() : factorisation.error();
        effects.net.emplace_back(wire::CloseLink{link, fault.reason, fault.text});
        return;
    }
    auto visible = wire::visible_from(render, factorisation->lattice.n);
    if (!visible) {
        effects.net.emplace_back(wire::CloseLink{link, visible.error().reason, visible.error().text});
        return;
    }
    Waiting wanted{render.frame(), *std::move(factorisation), *std::move(tf), {}, *std::move(visible)};
    if (render.has_sketch()) {
        const auto limits = wire::mapping_from(render.sketch());
        if (!limits) {
            effects.net.emplace_back(wire::CloseLink{link, limits.error().reason, limits.error().text});
            return;
        }
        wanted.sketch = *limits;
    }
    if (!can_draw(wanted)) {
        send_absent(wanted.frame, bands_of(wanted.factorisation).size(), effects);
        return;
    }
    if (!wanted.sketch) {
        sketched_.reset();
    }
    if (waiting_.size() >= max_waiting) {
        send_absent(waiting_.front().frame, bands_of(waiting_.front().factorisation).size(), effects);
        waiting_.pop_front();
    }
    waiting_.push_back(std::move(wanted));
    draw_next(effects);
}

bool Leaf::can_draw(const Waiting& wanted) const {
    if (!share_ || wanted.factorisation.lattice != share_->lattice) {
        return false;
    }
    return wanted.sketch ? sketched_ && wanted.factorisation.level() == sketch_level_
                         : phase_ == pb::PHASE_READY;
}

// What they were to be drawn from is about to go.
void Leaf::give_up_frames(Effects& effects) {
    for (const Waiting& waiting : std::exchange(waiting_, {})) {
        send_absent(waiting.frame, bands_of(waiting.factorisation).size(), effects);
    }
    if (draw_job_ != 0) {
        effects.jobs.emplace_back(Stop{draw_job_});
        send_absent(drawing_, drawing_bands_, effects);
        draw_job_ = 0;
    }
}

void Leaf::draw_next(Effects& effects) {
    if (draw_job_ != 0 || waiting_.empty()) {
        return;
    }
    Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    draw_job_ = ++last_job_;
    drawing_ = next.frame;
    drawing_bands_ = bands_of(next.factorisation).size();
    effects.jobs.emplace_back(Draw{draw_job_, next.frame, std::move(next.factorisation), std::move(next.tf),
                                   std::move(next.sketch), std::move(next.visible)});
}

void Leaf::on_cancel(std::uint64_t frame, Effects& effects) {
    std::erase_if(waiting_, [frame](const Waiting& waiting) { return waiting.frame == frame; });
    if (draw_job_ != 0 && drawing_ == frame) {
        effects.jobs.emplace_back(Stop{draw_job_});
        draw_job_ = 0;
        draw_next(effects);
    }
}

void Leaf::send_absent(std::uint64_t frame, std::size_t bands, Effects& effects) const {
    wire::Message nothing = wire::windows_message(frame, bands, {});
    node::Account account;
    if (share_) {
        account.missing.push_back({share_->place, share_->box});
    }
    node::put(account, std::get<pb::Windows>(nothing.body));
    member_.tell_parent(std::move(nothing), effects.net);
}

void Leaf::send_histogram(const std::optional<volume::Histogram>& histogram, bool of_sketch,
                          Effects& effects) {
    if (histogram && share_) {
        pb::HistogramReport report = wire::to_wire(*histogram);
        report.add_places(static_cast<std::uint32_t>(share_->place));
        report.set_sketch(of_sketch);
        member_.tell_parent(wire::message(std::move(report)), effects.net);
    }
}

void Leaf::ask_for_voxels(Effects& effects) const {
    if (wanted_ && share_) {
        pb::NeedVoxels need;
        need.set_place(static_cast<std::uint32_t>(share_->place));
        need.set_request(request_);
        *need.mutable_box() = wire::to_wire(wanted_->box);
        member_.tell_parent(wire::message(std::move(need)), effects.net);
    }
}

void Leaf::enter(pb::Phase phase, Effects& effects) {
    phase_ = phase;
    fraction_ = phase == pb::PHASE_READY ? 1 : 0;
    report(effects);
}

void Leaf::fail(const base::Error& error, Effects& effects) {
    error_ = error.message();
    enter(pb::PHASE_FAILED, effects);
}

void Leaf::report(Effects& effects) const {
    if (!share_) {
        return;
    }
    pb::Report report;
    report.set_place(static_cast<std::uint32_t>(share_->place));
    report.set_phase(phase_);
    report.set_fraction(fraction_);
    report.set_memory_bytes(memory_.resident);
    report.set_peak_bytes(memory_.peak);
    report.set_error(error_);
    report.set_parent_lost(!member_.has_parent());
    if (loaded_mapping_ && phase_ == pb::PHASE_READY) {
        *report.mutable_loaded() = wire::to_wire(*loaded_mapping_);
    }
    member_.tell_server(wire::message(std::move(report)), effects.net);
}

}  // namespace shearwater::leaf
