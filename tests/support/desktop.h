#pragma once
// What the other programs of a desktop tell a window, in X messages.

#include <string>

namespace shearwater::test {

// Drops the file at a place of the display, in its coordinates, as a file manager does: by the drag-and-drop
// protocol, version 5. Why the window there did not take it, or empty.
std::string drop_file(const std::string& display, const std::string& path, int x, int y);

// Asks the window with these words in its title to close, as its frame's button does. Why not, or empty.
std::string ask_to_close(const std::string& display, const std::string& title);

}  // namespace shearwater::test
