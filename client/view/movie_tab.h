#pragma once
// The movie's timeline (DVR section 4: flight paths): key frames of the view on a strip, played and kept as a
// file that `shearwater movie` draws.

#include "client/view/desk.h"

namespace shearwater::ui {

// Keys, playing, the file: on the line where the cursor is.
void movie_tools(Desk& desk);
// The strip, down to the window's end.
void movie_body(Desk& desk);
// Once a pass, before the widgets: what is played goes on, and what has come of files is taken over.
void play_on(Desk& desk);

}  // namespace shearwater::ui
