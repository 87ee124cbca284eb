#include "deploy/over_links.h"

#include <optional>

#include "protocol/daemon/runtime.h"

namespace shearwater::deploy {

base::Result<Picture> draw_over_links(const std::string& program, Target& target, const ViewOptions& view,
                                      const view::AnchoredFunction& function, const view::ImageSize& size,
                                      const Repeat& repeat, const volume::Progress& progress) {
    std::optional<LocalTree>& tree = target.tree;
    Still still(target.server, view, function, size, repeat);
    std::optional<daemon::Runtime> runtime;
    runtime.emplace(program, target.secret, [&](const wire::NetEvent& event) {
        runtime->perform(still.handle(event, std::chrono::steady_clock::now()));
        progress(still.progress());
        if (still.done()) {
            runtime->stop(0);
        } else if (tree && std::holds_alternative<wire::Tick>(event) && !tree->keep_alive()) {
            runtime->stop(1);
        }
    });
    runtime->perform(still.start(std::chrono::steady_clock::now()));
    runtime->run();
    if (!still.done()) {
        return base::error(base::Code::cancelled, "draw", "stopped before there was a picture");
    }
    auto picture = still.take();
    if (picture && tree) {
        picture->tree = tree->shape();
    }
    return picture;
}

}  // namespace shearwater::deploy
