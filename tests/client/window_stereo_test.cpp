// Pairs of pictures and the crop box, by the panel and by the mouse over the picture.

#include <sstream>

#include "tests/client/window_fixture.h"

namespace shearwater::window_test {
namespace {

struct Place {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Place&) const = default;
};

class WindowStereoTest : public WindowTest {
  protected:
    void open() {
        start_tree();
        open_window();
        // From below, so that none moves before it is met: the panel has no room for all.
        for (const char* title : {"section/QUALITY AND SPEED", "section/CUBE"}) {
            click(title);
        }
    }
    std::optional<Place> place_of(const std::string& name) const {
        std::ifstream lines(file_);
        for (std::string line; std::getline(lines, line);) {
            Place place;
            std::istringstream numbers(line.starts_with(name + " ") ? line.substr(name.size()) : "");
            if (numbers >> place.x >> place.y >> place.width >> place.height) {
                return place;
            }
        }
        return std::nullopt;
    }
    // Where a control is once it is there and stays.
    Place control(const std::string& name) const {
        const auto end = std::chrono::steady_clock::now() + 60s;
        std::optional<Place> last;
        while (std::chrono::steady_clock::now() < end) {
            const auto place = place_of(name);
            if (place && place == last) {
                return *place;
            }
            last = place;
            std::this_thread::sleep_for(400ms);
        }
        ADD_FAILURE() << name << " is not in the window\n" << text_of(file_);
        return {};
    }
    // A share of its width from its left.
    void click(const std::string& name, double along = 0.5) {
        const Place place = control(name);
        display_->click(place.x + static_cast<int>(along * place.width), place.y + place.height / 2);
    }

    const std::filesystem::path file_ = folder_ / "controls";
};

// Of the picture's columns [from, to).
double light_between(const Picture& screen, int from, int to) {
    double sum = 0;
    for (int y = top; y < bottom; ++y) {
        for (int x = from; x < to; ++x) {
            const int b = brightness(screen.at(x, y));
            sum += b > 30 ? b : 0;
        }
    }
    return sum;
}

TEST_F(WindowStereoTest, TheBoxIsSetByThePanelAndByItsHandles) {
    open();
    const Picture plain = lit("the first picture");
    click("section/CROP");
    const Picture whole = other_than(plain, "the cube's edges");
    EXPECT_LT(difference(plain, whole), 0.2);

    click("crop/x0");  // to the middle
    other_than(whole, "half of the cube");
    click("section/CROP");
    const Picture half = other_than(plain, "half of the cube without its edges");
    EXPECT_LT(light_of(half).sum, 0.9 * light_of(plain).sum);
    EXPECT_GT(light_of(half).sum, 0.1 * light_of(plain).sum);
    click("section/CROP");
    click("crop/reset");
    like(whole, "all of it");

    // A handle follows the mouse, along its axis.
    const Place before = control("crop/y-upper");
    display_->drag(1, before.x, before.y, 10, 120);
    other_than(whole, "a box whose top is lowered");
    const Place after = control("crop/y-upper");
    EXPECT_NEAR(after.y - before.y, 120, 20);
    click("crop/reset");
    like(whole, "all of it");
    click("section/CROP");
    like(plain, "no edges");
}

TEST_F(WindowStereoTest, PairsAreShownAsTheSectionSays) {
    open();
    const Picture one = lit("the first picture");
    click("section/STEREO");
    click("stereo/mode");
    click("stereo/mode/side-by-side");
    const Picture beside = other_than(one, "two pictures");
    const int middle = middle_x;
    const double on_left = light_between(beside, left, middle);
    const double on_right = light_between(beside, middle, 2 * middle - left);
    EXPECT_GT(on_left, 1e4);
    EXPECT_NEAR(on_right / on_left, 1, 0.2);

    click("stereo/separation", 0.95);
    const Picture farther = other_than(beside, "eyes farther apart");
    click("stereo/swap");
    other_than(farther, "the eyes swapped");
    click("stereo/defaults");
    click("stereo/swap");
    like(beside, "the defaults");

    click("stereo/mode");
    click("stereo/mode/anaglyph");
    const Picture anaglyph = other_than(one, "an anaglyph");
    EXPECT_GT(light_of(anaglyph).sum, 1e4);
    click("stereo/mode");
    click("stereo/mode/off");
    like(one, "one picture again");
}

}  // namespace
}  // namespace shearwater::window_test
