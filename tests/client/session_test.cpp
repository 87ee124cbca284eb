#include "client/model/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "common/image/rle.h"
#include "protocol/wire/convert.h"

namespace shearwater::model {
namespace {

namespace pb = wire::pb;
using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A session with the other end in the test's hands and a clock that it sets.
class SessionTest : public testing::Test {
  protected:
    SessionTest() { wish_.size = {32, 16}; }

    void start() {
        session_.start(now_);
        take();
    }
    void connect() {
        start();
        up();
        receive(description());
        take();
    }
    void up() { event(wire::LinkUp{link(), pb::ROLE_CLIENT, "server", "127.0.0.1"}); }
    void down(pb::Reason reason, std::string text = "") {
        event(wire::LinkDown{link(), reason, std::move(text)});
    }
    void event(const wire::NetEvent& e) {
        session_.handle(e, now_);
        take();
    }
    template <class T>
    void receive(T body, std::vector<std::byte> payload = {}) {
        event(wire::Received{link(), wire::message(std::move(body), std::move(payload))});
    }
    void want(Change change = Change::single) {
        session_.want(wish_, change, now_);
        take();
    }
    void turn(Change change = Change::single) {
        wish_.viewpoint.orbit.azimuth += 1;
        want(change);
    }
    // Lets the time pass in the steps a hub ticks in.
    void pass(std::chrono::milliseconds time) {
        for (; time > 0ms; time -= 50ms) {
            now_ += std::min(time, 50ms);
            event(wire::Tick{});
        }
    }

    // Sorts what the session did.
    void take() {
        for (const wire::NetEffect& effect : session_.take_effects()) {
            if (const auto* dial = std::get_if<wire::Dial>(&effect)) {
                dials_.push_back(*dial);
            } else if (const auto* close = std::get_if<wire::CloseLink>(&effect)) {
                EXPECT_EQ(close->link, link());
                closes_.push_back(*close);
            } else {
                const auto& send = std::get<wire::Send>(effect);
                EXPECT_EQ(send.link, link());
                if (const auto* view = std::get_if<pb::SetView>(&send.message.body)) {
                    auto parsed = wire::view_from(*view);
                    ASSERT_TRUE(parsed) << parsed.error().text;
                    views_.push_back(std::move(*parsed));
                } else {
                    shown_.push_back(std::get<pb::FrameShown>(send.message.body).number());
                }
            }
        }
    }

    wire::LinkId link() const { return dials_.back().link; }
    Status status() const { return session_.status(now_); }

    static pb::CubeDescription description() {
        pb::CubeDescription d;
        d.set_name("cube.fits");
        *d.mutable_lattice() = wire::to_wire(view::Lattice{.n = {9, 8, 7}, .spacing = {1, 1, 1}});
        *d.mutable_mapping() = wire::to_wire(volume::Mapping{});
        return d;
    }
    static image::Image<image::Rgba8> picture(int width, int height) {
        image::Image<image::Rgba8> image(width, height);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            image.pixels()[i] = {static_cast<std::uint8_t>(i / 3), 7, 9, 255};
        }
        return image;
    }
    static std::vector<std::byte> code(const image::Image<image::Rgba8>& image) {
        std::vector<std::byte> bytes(image::rle_bound(image.pixels().size()));
        bytes.resize(image::encode_rle(image.pixels(), bytes));
        return bytes;
    }
    pb::Frame frame(std::uint64_t revision) {
        pb::Frame f;
        f.set_number(++last_number_);
        f.set_revision(revision);
        f.set_width(32);
        f.set_height(16);
        return f;
    }
    void answer(std::uint64_t revision) { receive(frame(revision), code(picture(32, 16))); }
    static pb::TreeState tree(std::initializer_list<pb::Phase> renderers) {
        pb::TreeState state;
        auto* head = state.add_nodes();
        head->set_parent(-1);
        head->set_phase(pb::PHASE_READY);
        *head->mutable_box() = wire::to_wire(volume::whole({9, 8, 7}));
        std::uint32_t place = 0;
        bool ready = true;
        for (const pb::Phase phase : renderers) {
            auto* node = state.add_nodes();
            node->set_place(++place);
            node->set_parent(0);
            node->set_role(pb::ROLE_RENDERER);
            node->set_phase(phase);
            *node->mutable_box() = wire::to_wire(volume::whole({9, 8, 7}));
            ready = ready && phase == pb::PHASE_READY;
        }
        state.set_ready(ready);
        return state;
    }
    void expect_closed(pb::Reason reason, const std::string& words) {
        ASSERT_THAT(closes_, SizeIs(1));
        EXPECT_EQ(closes_[0].reason, reason) << closes_[0].text;
        EXPECT_THAT(closes_[0].text, HasSubstr(words));
        EXPECT_EQ(status().connection, Connection::waiting);
        EXPECT_THAT(status().words, HasSubstr(words));
        EXPECT_FALSE(session_.take_picture());
    }

