#include "protocol/wire/convert_look.h"

#include <algorithm>

#include "protocol/wire/convert.h"
#include "protocol/wire/convert_culling.h"
#include "protocol/wire/convert_fields.h"

namespace shearwater::wire {

pb::Look to_wire(const LookRequest& look) {
    pb::Look to;
    to.set_request(look.request);
    *to.mutable_factorisation() = to_wire(look.factorisation);
    *to.mutable_transfer_function() = to_wire(look.tf);
    *to.mutable_culling() = to_wire(look.settings);
    to.mutable_functions()->Assign(look.functions.begin(), look.functions.end());
    to.mutable_places()->Assign(look.places.begin(), look.places.end());
    return to;
}

Parsed<LookRequest> look_from(const pb::Look& look) {
    auto factorisation = factorisation_from(look.factorisation());
    if (!factorisation) {
        return factorisation.error();
    }
    auto tf = transfer_function_from(look.transfer_function());
    if (!tf) {
        return tf.error();
    }
    const auto settings = culling_from(look.culling());
    if (!settings) {
        return settings.error();
    }
    if (settings->kind == culling::Kind::off) {
        return invalid("look.culling: a kind of functions is wanted");
    }
    return LookRequest{.request = look.request(),
                       .factorisation = *std::move(factorisation),
                       .tf = *std::move(tf),
                       .settings = *settings,
                       .functions = {look.functions().begin(), look.functions().end()},
                       .places = {look.places().begin(), look.places().end()}};
}

void Reply::add(const Reply& other) {
    incomplete = incomplete || other.incomplete;
    if (visible.empty()) {
        visible = other.visible;
    } else if (other.visible.size() == visible.size()) {
        std::ranges::transform(visible, other.visible, visible.begin(),
                               [](char a, char b) { return static_cast<char>(a | b); });
    } else {
        incomplete = incomplete || !other.visible.empty();
    }
}

pb::Replied to_wire(const Reply& reply) {
    pb::Replied to;
    to.set_request(reply.request);
    to.set_incomplete(reply.incomplete);
    to.set_visible(reply.visible);
    return to;
}

Parsed<Reply> reply_from(const pb::Replied& replied) {
    if (replied.visible().size() > (most_blocks + 7) / 8) {
        return invalid("replied.visible: more blocks than are told apart");
    }
    return Reply{replied.request(), replied.incomplete(), replied.visible()};
}

}  // namespace shearwater::wire
