#pragma once
// A filled example of every message, and valid values to convert.

#include <vector>

#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/message.h"

namespace shearwater::wire::test {

// One of each of Body's alternatives, in its order, with every field set.
std::vector<Message> examples();
// Of those that have to do with sketches another of each, with what has been added for them.
std::vector<Message> sketch_examples();
std::vector<Message> all_examples();  // both

view::TransferFunction transfer_function();
view::Factorisation factorisation();  // of two faces, 5 x 4 and 3 x 2 pixels
View view_request();

}  // namespace shearwater::wire::test
