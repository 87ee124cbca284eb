#include "client/view/app.h"

#include <GLFW/glfw3.h>

#include <algorithm>

#include "client/model/look.h"
#include "client/view/panel.h"
#include "client/view/picture_area.h"
#include "common/image/png.h"

namespace shearwater::ui {

namespace {

// A change of colour map by `step` places in the menu, keeping the direction.
void step_map(view::TransferFunction& tf, int step) {
    const std::vector<std::string> names = view::colour_map_names();
    const std::string current = model::map_name_of(tf.colour_pins);
    const bool reversed = current.ends_with("-r");
    const std::string plain = reversed ? current.substr(0, current.size() - 2) : current;
    const auto found = std::find(names.begin(), names.end(), plain);
    const int count = static_cast<int>(names.size());
    const int from = found == names.end() ? -step : static_cast<int>(found - names.begin());
    const std::string& to = names[static_cast<std::size_t>((from + step + count) % count)];
    tf.colour_pins = view::colour_map(to + (reversed ? "-r" : "")).value();
}

void reverse_map(view::TransferFunction& tf) {
    const std::string name = model::map_name_of(tf.colour_pins);
    if (!name.empty()) {
        const std::string to = name.ends_with("-r") ? name.substr(0, name.size() - 2) : name + "-r";
        tf.colour_pins = view::colour_map(to).value();
    }
}

}  // namespace

App::App(Window& window, Network& network, AppOptions options)
    : window_(window),
      network_(network),
      options_(std::move(options)),
      desk_(window.fonts(), window.scale()) {
    desk_.wish.tf = options_.tf;
    desk_.status.words = "Starting ...";
}

base::Status App::run() {
    while (!window_.is_closing()) {
        window_.begin(patience());
        collect();
        widgets();
        send_wish();
        window_.draw();
        settled_passes_ = is_settled() ? settled_passes_ + 1 : 0;
        constexpr int passes_to_settle = 3;
        if (!options_.screenshot.empty() && settled_passes_ >= passes_to_settle) {
            return image::write_png(options_.screenshot, window_.read_pixels());
        }
        window_.show();
        if (!options_.screenshot.empty() && desk_.status.connection == model::Connection::refused) {
            return base::error(base::Code::refused, "take the screenshot", desk_.status.words);
        }
    }
    return {};
}

// Redraws at once while something goes on, rarely when nothing does.
double App::patience() const {
    const bool waits = desk_.picture.empty() || !options_.screenshot.empty();
    return waits || ImGui::GetTime() < active_until_ ? 0.03 : 0.25;
}

void App::collect() {
    Network::Mail mail = network_.collect();
    if (mail.status) {
        desk_.status = std::move(*mail.status);
        if (desk_.has_cube()) {
            const bool is_another = known_lattice_ && (known_lattice_->n != desk_.lattice().n ||
                                                       known_lattice_->spacing != desk_.lattice().spacing);
            if (is_another) {
                desk_.wish.viewpoint =
                    model::Viewpoint{.orbit = {}, .projection = desk_.wish.viewpoint.projection};
            }
            known_lattice_ = desk_.lattice();
        }
    }
    if (mail.picture) {
        desk_.picture.upload(mail.picture->pixels);
        desk_.picture_revision = mail.picture->revision;
        desk_.picture_quality = mail.picture->quality;
    }
}

void App::widgets() {
    desk_.dragging = false;
    desk_.retry = false;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const float panel_size = desk_.panel ? std::min(desk_.px(panel_width), all.x / 2) : 0;
    const float status_size = desk_.px(status_height);
    const ImVec2 picture{all.x - panel_size, std::max(all.y - status_size, 1.0F)};
    keys();
    picture_area(desk_, {0, 0}, picture);
    status_line(desk_, {0, picture.y}, {picture.x, status_size});
    if (desk_.panel) {
        panel(desk_, {picture.x, 0}, {panel_size, all.y});
    }
}

void App::keys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput) {
        return;
    }
    const auto pressed = [](int key, bool repeat = false) { return ImGui::IsKeyPressed(key, repeat); };
    model::Viewpoint& viewpoint = desk_.wish.viewpoint;
    if (pressed(GLFW_KEY_TAB)) {
        desk_.panel = !desk_.panel;
    }
    if (pressed(GLFW_KEY_Q) && io.KeyCtrl) {
        window_.close();
    }
    if (pressed(GLFW_KEY_R)) {
        viewpoint = model::Viewpoint{.orbit = {}, .projection = viewpoint.projection};
    }
    if (pressed(GLFW_KEY_P)) {
        model::toggle_projection(viewpoint);
    }
    if (pressed(GLFW_KEY_C, true)) {
        step_map(desk_.wish.tf, io.KeyShift ? -1 : 1);
    }
    if (pressed(GLFW_KEY_I)) {
        reverse_map(desk_.wish.tf);
    }
    // A step of the arrow keys turns by 5 degrees.
    const double step = desk_.wish.size.height * 5.0 / 180;
    const double dx = step * (pressed(GLFW_KEY_LEFT, true) - pressed(GLFW_KEY_RIGHT, true));
    const double dy = step * (pressed(GLFW_KEY_UP, true) - pressed(GLFW_KEY_DOWN, true));
    if (dx != 0 || dy != 0) {
        model::drag_orbit(viewpoint, dx, dy, desk_.wish.size);
        desk_.dragging = true;
    }
    const bool in = pressed(GLFW_KEY_EQUAL, true) || pressed(GLFW_KEY_KP_ADD, true);
    const bool out = pressed(GLFW_KEY_MINUS, true) || pressed(GLFW_KEY_KP_SUBTRACT, true);
    if (desk_.has_cube() && in != out) {
        const auto& size = desk_.wish.size;
        model::zoom(viewpoint, in ? 0.9 : 1 / 0.9, size.width / 2.0, size.height / 2.0, size,
                    desk_.lattice());
        desk_.dragging = true;
    }
}

void App::send_wish() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool any_input = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 ||
                           ImGui::IsAnyMouseDown() || desk_.dragging;
    if (any_input) {
        active_until_ = ImGui::GetTime() + 0.3;
    }
    if (desk_.retry) {
        network_.retry();
    }
    if (desk_.wish != sent_) {
        sent_ = desk_.wish;
        network_.want(sent_, desk_.dragging ? model::Change::dragging : model::Change::single);
    }
}

// The newest view is seen, whole and in high quality.
bool App::is_settled() const {
    const model::Status& status = desk_.status;
    return status.connection == model::Connection::connected && status.frame &&
           status.frame->missing.empty() && desk_.picture_revision == status.sent &&
           desk_.picture_quality == view::Quality::high && desk_.picture.width() == desk_.wish.size.width &&
           desk_.picture.height() == desk_.wish.size.height;
}

}  // namespace shearwater::ui
