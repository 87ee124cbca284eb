#include "deploy/first_look.h"

#include <chrono>
#include <optional>

#include "common/base/stopwatch.h"
#include "deploy/local_tree.h"
#include "protocol/daemon/runtime.h"
#include "protocol/wire/convert.h"

namespace shearwater::deploy {

namespace {

namespace pb = wire::pb;

// A client that welcomes sketches, up to the cube's first picture.
class Onlooker {
  public:
    static constexpr wire::LinkId server{1};

    explicit Onlooker(wire::Time start) : start_(start) {}

    std::vector<wire::NetEffect> handle(const wire::NetEvent& event) {
        if (const auto* down = std::get_if<wire::LinkDown>(&event)) {
            failed_ = base::error(base::Code::io, "look at the cube", down->text);
        } else if (const auto* received = std::get_if<wire::Received>(&event)) {
            return on_message(received->message.body);
        }
        return {};
    }

    bool done() const { return seen_.whole > 0 || failed_; }
    base::Result<FirstLook> take() const {
        if (failed_) {
            return *failed_;
        }
        return seen_;
    }

  private:
    std::vector<wire::NetEffect> on_message(const wire::Body& body) {
        std::vector<wire::NetEffect> effects;
        if (const auto* cube = std::get_if<pb::CubeDescription>(&body); cube != nullptr && !asked_) {
            const auto lattice = wire::lattice_from(cube->lattice());
            if (!lattice) {
                failed_ = base::error(base::Code::corrupt, "look at the cube", lattice.error().text);
                return effects;
            }
            const wire::View view{.revision = 1,
                                  .camera = view::camera_on({}, *lattice),
                                  .size = {.width = 512, .height = 512},
                                  .tf = view::default_transfer_function(),
                                  .sketch = true};
            effects.emplace_back(wire::Send{server, wire::message(wire::to_wire(view))});
            asked_ = true;
        } else if (const auto* frame = std::get_if<pb::Frame>(&body)) {
            const double elapsed = base::seconds_since(start_);
            if (seen_.first == 0) {
                seen_.first = elapsed;
                seen_.sketch = frame->sketch();
            }
            if (!frame->sketch() && frame->missing_size() == 0) {
                seen_.whole = elapsed;
            }
            pb::FrameShown shown;
            shown.set_number(frame->number());
            effects.emplace_back(wire::Send{server, wire::message(shown)});
        } else if (const auto* state = std::get_if<pb::TreeState>(&body)) {
            for (const pb::Node& node : state->nodes()) {
                if (node.phase() == pb::PHASE_FAILED) {
                    failed_ =
                        base::error(base::Code::io, "look at the cube", base::printable(node.error(), 400));
                }
            }
        }
        return effects;
    }

    wire::Time start_;
    bool asked_ = false;
    FirstLook seen_;
    std::optional<base::Error> failed_;
};

}  // namespace

base::Result<FirstLook> first_look(const options::CubeOptions& cube, int renderers, int threads) {
    const wire::Time start = std::chrono::steady_clock::now();
    LocalTree::Options options{.cube = cube, .tree = {}, .threads = threads, .log_level = "warn"};
    options.tree.tree = {renderers, 2};
    const link::Secret secret = link::Secret::random();
    auto tree = LocalTree::start(options, secret);
    if (!tree) {
        return tree.error();
    }
    Onlooker onlooker(start);
    std::optional<daemon::Runtime> runtime;
    runtime.emplace("shearwater bench", secret, [&](const wire::NetEvent& event) {
        runtime->perform(onlooker.handle(event));
        if (onlooker.done()) {
            runtime->stop(0);
        } else if (std::holds_alternative<wire::Tick>(event) && !tree->keep_alive()) {
            runtime->stop(1);
        }
    });
    runtime->perform({wire::Dial{Onlooker::server, tree->address(), pb::ROLE_CLIENT}});
    runtime->run();
    if (!onlooker.done()) {
        return base::error(base::Code::cancelled, "look at the cube", "stopped before it was seen");
    }
    return onlooker.take();
}

}  // namespace shearwater::deploy
