#pragma once
// What is asked of all renderers together, each of which looks at a part of a picture, and what they reply.

#include <cstdint>
#include <string>
#include <vector>

#include "common/culling/settings.h"
#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "protocol/wire/header.h"

namespace shearwater::wire {

struct LookRequest {
    std::uint64_t request = 0;
    view::Factorisation factorisation;
    view::TransferFunction tf;
    culling::Settings settings;            // not off
    std::vector<std::uint64_t> functions;  // numbers of the functions to go by
    std::vector<int> places;               // of those that look, each at its part
};
pb::Look to_wire(const LookRequest& look);
Parsed<LookRequest> look_from(const pb::Look& look);

struct Reply {
    std::uint64_t request = 0;
    bool incomplete = false;   // somebody could not do what was asked
    std::string visible = {};  // blocks (bits_of), of those who looked

    // Together with another's to the same. What is of another grid is not taken, and lacking.
    void add(const Reply& other);
};
pb::Replied to_wire(const Reply& reply);
Parsed<Reply> reply_from(const pb::Replied& replied);

}  // namespace shearwater::wire
