// What a server must not do, and what the session makes of it.

#include <functional>
#include <random>

#include "tests/client/session_fixture.h"

namespace shearwater::model {
namespace {

TEST_F(SessionTest, EventsOfAnEarlierLinkAreIgnored) {
    connect();
    turn();
    const auto old = link();
    down(pb::REASON_LOST);
    pass(300ms);
    up();
    event(wire::Received{old, wire::message(frame(1), code(picture(32, 16)))});
    event(wire::LinkDown{old, pb::REASON_LOST, ""});
    EXPECT_EQ(status().connection, Connection::connected);
    EXPECT_THAT(shown_, IsEmpty());
}

TEST_F(SessionTest, AFrameOfAnEarlierLinksViewIsRefused) {
    connect();
    turn();
    down(pb::REASON_LOST);
    pass(300ms);
    up();
    receive(description());
    answer(1);
    expect_closed(pb::REASON_INVALID, "not asked for");
}

TEST_F(SessionTest, AnOvertakenFrameIsAcknowledgedAndDropped) {
    connect();
    turn(Change::dragging);
    turn(Change::dragging);
    answer(2);
    ASSERT_TRUE(session_.take_picture());
    answer(1);
    EXPECT_FALSE(session_.take_picture());
    EXPECT_THAT(shown_, testing::ElementsAre(1, 2));
    EXPECT_THAT(closes_, IsEmpty());
    answer(2);
    EXPECT_TRUE(session_.take_picture()) << "the newest may be drawn again";
}

TEST_F(SessionTest, HostileFramesEndTheLinkByName) {
    struct Case {
        const char* words;
        pb::Reason reason;
        std::function<void(pb::Frame&, std::vector<std::byte>&)> spoil;
    };
    const std::vector<Case> cases = {
        {"not of the size", pb::REASON_INVALID, [](auto& f, auto&) { f.set_width(33); }},
        {"not of the size", pb::REASON_INVALID, [](auto& f, auto&) { f.set_height(0xffffffff); }},
        {"not of the size", pb::REASON_INVALID, [](auto& f, auto&) { f.set_width(0), f.set_height(0); }},
        {"not asked for", pb::REASON_INVALID, [](auto& f, auto&) { f.set_revision(7); }},
        {"not asked for", pb::REASON_INVALID, [](auto& f, auto&) { f.set_revision(0); }},
        {"encoding", pb::REASON_INVALID,
         [](auto& f, auto&) { f.set_encoding(static_cast<pb::Encoding>(9)); }},
        {"fewer pixels", pb::REASON_MALFORMED, [](auto&, auto& b) { b.clear(); }},
        {"within a part", pb::REASON_MALFORMED, [](auto&, auto& b) { b.pop_back(); }},
        {"more pixels", pb::REASON_MALFORMED, [](auto&, auto& b) { b.insert(b.end(), b.begin(), b.end()); }},
        {"inflate", pb::REASON_MALFORMED, [](auto& f, auto&) { f.set_encoding(pb::ENCODING_RLE_DEFLATE); }},
        {"more bytes", pb::REASON_TOO_LARGE,
         [](auto& f, auto& b) {
             f.set_encoding(pb::ENCODING_RLE_DEFLATE);
             b = image::deflate(std::vector<std::byte>(std::size_t{1} << 24), 9);
         }},
        {"box", pb::REASON_INVALID,
         [](auto& f, auto&) {
             *f.add_missing()->mutable_box() = wire::to_wire(volume::Box{{5, 0, 0}, {1, 1, 1}});
         }},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.words);
        session_ = Session(wire::Address{"host", 4000});
        wish_.viewpoint = {};
        closes_.clear();
        connect();
        want();
        auto f = frame(1);
        auto bytes = code(picture(32, 16));
        c.spoil(f, bytes);
        receive(f, bytes);
        expect_closed(c.reason, c.words);
    }
}

TEST_F(SessionTest, DeflatedFramesAreRead) {
    connect();
    want();
    auto f = frame(1);
    f.set_encoding(pb::ENCODING_RLE_DEFLATE);
    const auto wanted = picture(32, 16);
    receive(f, image::deflate(code(wanted)));
    const auto decoded = session_.take_picture();
    ASSERT_TRUE(decoded);
    EXPECT_TRUE(std::ranges::equal(decoded->pixels.pixels(), wanted.pixels()));
}

TEST_F(SessionTest, HostileDescriptionsTreesAndTypesEndTheLink) {
    const auto fresh = [&] {
        session_ = Session(wire::Address{"host", 4000});
        closes_.clear();
        connect();
    };
    fresh();
    auto d = description();
    d.mutable_lattice()->mutable_n()->set_x(-4);
    receive(d);
    EXPECT_THAT(closes_, SizeIs(1));

    fresh();
    receive(pb::CubeDescription{});
    EXPECT_THAT(closes_, SizeIs(1));

    fresh();
    d = description();
    d.mutable_values()->add_quantiles(1);
    receive(d);
    expect_closed(pb::REASON_INVALID, "values");

    fresh();
    auto orphan = tree({pb::PHASE_READY});
    orphan.mutable_nodes(1)->set_parent(9);
    receive(orphan);
    expect_closed(pb::REASON_INVALID, "parent");

    fresh();
    auto circle = tree({pb::PHASE_READY, pb::PHASE_READY});
    circle.mutable_nodes(1)->set_parent(2);
    circle.mutable_nodes(2)->set_parent(1);
    receive(circle);
    expect_closed(pb::REASON_INVALID, "parent");

    fresh();
    auto phase = tree({static_cast<pb::Phase>(77)});
    receive(phase);
    expect_closed(pb::REASON_INVALID, "phase");

    fresh();
    receive(pb::Assign{});
    expect_closed(pb::REASON_BAD_TYPE, "Assign");
}

// Any bytes a server may send in place of a frame leave the session alive.
TEST_F(SessionTest, FuzzedFramesNeverCrash) {
    std::mt19937 random(3);
    const auto good = code(picture(32, 16));
    for (int round = 0; round < 500; ++round) {
        session_ = Session(wire::Address{"host", 4000});
        closes_.clear();
        connect();
        turn();
        auto bytes = good;
        for (int edit = 0; edit < 3; ++edit) {
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        }
        auto f = frame(1);
        f.set_encoding(random() % 2 == 0 ? pb::ENCODING_RLE : pb::ENCODING_RLE_DEFLATE);
        receive(f, bytes);
        EXPECT_EQ(closes_.empty(), session_.take_picture().has_value());
    }
}

}  // namespace
}  // namespace shearwater::model
