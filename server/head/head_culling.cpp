// The head's part in leaving out what is hidden: which functions its renderers are asked for and given, and
// frames that wait until it is known what is visible. The head finds that out itself, or asks its renderers
// to, each for a part of the picture. If they cannot, it does.

#include "protocol/wire/convert_culling.h"
#include "protocol/wire/convert_look.h"
#include "server/head/head.h"

namespace shearwater::head {

namespace pb = wire::pb;

std::optional<Functions::Needed> Head::needed_functions(wire::LinkId client, const wire::View& view,
                                                        int level) {
    if (view.culling.kind == culling::Kind::off) {
        functions_.forget(client);
        return std::nullopt;
    }
    if (culling::BlockGrid(roster_.cube().lattice.n).size() > wire::most_blocks) {
        return std::nullopt;
    }
    auto needed = functions_.need(client, view.tf, view.culling.kind, level);
    return needed.any ? std::optional(std::move(needed)) : std::nullopt;
}

bool Head::shares_looking() const {
    switch (limits_.deciding) {
        case Deciding::by_server:
            return false;
        case Deciding::by_renderers:
            return roster_.all_ready();
        case Deciding::automatic:
            return culling::BlockGrid(roster_.cube().lattice.n).size() >= many_blocks &&
                   roster_.any_elsewhere() && roster_.all_ready();
    }
    return false;
}

void Head::begin_look(std::uint64_t number, const wire::View& view, Eye& eye, const Functions::Needed& needed,
                      wire::Time now, Effects& effects) {
    eye.look_begun = now;
    if (needed.all && shares_looking() && sharing_.given(needed.numbers)) {
        const std::uint64_t request = sharing_.begin_look(number, needed.numbers);
        const wire::LookRequest look{.request = request,
                                     .factorisation = eye.factorisation,
                                     .tf = view.tf,
                                     .settings = view.culling,
                                     .functions = needed.numbers,
                                     .places = roster_.plan().renderers_below(0)};
        eye.lookers = static_cast<int>(look.places.size());
        branch_.ask(request, wire::message(wire::to_wire(look)), now, effects.net);
    } else {
        effects.jobs.emplace_back(node::Look{number, eye.factorisation, view.tf, view.culling});
    }
}

void Head::on_looked(std::uint64_t number, const culling::VisibleBlocks& visible, wire::Time now,
                     Effects& effects) {
    Eye* const eye = find_eye(number).second;
    if (eye == nullptr || !eye->render) {
        return;  // its client has gone, or has moved on
    }
    eye->look_seconds = std::chrono::duration<double>(now - eye->look_begun).count();
    pb::Render render = *std::exchange(eye->render, std::nullopt);
    wire::put(visible, render);
    branch_.begin(eye->factorisation, render, now, effects.net);
}

void Head::settle_replies(wire::Time now, Effects& effects) {
    for (const wire::Reply& reply : branch_.take_replies()) {
        const auto number = sharing_.replied(reply, now);
        const auto [frame, eye] = number ? find_eye(*number) : std::pair<FrameInWork*, Eye*>();
        if (eye == nullptr) {
            continue;
        }
        const culling::BlockGrid grid(roster_.cube().lattice.n);
        auto blocks = reply.incomplete ? std::nullopt : wire::blocks_from(reply.visible, grid.size());
        if (blocks) {
            on_looked(*number, {grid, *std::move(blocks)}, now, effects);
        } else {
            eye->lookers = 0;
            effects.jobs.emplace_back(
                node::Look{*number, eye->factorisation, frame->view->tf, frame->view->culling});
        }
    }
}

void Head::on_given(Given given, wire::Time now, Effects& effects) {
    if (!given.functions) {
        sharing_.sent(given.request, 0, 0, now);
        return;
    }
    const pb::Functions& part = std::get<pb::GiveFunctions>(given.functions->body).functions();
    sharing_.sent(given.request, static_cast<int>(part.directions()),
                  culling::DirectionGrid(static_cast<int>(part.side())).cells(), now);
    branch_.ask(given.request, *given.functions, now, effects.net);
}

void Head::settle_functions(wire::Time now, Effects& effects) {
    for (wire::Message& functions : branch_.take_functions()) {
        const auto part = wire::functions_from(functions);
        if (!part || !roster_.plan().has(part->place) || !roster_.plan().at(part->place).children.empty()) {
            continue;
        }
        if (const auto key = functions_.came(*part, now)) {
            effects.jobs.emplace_back(node::Learn{*key, roster_.cube().lattice.n,
                                                  roster_.plan().at(part->place).box, *part,
                                                  functions.payload});
        }
    }
    if (const auto wanted = functions_.take_wanted(now)) {
        std::vector<std::uint64_t> numbers;
        for (const pb::FunctionWant& want : std::get<pb::WantFunctions>(wanted->body).wants()) {
            numbers.push_back(want.number());
        }
        sharing_.keep(numbers);
        branch_.want_functions(*wanted, effects.net);
    }
    for (const culling::FunctionKey& key : functions_.take_dropped()) {
        effects.jobs.emplace_back(node::Forget{key});
    }
    while (const auto piece = sharing_.take_piece(now)) {
        if (const auto key = functions_.key_of(piece->number)) {
            effects.jobs.emplace_back(Give{piece->request, *key, piece->number, piece->first_direction});
        } else {
            sharing_.sent(piece->request, 0, 0, now);
        }
    }
}

}  // namespace shearwater::head
