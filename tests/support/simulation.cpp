#include "tests/support/simulation.h"

#include <gtest/gtest.h>

#include "common/image/over_windows.h"
#include "common/volume/counting_source.h"
#include "common/volume/interpolate.h"
#include "common/volume/statistics.h"
#include "protocol/wire/picture.h"
#include "renderer/culling/culler.h"
#include "renderer/shear/ray_samples.h"
#include "renderer/shear/render.h"
#include "renderer/shear/sketch.h"

namespace shearwater::support {

namespace pb = wire::pb;
using namespace std::chrono_literals;

// ---- the fabric ----

void Fabric::add(int node, Deliver deliver) {
    nodes_[node] = {.deliver = std::move(deliver), .work = {}};
}

void Fabric::remove(int node) {
    nodes_.erase(node);
    std::vector<End> ends;
    for (const auto& [end, peer] : peers_) {
        if (end.node == node) {
            ends.push_back(end);
        }
    }
    for (const End& end : ends) {
        close(end, pb::REASON_LOST, "the connection broke");
    }
    std::erase_if(inbox_, [node](const auto& box) { return box.first.node == node; });
}

void Fabric::close(const End& end, pb::Reason reason, const std::string& text) {
    const auto found = peers_.find(end);
    if (found == peers_.end()) {
        return;
    }
    const End peer = found->second;
    peers_.erase(end);
    peers_.erase(peer);
    inbox_.erase(end);
    inbox_[peer].emplace_back(wire::LinkDown{peer.id, reason, text});
}

void Fabric::dial(int node, const wire::Dial& dial) {
    const End caller{node, dial.link};
    const int target = dial.route.address.port;
    if (!nodes_.contains(target)) {
        inbox_[caller].emplace_back(
            wire::LinkDown{dial.link, pb::REASON_UNREACHABLE, "nobody listens there"});
        return;
    }
    const End callee{target, wire::LinkId{accepted_++}};
    peers_.emplace(caller, callee);
    peers_.emplace(callee, caller);
    inbox_[caller].emplace_back(wire::LinkUp{dial.link, dial.role, "node " + std::to_string(target), "sim"});
    inbox_[callee].emplace_back(wire::LinkUp{callee.id, dial.role, "node " + std::to_string(node), "sim"});
}

void Fabric::perform(int node, std::vector<wire::NetEffect> effects) {
    for (wire::NetEffect& effect : effects) {
        if (auto* send = std::get_if<wire::Send>(&effect)) {
            if (const auto peer = peers_.find({node, send->link}); peer != peers_.end()) {
                inbox_[peer->second].emplace_back(wire::Received{peer->second.id, std::move(send->message)});
            }
        } else if (const auto* closing = std::get_if<wire::CloseLink>(&effect)) {
            close({node, closing->link}, closing->reason, closing->text);
            inbox_.erase({node, closing->link});
        } else {
            dial(node, std::get<wire::Dial>(effect));
        }
    }
}

void Fabric::later(int node, std::function<void()> work) {
    nodes_[node].work.push_back(std::move(work));
}

bool Fabric::step() {
    std::erase_if(inbox_, [](const auto& box) { return box.second.empty(); });
    std::vector<int> busy;
    for (const auto& [number, node] : nodes_) {
        if (!node.work.empty()) {
            busy.push_back(number);
        }
    }
    const std::size_t choices = inbox_.size() + busy.size();
    if (choices == 0) {
        return false;
    }
    const std::size_t choice = random_() % choices;
    if (choice < busy.size()) {
        auto& work = nodes_[busy[choice]].work;
        const auto next = std::move(work.front());
        work.pop_front();
        next();
        return true;
    }
    auto box = std::next(inbox_.begin(), static_cast<std::ptrdiff_t>(choice - busy.size()));
    const int node = box->first.node;
    const wire::NetEvent event = std::move(box->second.front());
    box->second.pop_front();
    if (const auto receiver = nodes_.find(node); receiver != nodes_.end()) {
        receiver->second.deliver(event);
    }
    return true;
}

void Fabric::pass_time(std::chrono::milliseconds time) {
    now_ += time;
    std::vector<int> numbers;
    for (const auto& [number, node] : nodes_) {
        numbers.push_back(number);
    }
    for (const int number : numbers) {
        if (const auto node = nodes_.find(number); node != nodes_.end()) {
            node->second.deliver(wire::Tick{});
        }
    }
}

// ---- the daemons ----

struct Simulation::Daemon {
    virtual ~Daemon() = default;
    virtual void on_event(const wire::NetEvent& event) = 0;
};

struct Simulation::Renderer final : Simulation::Daemon {
    Renderer(Simulation& s, int n, node::MemberOptions options)
        : sim(s), number(n), leaf(std::move(options)) {
        perform(leaf.start());
    }
    void on_event(const wire::NetEvent& event) override { perform(leaf.handle(event, sim.fabric_.now())); }

