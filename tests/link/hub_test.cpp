// Two hubs that mean well.

#include <atomic>

#include "tests/link/support.h"

namespace shearwater::link::test {
namespace {

struct Pair : testing::Test {
    void connect() {
        b.dial(1, a.listen(), wire::pb::ROLE_RENDERER);
        ASSERT_TRUE(run_until(io, [&] { return !a.ups.empty() && !b.ups.empty(); }));
        a_link = a.ups[0].link;
    }

    asio::io_context io;
    Station a{io};
    Station b{io};
    LinkId a_link{};
    static constexpr LinkId b_link{1};
};

TEST_F(Pair, ShakeHandsAndSayWhoTheyAre) {
    connect();
    EXPECT_EQ(static_cast<std::uint64_t>(a_link), wire::first_accepted);
    EXPECT_EQ(a.ups[0].role, wire::pb::ROLE_RENDERER);
    EXPECT_EQ(a.ups[0].peer_name, "test station");
    EXPECT_EQ(a.ups[0].peer_host, "127.0.0.1");
    EXPECT_EQ(b.ups[0].link, b_link);
    EXPECT_EQ(b.ups[0].role, wire::pb::ROLE_RENDERER);
    EXPECT_EQ(b.ups[0].peer_host, "127.0.0.1");
}

TEST_F(Pair, MessagesKeepTheirOrderBothWays) {
    connect();
    constexpr std::uint64_t count = 1000;
    for (std::uint64_t i = 0; i < count; ++i) {
        a.send(a_link, cancel(i));
        b.send(b_link, i % 10 == 0 ? windows(i, 5000) : cancel(i));
    }
    ASSERT_TRUE(run_until(io, [&] { return a.received.size() == count && b.received.size() == count; }));
    for (std::uint64_t i = 0; i < count; ++i) {
        EXPECT_EQ(std::get<wire::pb::Cancel>(b.received[i].message.body).frame(), i);
        const wire::Body& body = a.received[i].message.body;
        EXPECT_EQ(i % 10 == 0 ? std::get<wire::pb::Windows>(body).frame()
                              : std::get<wire::pb::Cancel>(body).frame(),
                  i);
    }
}

TEST_F(Pair, LargePayloadsArriveWhole) {
    connect();
    for (const std::size_t size : {std::size_t{1}, (std::size_t{1} << 20) - 1, (std::size_t{1} << 20) + 1,
                                   std::size_t{3} << 20, std::size_t{64} << 20}) {
        const wire::Message sent = windows(size, size, 7);
        a.received.clear();
        b.send(b_link, sent);
        ASSERT_TRUE(run_until(io, [&] { return !a.received.empty(); }));
        EXPECT_TRUE(*a.received[0].message.payload == *sent.payload);
    }
    EXPECT_GT(b.hub.bytes_sent(), std::uint64_t{64} << 20);
    EXPECT_GT(a.hub.bytes_received(), std::uint64_t{64} << 20);
}

// Small ones are read several at a time, and what follows a payload with its end.
TEST_F(Pair, MessagesOfAllSizesArriveAsTheyWereSent) {
    connect();
    std::vector<wire::Message> sent;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const std::size_t size = i % 7 == 0 ? 70000 + i : i % 3 == 0 ? 0 : 16384 - 150 + i;
        sent.push_back(size == 0 ? cancel(i) : windows(i, size, static_cast<std::uint8_t>(i)));
        b.send(b_link, sent.back());
    }
    ASSERT_TRUE(run_until(io, [&] { return a.received.size() == sent.size(); }));
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const wire::Message& got = a.received[i].message;
        EXPECT_EQ(bytes_of(got), bytes_of(sent[i])) << i;
    }
    EXPECT_EQ(a.hub.bytes_received(), b.hub.bytes_sent());
}

TEST_F(Pair, OnlyTheNewestViewWaits) {
    connect();
    b.send(b_link, windows(0, 32 << 20));  // keeps the writer busy
    run_for(io, 1ms);
    for (std::uint64_t i = 1; i <= 100; ++i) {
        b.send(b_link, set_view(i));
    }
    b.send(b_link, cancel(5));
    ASSERT_TRUE(run_until(io, [&] { return a.received.size() >= 3; }));
    EXPECT_EQ(a.received.size(), 3U);
    EXPECT_EQ(std::get<wire::pb::SetView>(a.received[1].message.body).revision(), 100U);
    EXPECT_EQ(std::get<wire::pb::Cancel>(a.received[2].message.body).frame(), 5U);
}

