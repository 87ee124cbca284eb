#pragma once
// What the widgets draw from and change in one pass; the app turns the changes into wishes.

#include <array>
#include <memory>
#include <string>

#include "client/model/crop.h"
#include "client/model/history.h"
#include "client/model/keeping.h"
#include "client/model/session.h"
#include "client/model/timeline.h"
#include "client/model/transition.h"
#include "client/view/controls.h"
#include "client/view/editor_state.h"
#include "client/view/eye_areas.h"
#include "client/view/flight_files.h"
#include "client/view/preset_shelf.h"
#include "client/view/texture.h"
#include "client/view/theme.h"
#include "client/view/window.h"

namespace shearwater::ui {

// What is to be said for a while.
struct Saying {
    std::string words;
    bool is_bad = false;
    double until = 0;  // seconds of ImGui's clock
};

// What is asked of files in one pass.
struct FileWishes {
    bool save = false, open = false, picture = false;
    bool restore = false, dismiss = false;  // what was left behind
};

struct MovieState {
    std::array<char, 512> file{};  // the flight path's, as it is typed
    bool holds_key = false;        // what is dragged over the strip
};

struct Desk {
    Desk(Window& window, PresetShelf& presets_in, FlightFiles& flights_in)
        : fonts(window.fonts()),
          scale(window.scale()),
          has_quad_buffers(window.has_quad_buffers()),
          gates(window.gates()),
          presets(presets_in),
          flights(flights_in) {}

    const theme::Fonts fonts;
    const float scale;
    const bool has_quad_buffers;
    EyeGates& gates;
    PresetShelf& presets;
    FlightFiles& flights;

    // From the network.
    model::Status status;
    Texture picture;                             // or the left eye's
    Texture right_picture;                       // where the eyes' pictures are apart
    std::shared_ptr<const model::Picture> seen;  // that the picture is made from
    std::uint64_t picture_revision = 0;
    view::Quality picture_quality = view::Quality::normal;

    // What the person sets.
    model::Wish wish;
    model::Effort effort;
    Shown shown;                // how a pair of pictures is shown; none: one picture is wanted
    view::StereoSettings eyes;  // of the pair
    bool reshown = false;       // the picture is to be made anew
    std::optional<view::ImageSize> eye_window;  // the size of an eye's own window, where it has one
    bool boxed = false;                         // the cube's edges are over the picture, with scales
    bool cropping = false;                      // the box's edges and handles are over the picture
    struct CropDrag {
        model::BoxFace face;
        double plane;
    };
    std::optional<CropDrag> crop_drag;  // the face that is held
    bool hold_values = true;            // pins stay at their data values when limits change
    bool dragging = false;              // something is held down while it changes the wish
    bool retry = false;                 // asked to dial now
    bool connect_elsewhere = false;     // asked for the connection dialog in this pass
    bool cancel = false;                // asked in this pass to wait no longer
    bool in_dialog = false;             // the connection dialog is over everything, and has the keys
    std::string waiting_note;           // what else there is to know while a link is waited for
    bool escape = false;                // the key was pressed in this pass
    bool panel = true;
    bool dock = true;
    int dock_tab = 0;
    Controls controls;
    EditorState editor;

    // Navigation.
    wire::Time now{};  // of this pass
    model::Transition transition;
    bool flying = false;
    double pace = 1;                            // of flight
    model::Units units = model::Units::voxels;  // that targets are shown in
    bool numbers = false;                       // the camera's are shown
    model::History<model::Remembered> history;
    bool undo = false, redo = false;  // asked for in this pass

    // What is under the mouse.
    struct PickWish {
        model::Purpose purpose;
        view::Vec2 at;  // of the picture
    };
    std::optional<PickWish> pick;  // to be asked in this pass
    bool reading = false;          // it is shown while the mouse rests
    std::optional<model::Picked> read;
    std::optional<view::Vec2> read_at;  // asked last

    // The movie.
    model::Timeline timeline;
    MovieState movie;

    // Files.
    std::array<char, 512> file{};  // the session's, as it is typed
    FileWishes files;
    bool offers_restoring = false;
    Saying saying;

    void show(const Shown& how) {
        shown = how;
        reshown = true;
        if (how == image::StereoMode::quad_buffered && !has_quad_buffers) {
            shown = image::StereoMode::side_by_side;
            say("This display has no buffer for each eye: they are side by side", true);
        }
    }
    void show_pair(const std::optional<scene::Pair>& pair) {
        show(pair ? Shown(pair->mode) : Shown());
        eyes = pair ? pair->eyes : view::StereoSettings();
    }
    float px(float nominal) const { return nominal * scale; }
    bool has_cube() const { return status.cube.has_value(); }
    void say(const std::string& words, bool is_bad = false) { tell(base::printable(words, 300), is_bad); }
    // What can be shown as it is.
    void tell(std::string words, bool is_bad = false) {
        saying = {std::move(words), is_bad, ImGui::GetTime() + (is_bad ? 12 : 5)};
    }
    // The viewpoint, to be changed by hand now.
    model::Viewpoint& steer() {
        transition.stop();
        dragging = true;
        return wish.viewpoint;
    }
    // Where the view comes to rest, if nothing else happens, and the way to another place.
    const model::Viewpoint& heading() const {
        return transition.under_way() ? *transition.destination() : wish.viewpoint;
    }
    void jump(const model::Viewpoint& to) {
        if (has_cube()) {
            transition.begin(wish.viewpoint, to, now, lattice());
        } else {
            wish.viewpoint = to;
        }
    }
    template <class Change>
    void jump_by(const Change& change) {
        model::Viewpoint to = heading();
        change(to);
        jump(to);
    }
    view::Quality best_quality() const { return effort.fixed.value_or(view::Quality::high); }
    const view::Lattice& lattice() const { return status.cube->lattice; }
};

}  // namespace shearwater::ui
