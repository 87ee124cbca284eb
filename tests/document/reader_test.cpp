// Values out of TOML documents, and what is said of those that are not there or are something else.

#include "common/document/reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/document/number_text.h"

namespace shearwater::document {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr std::size_t plenty = 1000;

toml::table table_of(std::string_view text) {
    auto table = parse(text, "read it", plenty);
    EXPECT_TRUE(table) << text;
    return table ? *std::move(table) : toml::table();
}

// What is found wrong with a document by one function.
template <class Take>
std::string fault_of(std::string_view text, const Take& take) {
    const toml::table table = table_of(text);
    Reader reader;
    take(reader, table);
    return reader.fault();
}

TEST(Document, IsParsedOrRefusedByName) {
    EXPECT_TRUE(parse("a = 1", "read it", 5));
    const auto too_long = parse("a = 11", "read it", 5);
    ASSERT_FALSE(too_long);
    EXPECT_EQ(too_long.error().code, base::Code::too_large);
    EXPECT_THAT(too_long.error().message(), HasSubstr("read it"));
    const auto broken = parse("a = 1\nb = [", "read it", plenty);
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, base::Code::corrupt);
    EXPECT_THAT(broken.error().detail, StartsWith("line 2: "));
}

TEST(Document, GivesItsValues) {
    const toml::table table = table_of(
        "n = 2\nx = -0.5\ntriple = [1, 2.5, 3]\nword = \"two\"\nempty = \"\"\n[[pin]]\nat = 4\n[[pin]]\nat = "
        "5\n[part]\n");
    Reader reader;
    EXPECT_EQ(reader.number(table, "n"), 2);
    EXPECT_EQ(reader.number(table, "x"), -0.5);
    EXPECT_EQ(reader.number_or(table, "y", 7), 7);
    EXPECT_EQ(reader.whole(table, "n"), 2);
    EXPECT_THAT(reader.numbers<3>(table, "triple"), ElementsAre(1, 2.5, 3));
    EXPECT_EQ(reader.text(table, "word"), "two");
    EXPECT_EQ(reader.text(table, "empty"), "");
    EXPECT_EQ(reader.one_of(table, "word", std::array<std::string_view, 2>{"one", "two"}), 1U);
    std::vector<double> at;
    reader.each_table(table, "pin", 2,
                      [&](const toml::table& pin) { at.push_back(reader.number(pin, "at")); });
    reader.each_table(table, "none", 2, [&](const toml::table&) { at.push_back(0); });
    EXPECT_THAT(at, ElementsAre(4, 5));
    EXPECT_THAT(reader.section(table, "part"), IsEmpty());
    reader.only_keys(table, "it", {"n", "x", "triple", "word", "empty", "pin", "part"});
    EXPECT_EQ(reader.fault(), "");
}

TEST(Document, SaysWhatIsWrongAndWhere) {
    const auto number = [](Reader& r, const toml::table& t) { r.number(t, "x"); };
    EXPECT_EQ(fault_of("\nx = \"much\"", number), "line 2: x should be a number");
    EXPECT_THAT(fault_of("x = inf", number), HasSubstr("x should be a number"));
    EXPECT_THAT(fault_of("y = 1", number), HasSubstr("x is missing; it should be a number"));
    EXPECT_THAT(fault_of("x = true", number), HasSubstr("x should be"));
    EXPECT_THAT(fault_of("x = []", [](Reader& r, const toml::table& t) { r.number_or(t, "x", 1); }),
                HasSubstr("x should be"));
    const auto pair = [](Reader& r, const toml::table& t) {
        EXPECT_THAT(r.numbers<2>(t, "x"), ElementsAre(0, 0));
    };
    for (const char* text :
         {"x = [1]", "x = [1, 2, 3]", "x = [1, \"2\"]", "x = [1, nan]", "x = 1", "y = [1, 2]"}) {
        EXPECT_THAT(fault_of(text, pair), HasSubstr("2 numbers")) << text;
    }
    const auto whole = [](Reader& r, const toml::table& t) { EXPECT_EQ(r.whole(t, "x"), 0); };
    for (const char* text : {"x = -1", "x = 2.0", "x = 1_000_000_001", "x = \"1\"", "y = 1"}) {
        EXPECT_THAT(fault_of(text, whole), HasSubstr("a whole number, not below 0")) << text;
    }
    EXPECT_THAT(fault_of("x = 1", [](Reader& r, const toml::table& t) { r.text(t, "x"); }),
                HasSubstr("x should be text"));
    const auto one_of = [](Reader& r, const toml::table& t) {
        r.one_of(t, "x", std::array<std::string_view, 2>{"near", "far"});
    };
    EXPECT_THAT(fault_of("x = \"ne\\u0007ar\"", one_of),
                testing::MatchesRegex(".*one of near, far, not \"ne[^\a]*ar\""));
    EXPECT_THAT(fault_of("x = 1", one_of), testing::EndsWith("one of near, far"));
    EXPECT_EQ(
        fault_of("x = 1\nz = 2", [](Reader& r, const toml::table& t) { r.only_keys(t, "a thing", {"x"}); }),
        "line 2: unknown key \"z\" in a thing");
    EXPECT_THAT(fault_of("part = 1", [](Reader& r, const toml::table& t) { r.section(t, "part"); }),
                HasSubstr("[part]"));
}

TEST(Document, TablesAreAsManyAsMayBeAndEndAtAFault) {
    int used = 0;
    const auto each = [&](Reader& r, const toml::table& t) {
        r.each_table(t, "pin", 2, [&](const toml::table& pin) {
            ++used;
            r.number(pin, "at");
        });
    };
    EXPECT_THAT(fault_of("pin = 3", each), HasSubstr("write each pin as [[pin]]"));
    EXPECT_THAT(fault_of("pin = [1, 2]", each), HasSubstr("[[pin]]"));
    EXPECT_THAT(fault_of("[[pin]]\n[[pin]]\n[[pin]]", each), HasSubstr("more than 2 of [[pin]]"));
    EXPECT_EQ(used, 0);
    EXPECT_EQ(fault_of("pin = []", each), "");
    EXPECT_THAT(fault_of("[[pin]]\n[[pin]]", each), StartsWith("line 1"));
    EXPECT_EQ(used, 1) << "the second is not looked at";
}

TEST(Document, TheFirstFaultStays) {
    Reader reader;
    reader.fail("one");
    reader.fail("two");
    EXPECT_EQ(reader.fault(), "one");
}

TEST(NumberText, ReadsBackAsTheSameFloat) {
    EXPECT_EQ(number_text(1), "1.0");
    EXPECT_EQ(number_text(-0.5), "-0.5");
    for (const double value :
         {0.1, 1.0 / 3, 1e300, 5e-324, -123456789.0, std::numeric_limits<double>::max()}) {
        const toml::table table = table_of("x = " + number_text(value));
        EXPECT_EQ(table["x"].value_exact<double>(), value);
    }
}

}  // namespace
}  // namespace shearwater::document