TEST_F(Pair, AClosedLinkSendsWhatWasQueuedAndThenItsReason) {
    connect();
    b.send(b_link, windows(1, 8 << 20));
    b.perform(wire::CloseLink{b_link, wire::pb::REASON_REPLACED, "another came"});
    b.send(b_link, cancel(9));  // too late
    ASSERT_TRUE(run_until(io, [&] { return !a.downs.empty(); }));
    EXPECT_EQ(a.received.size(), 1U);
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_REPLACED);
    EXPECT_EQ(a.downs[0].text, "another came");
    run_for(io, 200ms);
    EXPECT_TRUE(b.downs.empty());
}

TEST_F(Pair, BothMayCloseAtOnce) {
    connect();
    a.perform(wire::CloseLink{a_link, wire::pb::REASON_SHUTDOWN, ""});
    b.perform(wire::CloseLink{b_link, wire::pb::REASON_SHUTDOWN, ""});
    run_for(io, 300ms);
    EXPECT_TRUE(a.downs.empty());
    EXPECT_TRUE(b.downs.empty());
}

TEST_F(Pair, ShuttingDownDrainsEveryLink) {
    connect();
    b.dial(2, a.listen());
    ASSERT_TRUE(run_until(io, [&] { return a.ups.size() == 2 && b.ups.size() == 2; }));
    bool done = false;
    b.send(LinkId{1}, windows(1, 16 << 20));
    b.send(LinkId{2}, windows(2, 16 << 20));
    b.hub.shut_down(60s, [&] { done = true; });
    ASSERT_TRUE(run_until(io, [&] { return done && a.downs.size() == 2; }));
    EXPECT_EQ(a.received.size(), 2U);
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_SHUTDOWN);
    EXPECT_EQ(a.downs[1].reason, wire::pb::REASON_SHUTDOWN);
    EXPECT_TRUE(b.downs.empty());
}

TEST_F(Pair, ADestroyedHubIsSilentAndItsPeerHearsOfIt) {
    std::optional<Station> c(std::in_place, io);
    const wire::Address address = a.listen();
    c->dial(1, address);
    ASSERT_TRUE(run_until(io, [&] { return a.ups.size() == 1; }));
    c.reset();
    ASSERT_TRUE(run_until(io, [&] { return a.downs.size() == 1; }));
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_LOST);
}

TEST_F(Pair, AHubMayBeDestroyedByItsOwnEvent) {
    for (int kind = 0; kind < 3; ++kind) {
        std::unique_ptr<Hub> c;
        bool gone = false;
        c = std::make_unique<Hub>(io, secret_of(), "short-lived", [&](const wire::NetEvent& event) {
            EXPECT_FALSE(gone);
            if (std::holds_alternative<wire::LinkUp>(event) && kind == 1) {
                a.send(a.ups.back().link, cancel(1));
            } else if (event.index() == static_cast<std::size_t>(kind == 2 ? 3 : kind)) {
                gone = true;
                c.reset();
            }
        });
        const std::size_t before = a.ups.size();
        c->perform(wire::Dial{LinkId{1}, a.listen(), wire::pb::ROLE_CHILD});
        ASSERT_TRUE(run_until(io, [&] { return gone; })) << "event " << kind;
        ASSERT_TRUE(run_until(io, [&] { return a.downs.size() == a.ups.size(); }));
        EXPECT_LE(a.ups.size(), before + 1);
    }
}

TEST(Hub, ADestroyedHubLetsItsLoopRunOut) {
    asio::io_context io;
    {
        Station a(io);
        Station b(io);
        b.dial(1, a.listen());
        ASSERT_TRUE(run_until(io, [&] { return !a.ups.empty() && !b.ups.empty(); }));
    }
    io.restart();
    io.run_for(30s);
    EXPECT_TRUE(io.stopped());
}

TEST(Hub, MayOutliveItsLoopsLastRun) {
    asio::io_context io;
    Station a(io);
    Station b(io);
    b.dial(1, a.listen());
    ASSERT_TRUE(run_until(io, [&] { return !a.ups.empty() && !b.ups.empty(); }));
    b.send(LinkId{1}, windows(1, 8 << 20));
    run_for(io, 1ms);
    SUCCEED();  // what is under way is given back with the loop; the sanitizers watch
}

TEST(Hub, TicksSomeTenTimesASecond) {
    asio::io_context io;
    Station a(io);
    EXPECT_TRUE(run_until(io, [&] { return a.ticks >= 5; }));
}

