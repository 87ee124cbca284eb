#pragma once
// The tree as a drawing: a box for each node, the server on top, parents above their children.

#include "client/view/desk.h"

namespace shearwater::ui {

// Into the rectangle (window coordinates). A node tells more under the mouse.
void draw_tree(Desk& desk, ImVec2 from, ImVec2 size);

// What is known of a node, beside the mouse.
void node_tooltip(const model::Node& node);
ImU32 colour_of_phase(wire::pb::Phase phase);

}  // namespace shearwater::ui
