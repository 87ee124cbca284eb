#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <semaphore>

#include "client/view/preset_shelf.h"
#include "tests/support/temporary_folder.h"

namespace shearwater::ui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

view::AnchoredFunction function(double height) {
    view::AnchoredFunction function{.tf = view::default_transfer_function()};
    function.tf.opacity_pins = {view::Flat{height}};
    return function;
}

class PresetTest : public testing::Test {
  protected:
    support::TemporaryFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "config" / "presets";
    PresetFolder presets_{folder_};
};

TEST_F(PresetTest, AreWrittenListedReadRenamedAndRemoved) {
    EXPECT_THAT(presets_.names(), IsEmpty()) << "there is no folder yet";
    ASSERT_TRUE(presets_.write("b", function(0.2)));
    ASSERT_TRUE(presets_.write("a thin one (5.5%)", function(0.1)));
    EXPECT_THAT(presets_.names(), ElementsAre("a thin one (5.5%)", "b"));
    EXPECT_EQ(presets_.read("b").value().tf, function(0.2).tf);
    ASSERT_TRUE(presets_.write("b", function(0.3))) << "in its place";
    EXPECT_EQ(presets_.read("b").value().tf, function(0.3).tf);
    ASSERT_TRUE(presets_.rename("b", "c"));
    EXPECT_FALSE(presets_.rename("c", "a thin one (5.5%)")) << "nothing is lost by a name";
    EXPECT_THAT(presets_.names(), ElementsAre("a thin one (5.5%)", "c"));
    ASSERT_TRUE(presets_.remove("c"));
    EXPECT_EQ(presets_.remove("c").error().code, base::Code::not_found);
    EXPECT_FALSE(presets_.read("c"));
    EXPECT_FALSE(presets_.rename("c", "d"));
}

TEST_F(PresetTest, NamesLeadNowhereElse) {
    for (const std::string& name :
         {std::string(), std::string("../x"), std::string("a/b"), std::string(".hidden"), std::string("a\nb"),
          std::string("a\0b", 3), std::string(65, 'a'), std::string("\xff"), std::string(" a"),
          std::string("a ")}) {
        EXPECT_FALSE(PresetFolder::is_name(name)) << name;
        EXPECT_FALSE(presets_.write(name, function(0.1)));
        EXPECT_FALSE(presets_.read(name));
        EXPECT_FALSE(presets_.remove(name));
        EXPECT_FALSE(presets_.rename("a", name));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_));
    const PresetFolder homeless{std::filesystem::path()};
    EXPECT_THAT(homeless.write("a", function(0.1)).error().message(), HasSubstr("HOME"));
    EXPECT_THAT(homeless.names(), IsEmpty());
}

TEST_F(PresetTest, WhatIsNoPresetIsNotListedOrRefusedInOneLine) {
    ASSERT_TRUE(presets_.write("good", function(0.1)));
    std::filesystem::create_directory(folder_ / "folder.toml");
    std::ofstream(folder_ / "notes.txt") << "not a preset";
    std::ofstream(folder_ / "bad\nname.toml") << "";
    std::ofstream(folder_ / "wrong.toml") << "[[opacity]]\nkind = \"slope\"\n";
    std::ofstream(folder_ / "huge.toml") << std::string(3 << 20, 'x');
    EXPECT_THAT(presets_.names(), ElementsAre("good", "huge", "wrong"));
    for (const char* name : {"huge", "wrong"}) {
        const auto read = presets_.read(name);
        ASSERT_FALSE(read);
        EXPECT_EQ(read.error().message().find('\n'), std::string::npos);
        EXPECT_THAT(read.error().message(), HasSubstr(name));
    }
}

TEST_F(PresetTest, TheShelfDoesAllThatItIsAskedForInOrder) {
    std::counting_semaphore<64> woken(0);
    {
        PresetShelf shelf(presets_, [&] { woken.release(); });
        shelf.save("a", function(0.1));
        shelf.load("a");
        shelf.load("nothing");
        shelf.rename("a", "b");
        for (int i = 0; i < 4; ++i) {
            woken.acquire();
        }
        const auto saved = shelf.collect();
        ASSERT_TRUE(saved);
        EXPECT_THAT(saved->message, HasSubstr("saved"));
        EXPECT_THAT(saved->names, ElementsAre("a"));
        const auto loaded = shelf.collect();
        ASSERT_TRUE(loaded && loaded->loaded);
        EXPECT_EQ(loaded->loaded->tf, function(0.1).tf);
        const auto missing = shelf.collect();
        ASSERT_TRUE(missing);
        EXPECT_TRUE(missing->is_fault);
        EXPECT_FALSE(missing->loaded);
        const auto renamed = shelf.collect();
        ASSERT_TRUE(renamed);
        EXPECT_EQ(renamed->name, "b");
        EXPECT_THAT(renamed->names, ElementsAre("b"));
        EXPECT_FALSE(shelf.collect());
        shelf.save("last", function(0.2));
    }
    EXPECT_TRUE(presets_.read("last")) << "what was asked for before the end is done";
}

}  // namespace
}  // namespace shearwater::ui
