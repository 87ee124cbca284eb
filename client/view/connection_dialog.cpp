#include "client/view/connection_dialog.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "client/view/widgets.h"

namespace shearwater::ui {

namespace {

constexpr const char* title = "Connect";
constexpr float width = 560;  // nominal pixels

template <std::size_t N>
void fill(std::array<char, N>& field, const std::string& text) {
    field.fill('\0');
    if (text.size() < N) {
        std::ranges::copy(text, field.begin());
    }
}

void wipe(std::array<char, 4097>& secret) {
    // By way of volatile, so that no compiler leaves it out.
    for (volatile char& c : secret) {
        c = 0;
    }
}

// Its end, which tells files apart, with dots where the beginning has no room.
std::string shortened(const std::string& name, float room) {
    std::string words = base::printable(name, name.size());
    for (std::size_t left = words.size(); left > 0; left -= std::max<std::size_t>(left / 32, 1)) {
        const std::string tail = left < words.size() ? "..." + words.substr(words.size() - left) : words;
        if (ImGui::CalcTextSize(tail.c_str()).x <= room) {
            return tail;
        }
    }
    return "...";
}

void wrapped(ImU32 colour, const std::string& words) {
    if (!words.empty()) {
        ImGui::PushTextWrapPos(0);
        text(colour, words);
        ImGui::PopTextWrapPos();
    }
}

bool field(Desk& desk, const char* id, const char* hint, std::span<char> bytes, ImGuiInputTextFlags flags,
           const char* control) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1);
    const bool entered = ImGui::InputTextWithHint(
        id, hint, bytes.data(), bytes.size(),
        flags | ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopStyleVar();
    desk.controls.note(control);
    return entered;
}

}  // namespace

model::Here here() {
    std::error_code none;
    const char* const home = std::getenv("HOME");
    return {.exists =
                [](const std::string& path) {
                    std::error_code ignored;
                    return std::filesystem::exists(path, ignored);
                },
            .folder = std::filesystem::current_path(none).string(),
            .home = home != nullptr ? home : ""};
}

void ConnectionDialog::open(const model::Recent& begin, std::string fault, std::string advice) {
    if (!begin.name.empty()) {
        fill(place_, begin.name);
        fill(secret_file_, begin.secret_file);
        secret_by_ = begin.secret_file.empty() ? SecretBy::typing : SecretBy::file;
    }
    reopen(std::move(fault), std::move(advice));
}

void ConnectionDialog::reopen(std::string fault, std::string advice) {
    appearing_ = !open_;
    open_ = true;
    fault_ = std::move(fault);
    advice_ = std::move(advice);
    classify();
}

void ConnectionDialog::close() {
    open_ = false;
    wipe(secret_);
}

base::Result<link::Secret> ConnectionDialog::take_secret() {
    auto secret = link::Secret::from_text(secret_.data());
    wipe(secret_);
    return secret;
}

void ConnectionDialog::classify() {
    const auto read = model::place_from(place_.data(), here());
    read_ = read ? std::optional(*read) : std::nullopt;
}

ConnectionDialog::Wish ConnectionDialog::draw(Desk& desk, std::span<const model::Recent> recent,
                                              const std::string& remark, bool may_close) {
    if (!open_) {
        return {};
    }
    if (!ImGui::IsPopupOpen(title)) {
        ImGui::OpenPopup(title);
        appearing_ = true;
    }
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({std::round(all.x / 2), std::round(all.y / 2)}, 0, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(desk.px(width), all.x - desk.px(16)), 0});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {all.x, all.y - desk.px(16)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, desk.px(8));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {desk.px(22), desk.px(18)});
    Wish wish;
    if (ImGui::BeginPopupModal(title, nullptr,
                               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoNav)) {
        wish = draw_content(desk, recent, remark, may_close);
        if (wish.connect || wish.close) {
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
    return wish;
}

ConnectionDialog::Wish ConnectionDialog::draw_content(Desk& desk, std::span<const model::Recent> recent,
                                                      const std::string& remark, bool may_close) {
    Wish wish;
    ImGui::PushFont(desk.fonts.bold);
    ImGui::TextUnformatted("Where is the cube?");
    ImGui::PopFont();
    ImGui::Dummy({0, desk.px(2)});
    bool connect = place_field(desk);
    if (is_server()) {
        connect = secret_field(desk) || connect;
    }
    if (!fault_.empty()) {
        ImGui::Dummy({0, desk.px(2)});
        wrapped(theme::bad, fault_);
        desk.controls.note("connect/fault");
        wrapped(theme::muted, advice_);
    }
    ImGui::Dummy({0, desk.px(4)});
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32(50, 84, 132, 255));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(60, 98, 152, 255));
    connect = ImGui::Button("Connect", {desk.px(112), 0}) || connect;
    desk.controls.note("connect/Connect");
    ImGui::PopStyleColor(2);
    if (may_close) {
        ImGui::SameLine();
        wish.close = ImGui::Button("Close", {desk.px(96), 0}) || desk.escape;
        desk.controls.note("connect/Close");
    }
    recent_rows(desk, recent, wish);
    if (!remark.empty()) {
        ImGui::Dummy({0, desk.px(2)});
        ImGui::PushFont(desk.fonts.small);
        wrapped(theme::busy, remark);
        ImGui::PopFont();
    }
    if (connect) {
        const bool by_file = secret_by_ == SecretBy::file;
        wish.connect = model::Recent{place_.data(), by_file ? secret_file_.data() : ""};
        wish.typed_secret = !by_file && secret_[0] != '\0';
    }
    appearing_ = false;
    return wish;
}

