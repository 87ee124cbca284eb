#include "client/view/app.h"

#include <GLFW/glfw3.h>

#include <algorithm>

#include "client/model/colours.h"
#include "client/view/dock.h"
#include "client/view/function_tab.h"
#include "client/view/panel.h"
#include "client/view/picture_area.h"
#include "common/image/png.h"

namespace shearwater::ui {

App::App(Window& window, Network& network, AppOptions options)
    : window_(window),
      network_(network),
      options_(std::move(options)),
      presets_(PresetFolder::of_user(), Window::wake),
      desk_(window.fonts(), window.scale(), presets_),
      anchoring_(options_.tf) {
    desk_.wish.level_of_detail = options_.level_of_detail;
    desk_.wish.classify = options_.classify;
    desk_.wish.culling = options_.culling;
    desk_.effort = options_.effort;
    desk_.status.words = "Starting ...";
}

base::Status App::run() {
    while (!window_.is_closing()) {
        window_.begin(patience());
        collect();
        widgets();
        send_wish();
        if (!options_.controls.empty()) {
            if (auto written = desk_.controls.write(options_.controls); !written) {
                return written;
            }
        }
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
        if (!options_.screenshot.empty() && fault_told_) {
            return base::error(base::Code::unsupported, "take the screenshot", anchoring_.fault());
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
                desk_.reset_view();
            }
            known_lattice_ = desk_.lattice();
        }
    }
    if (auto tf = anchoring_.settle(desk_.status, desk_.wish.tf, std::chrono::steady_clock::now())) {
        desk_.wish.tf = *std::move(tf);
    }
    if (!anchoring_.fault().empty() && !fault_told_) {
        fault_told_ = true;
        desk_.editor.message = anchoring_.fault();
        desk_.editor.is_fault = true;
    }
    if (mail.picture) {
        desk_.picture.upload(mail.picture->pixels);
        desk_.picture_revision = mail.picture->revision;
        desk_.picture_quality = mail.picture->quality;
    }
}

void App::widgets() {
    desk_.controls.begin_pass();
    desk_.dragging = false;
    desk_.retry = false;
    desk_.escape = false;
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    const float panel_size = desk_.panel ? std::min(desk_.px(panel_width), all.x / 2) : 0;
    const float status_size = desk_.px(status_height);
    const bool has_dock =
        desk_.dock && all.x - panel_size >= desk_.px(dock_width) && all.y >= 2 * desk_.px(dock_height);
    const float dock_size = has_dock ? desk_.px(dock_height) : 0;
    const ImVec2 picture{all.x - panel_size, std::max(all.y - status_size - dock_size, 1.0F)};
    keys();
    begin_editor_pass(desk_);
    picture_area(desk_, {0, 0}, picture);
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
        if (!typing) {
            on_key(press);
        }
    }
}

void App::on_key(const KeyPress& press) {
    model::Viewpoint& viewpoint = desk_.wish.viewpoint;
    const view::ImageSize& size = desk_.wish.size;
    const auto turn = [&](int right, int down) {
        const double step = size.height * 5.0 / 180;  // 5 degrees
        model::drag_orbit(viewpoint, step * right, step * down, size);
        desk_.dragging = true;
    };
    const auto zoom = [&](double factor) {
        if (desk_.has_cube()) {
            model::zoom(viewpoint, factor, size.width / 2.0, size.height / 2.0, size, desk_.lattice());
            desk_.dragging = true;
        }
    };
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
        case GLFW_KEY_R:
            desk_.reset_view();
            break;
        case GLFW_KEY_P:
            model::toggle_projection(viewpoint);
            break;
        case GLFW_KEY_C:
            model::step_map(desk_.wish.tf, press.shift ? -1 : 1);
            break;
        case GLFW_KEY_I:
            model::reverse_colours(desk_.wish.tf);
            break;
        case GLFW_KEY_LEFT:
            turn(1, 0);
            break;
        case GLFW_KEY_RIGHT:
            turn(-1, 0);
            break;
        case GLFW_KEY_UP:
            turn(0, 1);
            break;
        case GLFW_KEY_DOWN:
            turn(0, -1);
            break;
        case GLFW_KEY_EQUAL:
        case GLFW_KEY_KP_ADD:
            zoom(0.9);
            break;
        case GLFW_KEY_MINUS:
        case GLFW_KEY_KP_SUBTRACT:
            zoom(1 / 0.9);
            break;
        case GLFW_KEY_Q:
            if (press.control) {
                window_.close();
            }
            break;
        default:
            break;
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
    if (desk_.effort != sent_effort_) {
        sent_effort_ = desk_.effort;
        network_.set_effort(sent_effort_);
    }
    if (desk_.wish != sent_) {
        sent_ = desk_.wish;
        network_.want(sent_, desk_.dragging ? model::Change::dragging : model::Change::single);
    }
}

// The newest view is seen, whole and as good as it gets.
bool App::is_settled() const {
    const model::Status& status = desk_.status;
    return !anchoring_.pending() && status.connection == model::Connection::connected && status.frame &&
           status.frame->missing.empty() && !status.frame->sketch && desk_.picture_revision == status.sent &&
           desk_.picture_quality == desk_.best_quality() && desk_.picture.width() == desk_.wish.size.width &&
           desk_.picture.height() == desk_.wish.size.height;
}

}  // namespace shearwater::ui