    void tell(leaf::JobEvent event) { perform(leaf.handle(std::move(event), sim.fabric_.now())); }

    void perform(leaf::Effects effects) {
        sim.fabric_.perform(number, std::move(effects.net));
        for (leaf::Effect& effect : effects.jobs) {
            sim.fabric_.later(number, [this, job = std::move(effect)] { carry_out(job); });
        }
    }

    void carry_out(const leaf::Effect& effect) {
        if (const auto* count = std::get_if<leaf::Count>(&effect)) {
            const auto& share = count->share;
            make_sketch(count->job, share, count->sketch_level);
            tell(leaf::Counted{count->job,
                               volume::count_values(sim.source_, share.box, share.lattice.n, sim.workers_)});
        } else if (const auto* load = std::get_if<leaf::Load>(&effect)) {
            make_sketch(load->job, load->share, load->sketch_level);
            const auto& n = load->share.lattice.n;
            volume::CountingSource counting(sim.source_, load->share.box, n);
            auto loaded = shear::BrickVolume::load(counting, load->share.box, n, load->mapping, sim.workers_);
            bricks = *std::move(loaded);
            tell(leaf::Loaded{
                load->job, {}, load->count ? std::optional(counting.histogram()) : std::nullopt});
        } else if (const auto* ray = std::get_if<leaf::SampleRay>(&effect)) {
            wire::RayPart part{ray->number, {}, !bricks};
            if (bricks) {
                part.samples = shear::sample_ray(
                    *bricks, shear::OpacityTable(ray->tf, bricks->mapping().levels()), ray->ray);
            }
            tell(leaf::RaySampled{ray->job, std::move(part)});
        } else if (const auto* learn = std::get_if<leaf::Learn>(&effect)) {
            lookout.learn(learn->learn);
            tell(leaf::Learned{learn->job});
        } else if (const auto* forget = std::get_if<node::Forget>(&effect)) {
            lookout.forget(*forget);
        } else if (const auto* look = std::get_if<leaf::Look>(&effect)) {
            ++sim.renderer_looks_;
            tell(leaf::Looked{look->job, lookout.look(look->look, sim.workers_)});
        } else if (const auto* find = std::get_if<leaf::Find>(&effect); find != nullptr && bricks) {
            ++sim.finds_;
            for (const bool coarse : {true, false}) {
                if (!coarse || find->key.level == 0) {
                    tell(leaf::Found{
                        find->job,
                        culling::functions_of(*bricks, find->key,
                                              culling::BlockGrid(bricks->cube(), find->block_edge),
                                              culling::DirectionGrid(find->side), coarse, sim.workers_),
                        coarse});
                }
            }
        } else if (const auto* draw = std::get_if<leaf::Draw>(&effect);
                   draw != nullptr && (draw->sketch ? sketch.has_value() : bricks.has_value())) {
            if (draw->sketch) {
                render(*draw, sketch->volume(*draw->sketch, sim.workers_));
            } else {
                render(*draw, *bricks);
            }
        }
    }

    void render(const leaf::Draw& draw, const shear::BrickVolume& volume) {
        const std::vector<view::Band> bands = view::bands_of(draw.factorisation);
        if (bands.empty()) {
            tell(leaf::Drawn{draw.job, wire::windows_message(draw.frame, 0, {}), true});
        }
        const auto classified = shear::classify(volume, draw.tf, draw.factorisation.classify, sim.workers_);
        const auto stats = shear::render_bands(
            volume, classified, draw.factorisation, bands, sim.workers_,
            [&](const shear::DrawnBands& drawn) {
                const bool last = drawn.bands == bands.size();
                auto message =
                    wire::windows_message(draw.frame, drawn.bands, image::encode({&drawn.window, 1}));
                // Each by itself, so that the renderer may die in between.
                sim.fabric_.later(number, [this, job = draw.job, message = std::move(message), last] {
                    tell(leaf::Drawn{job, message, last});
                });
            },
            {.visible = draw.visible ? &*draw.visible : nullptr});
        sim.culled_bricks_ += stats.bricks_culled;
    }

