#pragma once
// A real window that was opened with a session, and what it keeps of its view: the model as a person would
// see it.

#include "common/scene/file.h"
#include "tests/client/window_fixture.h"

namespace shearwater::window_test {

class SessionWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        if (IsSkipped()) {
            return;
        }
        environment_ = environment();
        environment_["XDG_STATE_HOME"] = (folder_ / "state").string();
        start_tree();
        open({"--session", first_session()});
    }

    std::string first_session() {
        const std::string path = (folder_ / "view.toml").string();
        scene::Scene scene{.size = {656, 614}};
        scene.viewpoint.orbit.azimuth = 20;
        EXPECT_TRUE(scene::write(path, scene));
        return path;
    }
    void open(std::vector<std::string> more) {
        std::filesystem::remove(folder_ / "controls");  // an earlier window's
        window_ =
            std::make_unique<test::Process>(client(std::move(more)), environment_, folder_ / "client.log");
        control("camera/Fit");  // is there
    }

    // The view as the window saves it, once it `holds` and has come to rest.
    scene::Scene saved(const std::function<bool(const scene::Scene&)>& holds, const char* what) {
        scene::Scene last;
        const bool seen = wait_for([&] {
            const scene::Scene before = last;
            display_->tap("ctrl+s");
            std::this_thread::sleep_for(100ms);
            const auto read = scene::read((folder_ / "view.toml").string());
            last = read ? *read : last;
            return read && holds(*read) && *read == before;
        });
        EXPECT_TRUE(seen) << what << ":\n"
                          << scene::to_toml(last) << text_of(folder_ / "client.log")
                          << text_of(folder_ / "tree.log");
        return last;
    }

    std::map<std::string, std::string> environment_;
};

}  // namespace shearwater::window_test
