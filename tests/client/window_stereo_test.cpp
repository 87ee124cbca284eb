// Pairs of pictures and the crop box, by the panel and by the mouse over the picture.

#include <sstream>

#include "tests/client/window_fixture.h"
#include "tests/support/desktop.h"

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

// Beside the desk's window, one for each eye; both are of one pair, and go when one is closed.
class EyeWindowsTest : public WindowStereoTest {
  protected:
    static constexpr int eye_width = 300, eye_height = 200;

    EyeWindowsTest() { screen_width_ = width + eye_width; }

    // On the right edge of the screen, the left eye's above the right one's.
    void place_windows() {
        display_->place_window("left eye", width, 0, eye_width, eye_height);
        display_->place_window("right eye", width, eye_height, eye_width, eye_height);
    }
    struct Spot {
        double light = 0, x = 0;  // of its middle, from the window's left
    };
    static Spot spot_of(const Picture& screen, int from_y) {
        Spot spot;
        for (int y = from_y; y < from_y + eye_height; ++y) {
            for (int x = 0; x < eye_width; ++x) {
                const int b = brightness(screen.at(width + x, y));
                spot.light += b > 30 ? b : 0;
                spot.x += b > 30 ? b * x : 0;
            }
        }
        spot.x /= std::max(spot.light, 1.0);
        return spot;
    }
    // Once both show something, and that stays.
    std::pair<Spot, Spot> spots(const std::function<bool(double)>& apart_by) {
        std::pair<Spot, Spot> last;
        EXPECT_TRUE(wait_for([&] {
            std::this_thread::sleep_for(300ms);
            const Picture screen = display_->grab();
            const auto now = std::pair(spot_of(screen, 0), spot_of(screen, eye_height));
            const bool stays = now.first.x == last.first.x && now.second.x == last.second.x;
            last = now;
            return stays && now.first.light > 1e4 && now.second.light > 1e4 &&
                   apart_by(now.first.x - now.second.x);
        })) << "left at "
            << last.first.x << ", right at " << last.second.x << "\n"
            << text_of(folder_ / "client.log");
        return last;
    }
};

TEST_F(EyeWindowsTest, EachEyeHasAWindow) {
    start_tree();
    open_window({"--stereo", "two-windows", "--eye-separation", "8", "--convergence", "400"});
    const Picture desk = lit("the left eye's picture at the desk");
    place_windows();
    // What is nearer than where the axes meet is seen farther to the right by the left eye.
    const auto [one, other] = spots([](double apart) { return apart > 3; });
    EXPECT_NEAR(other.light / one.light, 1, 0.2);

    // The desk steers both.
    display_->drag(1, middle_x, middle_y, 120, 40);
    other_than(desk, "a turn by the mouse");
    spots([](double apart) { return apart > 3; });

    ASSERT_EQ(test::ask_to_close(display_->name(), "right eye"), "");
    EXPECT_TRUE(wait_for([&] {
        const Picture screen = display_->grab();
        return spot_of(screen, 0).light == 0 && spot_of(screen, eye_height).light == 0;
    })) << "an eye's window stays";
    lit("one picture at the desk");
    EXPECT_TRUE(window_->running());
}

// Nothing here has such buffers: what asks for them is shown otherwise, and told so.
TEST_F(WindowStereoTest, BuffersForEachEyeAreNotToBeHadHere) {
    start_tree();
    open_window({"--stereo", "quad-buffered"});
    const Picture beside = lit("two pictures");
    const double on_left = light_between(beside, left, middle_x);
    const double on_right = light_between(beside, middle_x, 2 * middle_x - left);
    EXPECT_NEAR(on_right / on_left, 1, 0.2);
}

}  // namespace
}  // namespace shearwater::window_test
