// What all renderers are asked together and what they reply, there and back, and what is refused.

#include "protocol/wire/convert_look.h"

#include <gtest/gtest.h>

#include "tests/wire/examples.h"

namespace shearwater::wire::test {
namespace {

LookRequest look_request() {
    return {.request = 8,
            .factorisation = factorisation(),
            .tf = transfer_function(),
            .settings = {culling::Kind::opof_linear, 0.9},
            .functions = {3, 9},
            .places = {2, 5, 6}};
}

TEST(Look, ComesBack) {
    const LookRequest back = look_from(to_wire(look_request())).value();
    EXPECT_EQ(back.request, 8U);
    EXPECT_EQ(back.factorisation, look_request().factorisation);
    EXPECT_EQ(back.tf, look_request().tf);
    EXPECT_EQ(back.settings, look_request().settings);
    EXPECT_EQ(back.functions, look_request().functions);
    EXPECT_EQ(back.places, look_request().places);
}

TEST(Look, OfNothingIsRefused) {
    const auto refused = [](const auto& change) {
        pb::Look bad = to_wire(look_request());
        change(bad);
        return look_from(bad).has_error();
    };
    EXPECT_TRUE(refused([](pb::Look& m) { m.clear_factorisation(); }));
    EXPECT_TRUE(refused([](pb::Look& m) { m.mutable_transfer_function()->clear_colour_pins(); }));
    EXPECT_TRUE(refused([](pb::Look& m) { m.clear_culling(); }));
    EXPECT_TRUE(refused([](pb::Look& m) { m.mutable_culling()->set_kind(pb::CULLING_OFF); }));
    EXPECT_TRUE(refused([](pb::Look& m) { m.mutable_culling()->set_threshold(1); }));
}

TEST(Reply, SeesWhatAnybodySees) {
    Reply all{8};
    all.add({8, false, {}});
    EXPECT_TRUE(all.visible.empty());
    all.add({8, false, "\x05\x10"});
    all.add({8, false, {}});
    all.add({8, false, "\x81\x10"});
    EXPECT_EQ(all.visible, "\x85\x10");
    EXPECT_FALSE(all.incomplete);
    const Reply back = reply_from(to_wire(all)).value();
    EXPECT_EQ(back.request, 8U);
    EXPECT_EQ(back.visible, all.visible);
    EXPECT_FALSE(back.incomplete);
}

TEST(Reply, LacksWhatAnybodyLacks) {
    Reply one{8, false, "\x05"};
    one.add({8, true, "\x02"});
    EXPECT_TRUE(one.incomplete);
    Reply other{8, false, "\x05"};
    other.add({8, false, "\x05\x05"});
    EXPECT_TRUE(other.incomplete) << "of another grid";
    EXPECT_EQ(other.visible, "\x05");
    EXPECT_TRUE(reply_from(to_wire(other)).value().incomplete);
}

TEST(Reply, OfMoreBlocksThanThereAreIsRefused) {
    pb::Replied replied;
    replied.mutable_visible()->assign(most_blocks / 8, '\xff');
    EXPECT_TRUE(reply_from(replied));
    EXPECT_LE(replied.ByteSizeLong(), limit_of(type_of(Body(replied)))->body);
    replied.mutable_visible()->push_back(1);
    EXPECT_EQ(reply_from(replied).error().reason, pb::REASON_INVALID);
}

}  // namespace
}  // namespace shearwater::wire::test
