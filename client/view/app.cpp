#include "client/view/app.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "client/model/colours.h"
#include "client/view/dock.h"
#include "client/view/function_tab.h"
#include "client/view/movie_tab.h"
#include "client/view/navigation.h"
#include "client/view/panel.h"
#include "client/view/picture_area.h"
#include "client/view/progress_card.h"

namespace shearwater::ui {

App::App(Window& window, std::unique_ptr<Network> network, AppOptions options)
    : window_(window),
      network_(std::move(network)),
      options_(std::move(options)),
      presets_(PresetFolder::of_user(), Window::wake),
      flights_(Window::wake),
      desk_(window, presets_, flights_),
      files_(Window::wake),
      anchoring_(options_.scene ? view::AnchoredFunction{.tf = options_.scene->tf} : options_.tf) {
    desk_.wish.level_of_detail = options_.level_of_detail;
    desk_.wish.classify = options_.classify;
    desk_.wish.culling = options_.culling;
    desk_.effort = options_.effort;
    if (options_.scene) {
        Files::open(desk_, options_.session, *options_.scene);
    }
    if (options_.crop) {
        desk_.wish.crop = options_.crop;
    }
    if (options_.pair) {
        desk_.show_pair(options_.pair);
    }
    desk_.status.words = network_ ? "Starting ..." : "Nothing to see yet.";
}

void App::pass(const std::vector<std::string>& dropped) {
    collect();
    widgets();
    remember();
    files_.attend(desk_, dropped, desk_.seen, is_settled() && picture_wish_ == desk_.wish);
    send_wish();
}

// Redraws at once while something goes on, rarely when nothing does.
double App::patience() const {
    const bool waits = network_ && desk_.picture.empty();
    const bool glides =
        desk_.transition.under_way() || desk_.timeline.playing() || (desk_.flying && desk_.dragging);
    return glides ? 0.01 : waits || ImGui::GetTime() < active_until_ ? 0.03 : 0.25;
}

void App::collect() {
    desk_.now = std::chrono::steady_clock::now();
    Network::Mail mail = network_ ? network_->collect() : Network::Mail();
    if (mail.status) {
        desk_.status = std::move(*mail.status);
        if (desk_.has_cube()) {
            const bool is_another = known_lattice_ && (known_lattice_->n != desk_.lattice().n ||
                                                       known_lattice_->spacing != desk_.lattice().spacing);
            if (is_another) {
                desk_.transition.stop();
                model::reset(desk_.wish.viewpoint);
                desk_.wish.crop.reset();
                desk_.eyes = {};
            }
            if (is_another || (known_lattice_ && known_name_ != desk_.status.cube->name)) {
                desk_.wish.scaling.reset();
            }
            known_lattice_ = desk_.lattice();
            known_name_ = desk_.status.cube->name;
        }
    }
    if (desk_.has_cube() && options_.crop && !std::exchange(crop_told_, true)) {
        if (const auto valid = view::validate_crop(*options_.crop, desk_.lattice().n); !valid) {
            desk_.say(valid.error().message(), true);
        }
    }
    if (auto tf = anchoring_.settle(desk_.status, desk_.wish.tf, desk_.now)) {
        desk_.wish.tf = *std::move(tf);
    }
    if (!anchoring_.fault().empty() && !fault_told_) {
        fault_told_ = true;
        desk_.editor.message = anchoring_.fault();
        desk_.editor.is_fault = true;
    }
    if (mail.picture) {
        desk_.picture_revision = mail.picture->revision;
        desk_.picture_quality = mail.picture->quality;
        desk_.seen = std::make_shared<const model::Picture>(*std::move(mail.picture));
        picture_wish_ = std::move(mail.picture_wish);
        upload();
    }
    if (mail.picked) {
        on_picked(*mail.picked);
    }
}

// The picture, or both eyes' as one or apart.
void App::upload() {
    const model::Picture& seen = *desk_.seen;
    if (!desk_.shown || seen.right.empty()) {
        desk_.picture.upload(seen.pixels);
    } else if (image::is_apart(*desk_.shown)) {
        desk_.picture.upload(seen.pixels);
        desk_.right_picture.upload(seen.right);
    } else {
        desk_.picture.upload(image::composed(seen.pixels, seen.right, *desk_.shown));
    }
}

void App::widgets() {
    desk_.controls.begin_pass();
    desk_.dragging = false;
    desk_.retry = false;
    desk_.connect_elsewhere = false;
    desk_.cancel = false;
    desk_.escape = false;
    if (std::exchange(desk_.reshown, false) && desk_.seen) {
        upload();
    }
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const float panel_size = desk_.panel ? std::min(desk_.px(panel_width), all.x / 2) : 0;
    const float status_size = desk_.px(status_height);
    const bool has_dock =
        desk_.dock && all.x - panel_size >= desk_.px(dock_width) && all.y >= 2 * desk_.px(dock_height);
    const float dock_size = has_dock ? desk_.px(dock_height) : 0;
    const ImVec2 picture{all.x - panel_size, std::max(all.y - status_size - dock_size, 1.0F)};
    keys();
    navigate_on(desk_, window_);
    play_on(desk_);
    begin_editor_pass(desk_);
    picture_area(desk_, {0, 0}, picture);
    progress_card(desk_, {0, 0}, picture);
    if (has_dock) {
        dock(desk_, {0, picture.y}, {picture.x, dock_size});
    }
    status_line(desk_, {0, all.y - status_size}, {picture.x, status_size});
    if (desk_.panel) {
        panel(desk_, {picture.x, 0}, {panel_size, all.y});
    }
}

void App::keys() {
    const bool typing = ImGui::GetIO().WantTextInput;
    for (const KeyPress& press : window_.take_keys()) {
        // The dialog is left by its key, though a field of it has the keys.
        if (!typing || (desk_.in_dialog && press.key == GLFW_KEY_ESCAPE)) {
            on_key(press);
        }
    }
}

void App::on_key(const KeyPress& press) {
    if (desk_.in_dialog) {
        desk_.escape = desk_.escape || press.key == GLFW_KEY_ESCAPE;
        return;
    }
    if (navigate_by_key(desk_, press)) {
        return;
    }
    if (press.control) {
        on_control_key(press);
        return;
    }
    switch (press.key) {
        case GLFW_KEY_TAB:
            desk_.panel = !desk_.panel;
            break;
        case GLFW_KEY_E:
            desk_.dock = !desk_.dock;
            break;
        case GLFW_KEY_DELETE:
        case GLFW_KEY_BACKSPACE:
            delete_selected(desk_);
            break;
        case GLFW_KEY_ESCAPE:
            desk_.escape = true;
            break;
        case GLFW_KEY_B:
            desk_.boxed = !desk_.boxed;
            break;
        case GLFW_KEY_C:
            model::step_map(desk_.wish.tf, press.shift ? -1 : 1);
            break;
        case GLFW_KEY_I:
            model::reverse_colours(desk_.wish.tf);
            break;
        default:
            break;
    }
}

void App::on_control_key(const KeyPress& press) {
    switch (press.key) {
        case GLFW_KEY_Q:
            window_.close();
            break;
        case GLFW_KEY_Z:
            (press.shift ? desk_.redo : desk_.undo) = true;
            break;
        case GLFW_KEY_Y:
            desk_.redo = true;
            break;
        case GLFW_KEY_S:
            desk_.files.save = true;
            break;
        case GLFW_KEY_O:
            desk_.files.open = true;
            break;
        case GLFW_KEY_N:
            desk_.connect_elsewhere = true;
            break;
        case GLFW_KEY_P:
            desk_.files.picture = true;
            break;
        default:
            break;
    }
}

// Undo and redo, then what has been changed otherwise.
void App::remember() {
    for (const bool back : {true, false}) {
        if (std::exchange(back ? desk_.undo : desk_.redo, false)) {
            if (const auto state = back ? desk_.history.undo() : desk_.history.redo()) {
                desk_.transition.stop();
                model::restore(*state, desk_.wish);
            }
        }
    }
    if (desk_.has_cube()) {
        desk_.history.observe(model::remembered(desk_.wish), desk_.dragging, desk_.now);
    }
}

void App::on_picked(const model::Picked& picked) {
    if (picked.purpose == model::Purpose::read) {
        if (desk_.read_at == picked.at) {
            desk_.read = picked;
        }
    } else if (!desk_.has_cube()) {
        return;
    } else if (picked.hit) {
        const view::Vec3 point = desk_.lattice().world_from_voxel(picked.hit->voxel);
        desk_.jump_by([&](model::Viewpoint& to) { model::set_pivot(to, point, desk_.lattice()); });
        desk_.tell("Turning about " + place_text(desk_, picked.hit->voxel, "   "));
    } else {
        desk_.say(picked.incomplete ? "What is there is not loaded" : "There is nothing to turn about");
    }
}

void App::send_wish() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool any_input = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 ||
                           ImGui::IsAnyMouseDown() || desk_.dragging;
    if (any_input) {
        active_until_ = ImGui::GetTime() + 0.3;
    }
    desk_.wish.stereo = desk_.shown ? std::optional(desk_.eyes) : std::nullopt;
    if (!network_) {
        return;
    }
    if (desk_.retry) {
        network_->retry();
    }
    if (desk_.effort != sent_effort_) {
        sent_effort_ = desk_.effort;
        network_->set_effort(sent_effort_);
    }
    if (desk_.wish != sent_) {
        sent_ = desk_.wish;
        network_->want(sent_, desk_.dragging ? model::Change::dragging : model::Change::single);
    }
    if (const auto pick = std::exchange(desk_.pick, std::nullopt)) {
        network_->pick(pick->purpose, pick->at);
    }
}

bool App::is_settled() const {
    const model::Status& status = desk_.status;
    const bool is_composed = desk_.shown && !image::is_apart(*desk_.shown);
    const view::ImageSize wanted =
        is_composed ? image::composed_size(desk_.wish.size, *desk_.shown) : desk_.wish.size;
    return !anchoring_.pending() && status.connection == model::Connection::connected && status.frame &&
           status.frame->missing.empty() && !status.frame->sketch && desk_.picture_revision == status.sent &&
           desk_.picture_quality == desk_.best_quality() && desk_.picture.width() == wanted.width &&
           desk_.picture.height() == wanted.height;
}

}  // namespace shearwater::ui
