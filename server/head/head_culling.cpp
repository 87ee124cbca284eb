// The head's part in leaving out what is hidden: which functions its renderers are asked for, and frames that
// wait until it is known what is visible.

#include "protocol/wire/convert_culling.h"
#include "server/head/head.h"

namespace shearwater::head {

namespace pb = wire::pb;

bool Head::can_cull(wire::LinkId client, const wire::View& view, int level) {
    if (view.culling.kind == culling::Kind::off) {
        functions_.forget(client);
        return false;
    }
    return culling::BlockGrid(roster_.cube().lattice.n).size() <= wire::most_blocks &&
           functions_.need(client, view.tf, view.culling.kind, level);
}

void Head::on_looked(Looked looked, wire::Time now, Effects& effects) {
    Eye* const eye = find_eye(looked.frame).second;
    if (eye == nullptr || !eye->render) {
        return;  // its client has gone, or has moved on
    }
    pb::Render render = *std::exchange(eye->render, std::nullopt);
    wire::put(looked.visible, render);
    branch_.begin(eye->factorisation, render, now, effects.net);
}

void Head::settle_functions(wire::Time now, Effects& effects) {
    for (wire::Message& functions : branch_.take_functions()) {
        const auto part = wire::functions_from(functions);
        if (!part || !roster_.plan().has(part->place) || !roster_.plan().at(part->place).children.empty()) {
            continue;
        }
        if (const auto key = functions_.came(*part, now)) {
            effects.jobs.emplace_back(Learn{*key, roster_.cube().lattice.n,
                                            roster_.plan().at(part->place).box, std::move(functions)});
        }
    }
    if (const auto wanted = functions_.take_wanted(now)) {
        branch_.want_functions(*wanted, effects.net);
    }
    for (const culling::FunctionKey& key : functions_.take_dropped()) {
        effects.jobs.emplace_back(Forget{key});
    }
}

}  // namespace shearwater::head