    wire::Time now_ = wire::Time{} + 1000s;
    Session session_{wire::Address{"host", 4000}};
    Wish wish_;
    std::uint64_t last_number_ = 0;
    std::vector<wire::Dial> dials_;
    std::vector<wire::CloseLink> closes_;
    std::vector<wire::View> views_;
    std::vector<std::uint64_t> shown_;
};

TEST_F(SessionTest, DialsAsAClientAndSendsTheViewOnceTheCubeIsKnown) {
    start();
    ASSERT_THAT(dials_, SizeIs(1));
    EXPECT_EQ(dials_[0].role, pb::ROLE_CLIENT);
    EXPECT_EQ(dials_[0].address, (wire::Address{"host", 4000}));
    EXPECT_EQ(status().connection, Connection::connecting);
    want();
    up();
    EXPECT_EQ(status().connection, Connection::connected);
    EXPECT_THAT(views_, IsEmpty());
    receive(description());
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].revision, 1u);
    EXPECT_EQ(views_[0].camera, camera(wish_.viewpoint, status().cube->lattice));
    EXPECT_EQ(views_[0].size, wish_.size);
    EXPECT_EQ(views_[0].tf, wish_.tf);
    EXPECT_EQ(status().cube->name, "cube.fits");
}

TEST_F(SessionTest, DecodesAcknowledgesAndMeasures) {
    connect();
    want();
    now_ += 40ms;
    auto f = frame(1);
    f.mutable_stats()->set_total_seconds(0.03);
    const auto bytes = code(picture(32, 16));
    receive(f, bytes);
    const auto decoded = session_.take_picture();
    ASSERT_TRUE(decoded);
    const auto expected = picture(32, 16);
    EXPECT_TRUE(std::ranges::equal(decoded->pixels.pixels(), expected.pixels()));
    EXPECT_TRUE(decoded->whole);
    EXPECT_EQ(decoded->quality, view::Quality::normal);
    EXPECT_THAT(shown_, testing::ElementsAre(1));
    EXPECT_NEAR(status().rates.latency_seconds, 0.04, 1e-9);
    EXPECT_NEAR(status().rates.bytes_per_frame, static_cast<double>(bytes.size()), 1e-9);
    EXPECT_NEAR(status().frame->server_seconds, 0.03, 1e-9);
    EXPECT_FALSE(session_.take_picture()) << "each picture is given once";
}

TEST_F(SessionTest, CountsFramesPerSecondAndGoesIdle) {
    connect();
    for (int i = 0; i < 20; ++i) {
        turn(Change::dragging);
        now_ += 50ms;
        answer(views_.back().revision);
    }
    EXPECT_NEAR(status().rates.frames_per_second, 20, 0.01);
    now_ += 3s;
    EXPECT_EQ(status().rates.frames_per_second, 0);
    EXPECT_NEAR(status().rates.latency_seconds, 0.05, 1e-9);
}

TEST_F(SessionTest, TheNewestWishWinsWhileTheServerIsBusy) {
    connect();
    for (int i = 0; i < 10; ++i) {
        turn(Change::dragging);
    }
    ASSERT_THAT(views_, SizeIs(2)) << "one under way, one waiting at the server";
    answer(1);
    ASSERT_THAT(views_, SizeIs(3));
    EXPECT_EQ(views_[2].revision, 3u);
    EXPECT_EQ(views_[2].camera, camera(wish_.viewpoint, status().cube->lattice));
    // A server that answers slowly hears of new wishes all the same, at a measured pace.
    for (int i = 0; i < 100; ++i) {
        now_ += 10ms;
        turn(Change::dragging);
    }
    EXPECT_GT(views_.size(), 3u + 20);
    EXPECT_LT(views_.size(), 3u + 27);
}

