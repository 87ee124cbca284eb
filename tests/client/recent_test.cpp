// The list of recent connections, and the file of it.

#include "client/model/recent.h"

#include <gtest/gtest.h>

#include <random>

namespace shearwater::model {
namespace {

std::vector<std::string> names(const RecentList& list) {
    std::vector<std::string> all;
    for (const Recent& each : list.all()) {
        all.push_back(each.name);
    }
    return all;
}

TEST(Recent, TheLastComesFirstAndOnce) {
    RecentList list;
    list.add({"a", ""});
    list.add({"b", "/secret"});
    list.add({"a", "/another"});
    ASSERT_EQ(names(list), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(list.all()[0].secret_file, "/another");
    list.remove("b");
    list.remove("nobody");
    EXPECT_EQ(names(list), std::vector<std::string>{"a"});
}

TEST(Recent, AreBounded) {
    RecentList list;
    for (int i = 0; i < 100; ++i) {
        list.add({std::to_string(i), ""});
    }
    EXPECT_EQ(list.all().size(), RecentList::most);
    EXPECT_EQ(list.all().front().name, "99");
    list.add({"", ""});
    list.add({std::string(RecentList::longest + 1, 'x'), ""});
    EXPECT_EQ(list.all().front().name, "99");
}

TEST(Recent, AnyBytesComeBack) {
    std::string all;
    for (int c = 1; c < 256; ++c) {
        all += static_cast<char>(c);
    }
    RecentList list;
    list.add({all, "/secrets/" + all});
    list.add({std::string(RecentList::longest, '\xff'), ""});
    list.add({"\"]\n[[recent]]\nname = \"injected", ""});
    const std::string text = to_toml(list);
    const auto back = recent_from_toml(text, "test");
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_TRUE(std::ranges::equal(back->all(), list.all()));
    for (const char c : text) {
        EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~'));
    }
}

TEST(Recent, NothingCutShortIsTaken) {
    RecentList list;
    list.add({"/data/a.fits", ""});
    list.add({"host:7500", "/run/secret"});
    const std::string text = to_toml(list);
    for (std::size_t size = 0; size + 1 < text.size(); ++size) {
        EXPECT_FALSE(recent_from_toml(text.substr(0, size), "test")) << text.substr(0, size);
    }
    EXPECT_TRUE(recent_from_toml(text, "test"));
}

TEST(Recent, HostileFilesAreRefused) {
    const std::string version = "version = 1\n", end = "[end]\ncount = \"1\"\n";
    const std::string deep(100000, '[');
    for (const std::string& text :
         {std::string(), std::string("\xff\xfe"), std::string("version = 2\n"), std::string("x = ["), deep,
          version + "recent = 3\n", version + "recent = [3]\n" + end, version + "[[recent]]\n" + end,
          version + "[[recent]]\nname = 7\n" + end, version + "[[recent]]\nname = \"\"\n" + end,
          version + "[[recent]]\nname = \"a%\"\n" + end, version + "[[recent]]\nname = \"a%0\"\n" + end,
          version + "[[recent]]\nname = \"a%00\"\n" + end, version + "[[recent]]\nname = \"a%-1\"\n" + end,
          version + "[[recent]]\nname = \"a\"\nsecret = \"x\"\n" + end,
          version + "[[recent]]\nname = \"" + std::string(5000, 'x') + "\"\n" + end}) {
        const auto read = recent_from_toml(text, "/state/\nrecent.toml");
        ASSERT_FALSE(read) << text.substr(0, 100);
        EXPECT_EQ(read.error().message().find('\n'), std::string::npos);
    }
    std::string many = version;
    for (int i = 0; i < 1000; ++i) {
        many += "[[recent]]\nname = \"" + std::to_string(i) + "\"\n";
    }
    const auto read = recent_from_toml(many + "[end]\ncount = \"1000\"\n", "test");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->all().size(), RecentList::most);
    EXPECT_EQ(read->all().front().name, "0");
}

// Whatever the bytes: no crash, and what is taken can be written and read again.
TEST(Recent, ChangedFilesDoNoHarm) {
    RecentList list;
    list.add({"/data/a.fits", "/x"});
    list.add({"b:1", ""});
    const std::string text = to_toml(list);
    std::mt19937 random(7);
    for (int i = 0; i < 2000; ++i) {
        std::string changed = text;
        for (int n = 0; n < 3; ++n) {
            changed[random() % changed.size()] = static_cast<char>(random());
        }
        if (const auto read = recent_from_toml(changed, "test")) {
            const auto again = recent_from_toml(to_toml(*read), "test");
            ASSERT_TRUE(again);
            EXPECT_TRUE(std::ranges::equal(again->all(), read->all()));
        }
    }
}

}  // namespace
}  // namespace shearwater::model