// Whether the enter key was pressed in it.
bool ConnectionDialog::place_field(Desk& desk) {
    if (appearing_ && !asks_for_secret()) {
        ImGui::SetKeyboardFocusHere();
    }
    const std::string before = place_.data();
    const bool entered =
        field(desk, "##place", "a path, HOST:PORT or USER@HOST:PATH", place_, 0, "connect/place");
    if (before != place_.data()) {
        fault_.clear();
        classify();
    }
    ImGui::PushFont(desk.fonts.small);
    if (read_) {
        text(theme::muted, model::in_words(*read_));
    } else {
        constexpr std::pair<const char*, const char*> examples[] = {
            {"/data/galaxy.fits", "a FITS cube here, or dropped on the window"},
            {"big.example.org:7500", "a server that runs there"},
            {"ann@big.example.org:/data/galaxy.fits", "a cube on another machine, by ssh"},
        };
        for (const auto& [place, what] : examples) {
            text(theme::text, place);
            ImGui::SameLine(desk.px(272));
            text(theme::muted, what);
        }
    }
    ImGui::PopFont();
    return entered;
}

bool ConnectionDialog::secret_field(Desk& desk) {
    ImGui::Dummy({0, desk.px(2)});
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Its secret");
    ImGui::SameLine(desk.px(280));
    const int by = switch_among(desk, "connect", {"Type it", "Name its file"}, static_cast<int>(secret_by_));
    secret_by_ = by == 1 ? SecretBy::file : SecretBy::typing;
    if (secret_by_ == SecretBy::file) {
        return field(desk, "##secret file", "a file of mode 0600, as \"shearwater serve\" names it",
                     secret_file_, 0, "connect/secret file");
    }
    if (appearing_ && asks_for_secret()) {
        ImGui::SetKeyboardFocusHere();
    }
    return field(desk, "##secret", "it is neither shown nor kept", secret_, ImGuiInputTextFlags_Password,
                 "connect/secret");
}

void ConnectionDialog::recent_rows(Desk& desk, std::span<const model::Recent> recent, Wish& wish) {
    if (recent.empty()) {
        return;
    }
    ImGui::Dummy({0, desk.px(4)});
    small_text(desk, theme::muted, "RECENT");
    const float side = ImGui::GetFrameHeight();
    for (std::size_t n = 0; n < recent.size(); ++n) {
        ImGui::PushID(static_cast<int>(n));
        const float room = ImGui::GetContentRegionAvail().x - side - desk.px(4);
        const ImVec2 from = ImGui::GetCursorScreenPos();
        if (ImGui::Selectable("##recent", false, ImGuiSelectableFlags_DontClosePopups, {room, side})) {
            wish.connect = recent[n];
            open(recent[n]);
        }
        desk.controls.note("connect/recent/" + std::to_string(n));
        const float y = from.y + (side - ImGui::GetFontSize()) / 2;
        ImGui::GetWindowDrawList()->AddText({from.x + desk.px(4), y}, theme::text,
                                            shortened(recent[n].name, room - desk.px(8)).c_str());
        ImGui::SameLine(0, desk.px(4));
        if (ImGui::Button("\u00d7", {side, side})) {
            wish.forget = recent[n].name;
        }
        desk.controls.note("connect/remove/" + std::to_string(n));
        if (ImGui::IsItemHovered()) {
            ImGui::SetTooltip("forget it");
        }
        ImGui::PopID();
    }
}

}  // namespace shearwater::ui
