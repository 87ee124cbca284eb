// A window that asks where the cube is, and shows one after another.

#include <cstdlib>

#include "tests/client/window_fixture.h"
#include "tests/support/desktop.h"

namespace shearwater::window_test {
namespace {

class DialogTest : public WindowTest {
  protected:
    // A window without a secret in its environment, that finds `ssh` in our folder.
    void open_asking(std::vector<std::string> more = {}) {
        auto alone = environment();
        alone["PATH"] = folder_.path().string() + ":" + std::getenv("PATH");
        std::vector<std::string> command{"env", "-u", "SHEARWATER_SECRET"};
        const std::vector<std::string> window = client(std::move(more));
        std::copy_if(window.begin(), window.end(), std::back_inserter(command),
                     [&](const std::string& word) { return word != "--connect" && word != server(); });
        std::filesystem::remove(folder_ / "controls");
        window_ = std::make_unique<test::Process>(command, alone, folder_ / "client.log");
    }
    void script(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name) << "#!/bin/sh\n" << text << "\n";
        std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
    }
    std::string recent() const { return text_of(folder_ / "state/shearwater/recent.toml"); }
    std::string cube() const { return (folder_ / "cube.fits").string(); }
    // The secret's file as `serve` is told it; the other tests have theirs in the environment.
    std::string keep_secret() {
        const auto path = folder_ / "secret";
        std::ofstream(path) << secret_ << "\n";
        std::filesystem::permissions(path, std::filesystem::perms::owner_read);
        return path.string();
    }
    // Whatever has been typed before; a field that has the keys already is not selected by a click.
    void type_into(const std::string& name, const std::string& text) {
        click(name);
        display_->key("ctrl+a");
        display_->type(text);
        display_->key("Return");
    }
    void expect_fault(const char* what) {
        EXPECT_TRUE(wait_for([this] { return has_control("connect/fault"); })) << what;
    }
    // The picture that is there once nothing is asked, nor waited for.
    Picture seen(const char* what) {
        gone("connect/Connect");
        gone("progress/Cancel");
        return lit(what);
    }
    // Processes whose command lines hold these words.
    static bool runs(const std::string& words) {
        for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
            std::string line = text_of(entry.path() / "cmdline");
            std::ranges::replace(line, '\0', ' ');
            if (line.find(words) != std::string::npos) {
                return true;
            }
        }
        return false;
    }
};

TEST_F(DialogTest, CubesAndServersAreTypedOneAfterAnother) {
    open_asking();
    control("connect/Connect");
    EXPECT_FALSE(has_control("connect/Close")) << "there is nothing behind it";
    type_into("connect/place", (folder_ / "nothing.fits").string());
    expect_fault("the server's own words on a file that is not there");
    EXPECT_EQ(recent(), "");

    type_into("connect/place", cube());
    const Picture first = seen("the local cube's picture");
    EXPECT_TRUE(wait_for([this] { return recent().find("cube.fits") != std::string::npos; }));
    display_->drag(1, middle_x, middle_y, 100, 30);
    other_than(first, "a turn by the mouse");

    // A server with another cube, by its secret.
    start_tree("synthetic:random:24");
    click("link/Connect to");
    control("connect/Close");
    type_into("connect/place", server());
    type_into("connect/secret", "not-the-secret-0123456789");
    expect_fault("a wrong secret");
    EXPECT_TRUE(wait_for([this] { return !runs("shearwater-server " + cube()); }))
        << "the first cube's tree is left behind";
    type_into("connect/secret", secret_);
    const Picture second = seen("the server's picture");
    EXPECT_GT(difference(first, second), 0.002);

    // By the list, another window: the view starts anew.
    ASSERT_TRUE(wait_for([this] { return recent().find(server()) != std::string::npos; }));
    EXPECT_LT(recent().find(server()), recent().find("cube.fits")) << recent();
    window_.reset();
    open_asking();
    click("connect/recent/1");
    seen("the local cube again");
    like(first, "the local cube again");
    window_.reset();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "state")) {
        const std::string text = entry.is_regular_file() ? text_of(entry.path()) : "";
        EXPECT_EQ(text.find(secret_), std::string::npos) << entry.path();
        EXPECT_EQ(text.find("not-the-secret"), std::string::npos) << entry.path();
    }
    EXPECT_TRUE(wait_for([this] { return !runs("shearwater-server " + cube()); }));
}

// What never answers is waited for until it is cancelled, and goes with it.
TEST_F(DialogTest, WaitingIsCancelledAndRemembersNothing) {
    script("ssh", "exec sleep 7357");
    std::filesystem::create_directories(folder_ / "state/shearwater");
    std::ofstream(folder_ / "state/shearwater/recent.toml") << "\xff nonsense";
    open_asking();
    type_into("connect/place", "ann@big:/data/galaxy.fits");
    click("progress/Cancel");
    control("connect/Connect");
    EXPECT_TRUE(wait_for([] { return !runs("sleep 7357"); }));
    EXPECT_TRUE(window_->running());

    script("ssh", "echo 'ssh: Could not resolve hostname big' >&2; exit 255");
    click("connect/Connect");
    expect_fault("ssh's own words");
    EXPECT_EQ(recent(), "\xff nonsense");

    // Its third word is the command for the far shell.
    script("ssh", "PATH=" + std::string(SHEARWATER_BIN) + ":$PATH; exec sh -c \"$3\"");
    type_into("connect/place", "ann@big:" + cube());
    seen("the picture through ssh");
    EXPECT_TRUE(wait_for([this] { return recent().find("ann@big:") != std::string::npos; })) << recent();
    click("link/Connect to");
    click("connect/remove/0");
    EXPECT_TRUE(wait_for([this] { return recent().find("ann@big:") == std::string::npos; })) << recent();
}

// Dropped on the window as a file manager does it, once that asks and once in place of another.
TEST_F(DialogTest, CubesAreDropped) {
    open_asking();
    control("connect/Connect");
    ASSERT_EQ(test::drop_file(display_->name(), cube(), middle_x, middle_y), "");
    const Picture first = seen("the dropped cube's picture");
    const std::string other = (folder_ / "other.fits").string();
    test::Process sample({program("shearwater"), "sample", "ball", "--size", "40", "40", "40", "-o", other},
                         environment(), folder_ / "sample.log");
    ASSERT_EQ(sample.wait(120s), 0) << text_of(folder_ / "sample.log");
    ASSERT_EQ(test::drop_file(display_->name(), other, middle_x, middle_y), "");
    other_than(first, "the other cube's picture");
    EXPECT_TRUE(wait_for([&] { return recent().find("other.fits") != std::string::npos; })) << recent();
}

// Where nothing is named, `view` asks too; a secret's file is kept by its name.
TEST_F(DialogTest, ASecretsFileIsNamed) {
    start_tree();
    const std::string file = keep_secret();
    open_asking();
    type_into("connect/place", server());
    click("connect/Name its file");
    type_into("connect/secret file", file);
    seen("the server's picture");
    ASSERT_TRUE(wait_for([this] { return recent().find(server()) != std::string::npos; }));
    EXPECT_NE(recent().find(file), std::string::npos) << recent();
    window_.reset();
    open_asking();
    click("connect/recent/0");
    seen("the same by the list");
}

}  // namespace
}  // namespace shearwater::window_test