// As programs have them: the loop on a thread of its own, effects posted to it.
TEST(Hub, RunsOnAThreadOfItsOwn) {
    asio::io_context io;
    Station a(io);
    const wire::Address address = a.listen();
    std::atomic<std::size_t> received = 0;
    a.then = [&] { received = a.received.size(); };

    asio::io_context other;
    std::optional<Station> b(std::in_place, other);
    std::jthread thread([&] { other.run(); });
    asio::post(other, [&] { b->dial(1, address); });
    std::atomic<bool> up = false;
    asio::post(other, [&] { b->then = [&] { up = !b->ups.empty(); }; });
    ASSERT_TRUE(run_until(io, [&] { return up.load(); }));
    for (std::uint64_t i = 0; i < 100; ++i) {
        asio::post(other, [&, i] { b->send(LinkId{1}, windows(i, 10000)); });
    }
    EXPECT_TRUE(run_until(io, [&] { return received == 100; }));
    asio::post(other, [&] { b.reset(); });
}

TEST(Hub, SpeaksIpVersion6AndNames) {
    asio::io_context io;
    Station a(io);
    Station b(io);
    const auto six = a.hub.listen({"::1", 0});
    if (!six) {
        GTEST_SKIP() << "no IPv6 loopback here: " << six.error().message();
    }
    boost::system::error_code unnamed;
    tcp::resolver names(io);
    names.resolve("localhost", "", unnamed);
    if (unnamed) {
        GTEST_SKIP() << "nothing here is named localhost: " << unnamed.message();
    }
    b.dial(1, *six);
    b.dial(2, {"localhost", a.hub.listen({"localhost", 0}).value().port});
    ASSERT_TRUE(run_until(io, [&] { return b.ups.size() == 2; }));
    EXPECT_EQ(wire::to_string(*six), "[::1]:" + std::to_string(six->port));
}

TEST(Hub, RefusesToListenWhereItCannot) {
    asio::io_context io;
    Station a(io);
    const wire::Address taken = a.listen();
    EXPECT_EQ(a.hub.listen(taken).error().code, base::Code::io);
    EXPECT_FALSE(a.hub.listen({"203.0.113.1", 0}).has_value());
}

TEST(Hub, ADialThatFindsNobodyIsUnreachable) {
    asio::io_context io;
    Station a(io);
    tcp::acceptor closed(io, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
    const std::uint16_t port = closed.local_endpoint().port();
    closed.close();
    a.dial(1, {"127.0.0.1", port});
    a.dial(2, {"no-such-host.invalid", 1});
    ASSERT_TRUE(run_until(io, [&] { return a.downs.size() == 2; }));
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_UNREACHABLE);
    EXPECT_EQ(a.downs[1].reason, wire::pb::REASON_UNREACHABLE);
}

TEST(Hub, ADialCanBeTakenBack) {
    asio::io_context io;
    Station a(io);
    Station b(io);
    b.dial(1, a.listen());
    b.perform(wire::CloseLink{LinkId{1}, wire::pb::REASON_SHUTDOWN, ""});
    run_for(io, 300ms);
    EXPECT_TRUE(b.ups.empty());
    EXPECT_TRUE(b.downs.empty());
    EXPECT_TRUE(a.ups.empty());
}

TEST(Hub, CarriesTwoHundredLinks) {
    constexpr std::size_t count = 200;
    asio::io_context io;
    Station a(io);
    Station b(io);
    const wire::Address address = a.listen();
    for (std::uint64_t i = 1; i <= count; ++i) {
        b.dial(i, address);
    }
    ASSERT_TRUE(run_until(io, [&] { return a.ups.size() == count && b.ups.size() == count; }));
    for (std::uint64_t i = 1; i <= count; ++i) {
        b.send(LinkId{i}, cancel(i));
    }
    for (const wire::LinkUp& up : a.ups) {
        a.send(up.link, cancel(1));
    }
    ASSERT_TRUE(run_until(io, [&] { return a.received.size() == count && b.received.size() == count; }));
    std::uint64_t sum = 0;
    for (const wire::Received& r : a.received) {
        sum += std::get<wire::pb::Cancel>(r.message.body).frame();
    }
    EXPECT_EQ(sum, count * (count + 1) / 2);
    EXPECT_TRUE(a.downs.empty());
    EXPECT_TRUE(b.downs.empty());
}

}  // namespace
}  // namespace shearwater::link::test
