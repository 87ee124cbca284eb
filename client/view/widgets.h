#pragma once
// Small things that the panel and the picture are made of.

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "client/view/desk.h"

namespace shearwater::ui {

// "1.2 MB", "310 kB", "17 B".
std::string bytes_text(double bytes);
// A physical value in a few characters.
std::string value_text(double value);

void text(ImU32 colour, const std::string& text);
void small_text(const Desk& desk, ImU32 colour, const std::string& text);
// The heading of a section of the panel, which a click folds or unfolds. Whether it is unfolded.
bool section(Desk& desk, const char* title, bool unfolded_at_first = true);
// A filled circle of the line's height, where the cursor is; the next item follows on the same line.
void dot(const Desk& desk, ImU32 colour);
// Buttons side by side, one of which holds. The one that does afterwards. They are noted as NAME/LABEL.
int switch_among(Desk& desk, const std::string& name, std::initializer_list<const char*> labels, int holds);
// Buttons side by side, noted likewise. The one that was pressed, or -1.
int button_row(Desk& desk, const std::string& name, std::initializer_list<const char*> labels);
// A choice that drops down, closed again by the escape key: true while it is open, and ImGui::EndCombo() is
// to follow its entries. It is noted as `control`.
bool begin_choice(Desk& desk, const char* id, const std::string& shown, const std::string& control,
                  const char* tip = nullptr);
// A number that is typed; true when another one has been, by the enter key or by going elsewhere.
bool number_field(Desk& desk, const std::string& id, double& value);
// A share done, thin.
void progress_line(const Desk& desk, double fraction, ImU32 colour, float width);
// The pins' colours from left to right.
void draw_gradient(ImDrawList& list, const std::vector<view::ColourPin>& pins, ImVec2 from, ImVec2 to,
                   float rounding);

ImU32 colour_of(const view::Rgb& rgb, double alpha = 1);

}  // namespace shearwater::ui