TEST_F(SessionTest, UnansweredViewsAreBounded) {
    connect();
    for (int i = 0; i < 2000; ++i) {
        now_ += 50ms;
        turn(Change::dragging);
    }
    EXPECT_THAT(views_, SizeIs(Session::most_unanswered));
    answer(views_.back().revision);
    EXPECT_THAT(views_, SizeIs(Session::most_unanswered + 1));
    EXPECT_EQ(views_.back().camera, camera(wish_.viewpoint, status().cube->lattice));
}

TEST_F(SessionTest, TheSameWishAgainSendsNothing) {
    connect();
    want();
    want();
    want(Change::dragging);
    EXPECT_THAT(views_, SizeIs(1));
}

TEST_F(SessionTest, DraftWhileDraggingThenNormalThenHighThenQuiet) {
    connect();
    turn(Change::dragging);
    answer(1);
    EXPECT_EQ(views_.back().quality, view::Quality::draft);
    pass(100ms);
    EXPECT_EQ(views_.back().quality, view::Quality::normal);
    answer(views_.back().revision);
    pass(200ms);
    EXPECT_EQ(views_.back().quality, view::Quality::high);
    EXPECT_THAT(views_, SizeIs(3));
    answer(views_.back().revision);
    EXPECT_EQ(session_.take_picture()->quality, view::Quality::high);
    pass(10s);
    EXPECT_THAT(views_, SizeIs(3));
    turn(Change::dragging);
    EXPECT_EQ(views_.back().quality, view::Quality::draft);
}

TEST_F(SessionTest, ASingleChangeIsNotMadeADraft) {
    connect();
    turn(Change::single);
    EXPECT_EQ(views_.back().quality, view::Quality::normal);
}

TEST_F(SessionTest, ReconnectsWithGrowingPausesAndKeepsTheWish) {
    connect();
    turn();
    answer(1);
    pass(500ms);  // high
    const std::uint64_t before = views_.back().revision;
    down(pb::REASON_LOST);
    EXPECT_EQ(status().connection, Connection::waiting);
    EXPECT_NEAR(status().retry_in, 0.25, 1e-9);
    EXPECT_TRUE(status().frame) << "what was seen stays";

    std::vector<double> pauses;
    for (int i = 0; i < 7; ++i) {
        const auto from = now_;
        const auto dials = dials_.size();
        while (dials_.size() == dials) {
            pass(50ms);
        }
        pauses.push_back(std::chrono::duration<double>(now_ - from).count());
        down(pb::REASON_UNREACHABLE);
        EXPECT_THAT(status().words, HasSubstr("No server answers at host:4000"));
    }
    EXPECT_THAT(pauses, testing::Pointwise(testing::DoubleNear(1e-9), {0.25, 0.5, 1.0, 2.0, 4.0, 5.0, 5.0}));

    pass(5s);
    EXPECT_NE(dials_.back().link, dials_.front().link);
    views_.clear();
    up();
    receive(description());
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].revision, before + 1) << "revisions go on";
    EXPECT_EQ(views_[0].camera, camera(wish_.viewpoint, status().cube->lattice));
    answer(views_[0].revision);
    EXPECT_TRUE(session_.take_picture());
    down(pb::REASON_LOST);
    EXPECT_NEAR(status().retry_in, 0.25, 1e-9) << "a picture shows that all is well again";
}

TEST_F(SessionTest, AWrongSecretIsSaidAndNotTriedAgain) {
    for (const pb::Reason reason : {pb::REASON_BAD_SECRET, pb::REASON_BAD_VERSION}) {
        session_ = Session(wire::Address{"host", 4000});
        dials_.clear();
        start();
        down(reason);
        EXPECT_EQ(status().connection, Connection::refused);
        pass(60s);
        EXPECT_THAT(dials_, SizeIs(1));
        session_.retry(now_);
        take();
        EXPECT_THAT(dials_, SizeIs(2));
    }
}

