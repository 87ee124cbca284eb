#pragma once
// A filled example of every message, and valid values to convert.

#include <vector>

#include "common/view/factorisation.h"
#include "common/view/transfer_function.h"
#include "protocol/wire/convert.h"
#include "protocol/wire/convert_culling.h"
#include "protocol/wire/convert_pick.h"
#include "protocol/wire/convert_world.h"
#include "protocol/wire/message.h"

namespace shearwater::wire::test {

// One of each of Body's alternatives, in its order, with every field set.
std::vector<Message> examples();
// Of those that have to do with sketches another of each, with what has been added for them.
std::vector<Message> sketch_examples();
// And of those that have to do with culling.
std::vector<Message> culling_examples();
// And of those that have to do with what the editor of transfer functions shows and makes.
std::vector<Message> editor_examples();
// Of those that have to do with pairs of pictures, and with crops.
std::vector<Message> stereo_examples();
// Of the one that has to do with world coordinates.
std::vector<Message> world_examples();
std::vector<Message> all_examples();  // all of them

view::TransferFunction transfer_function();
view::Factorisation factorisation();  // of two faces, 5 x 4 and 3 x 2 pixels
volume::Summary summary();
wcs::Axes world_axes();  // right ascension on a grid, declination, velocity
culling::FunctionKey function_key();
View view_request();
PickRequest pick_request();

}  // namespace shearwater::wire::test