    void make_sketch(leaf::Job job, const leaf::Share& share, int level) {
        if (level > 0 && sim.source_.concurrent()) {
            sketch = *shear::Sketch::read(sim.source_, share.box, share.lattice.n, level, sim.workers_);
            tell(leaf::Sketched{job, sketch->histogram()});
        }
    }

    Simulation& sim;
    int number;
    leaf::Leaf leaf;
    node::Lookout lookout;
    std::optional<shear::BrickVolume> bricks;
    std::optional<shear::Sketch> sketch;
};

struct Simulation::Compositor final : Simulation::Daemon {
    Compositor(Simulation& s, int n, node::MemberOptions options)
        : sim(s), number(n), junction(std::move(options)) {
        perform(junction.start());
    }
    void on_event(const wire::NetEvent& event) override {
        perform(junction.handle(event, sim.fabric_.now()));
    }

    void perform(junction::Effects effects) {
        sim.fabric_.perform(number, std::move(effects.net));
        for (junction::Merge& merge : effects.merges) {
            sim.fabric_.later(number, [this, merge = std::move(merge)]() mutable {
                perform(junction.handle(junction::MergeDone{node::merge_coded(merge.job)}));
            });
        }
    }

    Simulation& sim;
    int number;
    junction::Junction junction;
};

// ---- the tree ----

namespace {

head::Roster roster_for(const tree::Topology& topology, const volume::Index3& n, int sketch_level) {
    auto plan = tree::make_plan(topology, n);
    base::check(plan.has_value(), "the simulated tree fits its cube");
    head::CubeFacts cube;
    cube.name = "simulated";
    cube.path = "/simulated";
    cube.lattice = {.n = n, .spacing = {1, 1, 1}};
    cube.sketch_level = sketch_level;
    constexpr std::uint64_t epoch = 11;
    return {*std::move(plan), std::move(cube), epoch, 8};
}

}  // namespace

Simulation::Simulation(std::uint64_t seed, const tree::Topology& topology, const volume::Index3& n,
                       volume::VoxelSource& source, int sketch_level, head::Deciding deciding)
    : fabric_(seed),
      source_(source),
      head_(roster_for(topology, n, sketch_level), {.range = {}, .percentile = 99.5, .deciding = deciding}) {
    fabric_.add(server_node, [this](const wire::NetEvent& e) { perform(head_.handle(e, fabric_.now())); });
    fabric_.add(client_node, [this](const wire::NetEvent& e) { on_client_event(e); });
    fabric_.perform(client_node,
                    {wire::Dial{wire::LinkId{1}, wire::Address{"sim", server_node}, pb::ROLE_CLIENT}});
}

Simulation::~Simulation() = default;

void Simulation::start_daemon(tree::Place place) {
    const tree::NodeSpec& spec = plan().at(place).spec;
    node::MemberOptions options{.server = {"sim", server_node}, .node_name = spec.name};
    std::unique_ptr<Daemon>& daemon = daemons_[place];
    // The fabric must know the node before it dials.
    fabric_.add(place, [&daemon](const wire::NetEvent& event) { daemon->on_event(event); });
    if (spec.role == tree::Role::renderer) {
        options.role = pb::ROLE_RENDERER;
        daemon = std::make_unique<Renderer>(*this, place, std::move(options));
    } else {
        options.role = pb::ROLE_COMPOSITOR;
        options.listen = {"sim", static_cast<std::uint16_t>(place)};
        daemon = std::make_unique<Compositor>(*this, place, std::move(options));
    }
}

void Simulation::kill_daemon(tree::Place place) {
    daemons_.erase(place);
    fabric_.remove(place);
}

void Simulation::perform(head::Effects effects) {
    fabric_.perform(server_node, std::move(effects.net));
    for (head::Job& job : effects.jobs) {
        fabric_.later(server_node, [this, job = std::move(job)]() mutable {
            if (auto* lay = std::get_if<head::Lay>(&job)) {
                pictures_.lay(lay->merge, *lay->view, lay->camera, workers_);
            } else if (auto* finish = std::get_if<head::Finish>(&job)) {
                this->finish(*finish);
            } else if (const auto* look = std::get_if<node::Look>(&job)) {
                ++head_looks_;
                perform(head_.handle(lookout_.look(*look, workers_), fabric_.now()));
            } else if (const auto* learn = std::get_if<node::Learn>(&job)) {
                lookout_.learn(*learn);
            } else if (const auto* forget = std::get_if<node::Forget>(&job)) {
                lookout_.forget(*forget);
            } else if (const auto* give = std::get_if<head::Give>(&job)) {
                auto functions = lookout_.give(give->request, give->key, give->number, give->first_direction);
                perform(head_.handle(head::Given{give->request, std::move(functions)}, fabric_.now()));
            } else if (const auto* measure = std::get_if<head::Measure>(&job)) {
                const auto value =
                    volume::value_at(source_, measure->n, {measure->at.x, measure->at.y, measure->at.z});
                perform(head_.handle(head::Measured{measure->number, value.value()}, fabric_.now()));
            } else if (const auto* given_up = std::get_if<head::GiveUp>(&job)) {
                EXPECT_TRUE(pictures_.give_up(given_up->frame)) << "what was never begun is given up";
            }
        });
    }
}

void Simulation::finish(const head::Finish& job) {
    pb::Frame frame;
    frame.set_number(job.frame);
    frame.set_revision(job.view->revision);
    frame.set_sketch(job.sketch);
    auto picture = pictures_.take(job.frame, job.eyes);
    node::put(picture.account.missing, *frame.mutable_missing());
    perform(head_.handle(head::Finished{job.frame, wire::frame_message(std::move(frame), job.view->size,
                                                                       static_cast<int>(job.eyes),
                                                                       std::move(picture.coded), false)},
                         fabric_.now()));
}

void Simulation::on_client_event(const wire::NetEvent& event) {
    const auto* received = std::get_if<wire::Received>(&event);
    if (received != nullptr && std::holds_alternative<pb::Frame>(received->message.body)) {
        frame_ = received->message;
        ++frames_;
        if (std::get<pb::Frame>(frame_->body).sketch()) {
            sketch_ = frame_;
        }
        pb::FrameShown shown;
        shown.set_number(std::get<pb::Frame>(frame_->body).number());
        fabric_.perform(client_node, {wire::Send{received->link, wire::message(shown)}});
    } else if (received != nullptr && std::holds_alternative<pb::Picked>(received->message.body)) {
        const auto answer = wire::pick_answer_from(std::get<pb::Picked>(received->message.body),
                                                   head_.roster().cube().lattice.n);
        ASSERT_TRUE(answer) << answer.error().text;
        picked_.push_back(*answer);
    }
}

std::uint64_t Simulation::ask(const wire::View& wanted) {
    wire::View view = wanted;
    view.revision = ++revision_;
    fabric_.perform(client_node, {wire::Send{wire::LinkId{1}, wire::message(wire::to_wire(view))}});
    return revision_;
}

void Simulation::pick(const wire::PickRequest& wanted) {
    fabric_.perform(client_node, {wire::Send{wire::LinkId{1}, wire::message(wire::to_wire(wanted))}});
}

bool Simulation::answered(std::uint64_t revision) const {
    return frame_ && std::get<pb::Frame>(frame_->body).revision() >= revision;
}

bool Simulation::answered_whole(std::uint64_t revision) const {
    return answered(revision) && std::get<pb::Frame>(frame_->body).missing_size() == 0 &&
           !std::get<pb::Frame>(frame_->body).sketch();
}

void Simulation::run_some(int steps) {
    for (int i = 0; i < steps; ++i) {
        if (!fabric_.step()) {
            fabric_.pass_time(100ms);
        }
    }
}

bool Simulation::run_until(const std::function<bool()>& holds, std::chrono::seconds patience) {
    const wire::Time end = fabric_.now() + patience;
    while (!holds()) {
        if (fabric_.step()) {
            continue;
        }
        if (fabric_.now() > end) {
            return false;
        }
        fabric_.pass_time(100ms);
    }
    return true;
}

}  // namespace shearwater::support