TEST_F(SessionTest, RetryDialsAtOnce) {
    connect();
    session_.retry(now_);
    take();
    EXPECT_THAT(dials_, SizeIs(1)) << "nothing to retry while connected";
    down(pb::REASON_SHUTDOWN);
    session_.retry(now_);
    take();
    EXPECT_THAT(dials_, SizeIs(2));
    pass(10s);
    EXPECT_THAT(dials_, SizeIs(2));
}

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
    receive(f, image::deflate(code(picture(32, 16))));
    const auto decoded = session_.take_picture();
    ASSERT_TRUE(decoded);
    EXPECT_TRUE(std::ranges::equal(decoded->pixels.pixels(), picture(32, 16).pixels()));
}

TEST_F(SessionTest, ASlowLinkIsToldToDeflate) {
    wish_.size = {512, 512};
    connect();
    image::Image<image::Rgba8> noise(512, 512);
    std::mt19937 random(1);
    for (auto& p : noise.pixels()) {
        p = {static_cast<std::uint8_t>(random()), 0, 0, 255};
    }
    for (const auto delay : {5ms, 500ms, 5ms}) {
        turn();
        now_ += delay;
        auto f = frame(views_.back().revision);
        f.set_width(512);
        f.set_height(512);
        receive(f, code(noise));
    }
    turn();
    ASSERT_THAT(views_, SizeIs(4));
    EXPECT_FALSE(views_[1].deflate);
    EXPECT_TRUE(views_[2].deflate);
    EXPECT_TRUE(views_[3].deflate);
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

TEST_F(SessionTest, TellsTheTreeInOrderWithItsProgress) {
    connect();
    auto state = tree({pb::PHASE_LOADING, pb::PHASE_READY});
    state.mutable_nodes(1)->set_fraction(0.5);
    state.mutable_nodes(1)->set_name("bad\x1b[31mname");
    state.mutable_nodes(2)->set_fraction(std::numeric_limits<double>::quiet_NaN());
    receive(state);
    const Tree told = status().tree;
    ASSERT_THAT(told.nodes, SizeIs(3));
    EXPECT_EQ(told.nodes[0].depth, 0);
    EXPECT_EQ(told.nodes[1].depth, 1);
    EXPECT_EQ(told.nodes[1].name, "bad?[31mname");
    EXPECT_EQ(told.nodes[2].fraction, 0);
    EXPECT_FALSE(told.ready);
    EXPECT_NEAR(told.loaded(), (0.75 + 1) / 2, 1e-12);
}

TEST_F(SessionTest, AnIncompletePictureIsAskedForAgainWhenMoreIsReady) {
    connect();
    receive(tree({pb::PHASE_READY, pb::PHASE_VACANT}));
    turn();
    pass(400ms);
    auto f = frame(views_.back().revision);
    auto* missing = f.add_missing();
    missing->set_place(2);
    *missing->mutable_box() = wire::to_wire(volume::Box{{0, 0, 0}, {8, 7, 3}});
    receive(f, code(picture(32, 16)));
    EXPECT_FALSE(session_.take_picture()->whole);
    ASSERT_THAT(status().frame->missing, SizeIs(1));
    EXPECT_EQ(status().frame->missing[0].box, (volume::Box{{0, 0, 0}, {8, 7, 3}}));
    views_.clear();
    receive(tree({pb::PHASE_READY, pb::PHASE_LOADING}));
    pass(5s);
    EXPECT_THAT(views_, IsEmpty());
    receive(tree({pb::PHASE_READY, pb::PHASE_READY}));
    ASSERT_THAT(views_, SizeIs(1));
    EXPECT_EQ(views_[0].quality, view::Quality::high);

    // Lost again while it was drawn, with the tree whole by now: asked for once more, after a while.
    f.set_number(++last_number_);
    f.set_revision(views_[0].revision);
    receive(f, code(picture(32, 16)));
    pass(900ms);
    EXPECT_THAT(views_, SizeIs(1));
    pass(200ms);
    ASSERT_THAT(views_, SizeIs(2));
    answer(views_[1].revision);
    pass(5s);
    EXPECT_THAT(views_, SizeIs(2)) << "whole at last";
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
