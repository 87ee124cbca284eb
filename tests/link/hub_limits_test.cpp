// Deadlines and bounds, made short. Times are those a hub must not fall short of, never upper bounds.

#include <filesystem>

#include "tests/link/support.h"

namespace shearwater::link::test {
namespace {

std::size_t open_descriptors() {
    using Entries = std::filesystem::directory_iterator;
    return static_cast<std::size_t>(std::distance(Entries("/proc/self/fd"), Entries()));
}

struct Bounded : testing::Test {
    // A hub under the limits, and a raw peer that has shaken hands with it.
    Raw& connect(const Limits& limits) {
        a.emplace(io, secret_of(), limits);
        address = a->listen();
        Raw& raw = peers.emplace_back(io, address);
        EXPECT_TRUE(raw.shake_hands());
        EXPECT_TRUE(run_until(io, [&] { return !a->ups.empty(); }));
        link = a->ups[0].link;
        return raw;
    }
    void expect_down(wire::pb::Reason reason) {
        ASSERT_TRUE(run_until(io, [&] { return !a->downs.empty(); }));
        EXPECT_EQ(a->downs[0].reason, reason) << a->downs[0].text;
        EXPECT_EQ(a->downs[0].link, link);
        run_for(io, 200ms);
        EXPECT_EQ(a->downs.size(), 1U);
    }
    // Fills the connection up, so that what follows has to wait.
    void block() {
        a->send(link, windows(0, 32 << 20));
        run_for(io, 100ms);
    }

    asio::io_context io;
    std::optional<Station> a;
    wire::Address address;
    std::list<Raw> peers;
    LinkId link{};
};

TEST_F(Bounded, SilentScannersAreToldTheTimeAndDropped) {
    a.emplace(io, secret_of(), Limits{.handshake = 300ms});
    address = a->listen();
    Raw silent(io, address);
    Raw half(io, address);
    const std::vector<std::byte> message = bytes_of(cancel(1));
    ASSERT_TRUE(half.write(std::span(message).first(7)));
    for (Raw* raw : {&silent, &half}) {
        EXPECT_EQ(raw->next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_TIMED_OUT);
        EXPECT_FALSE(raw->read_message());
    }
    EXPECT_EQ(a->refused.size(), 2U);
    EXPECT_TRUE(a->downs.empty());
}

TEST_F(Bounded, ScannersDoNotKeepOthersOut) {
    a.emplace(io, secret_of(), Limits{.handshake = 4s, .handshakes = 4});
    address = a->listen();
    for (int i = 0; i < 12; ++i) {
        peers.emplace_back(io, address);
    }
    Station good(io, secret_of(), Limits{.handshake = 50s});
    good.dial(1, address);
    ASSERT_TRUE(run_until(io, [&] { return !good.ups.empty(); }));
    EXPECT_EQ(a->refused.at(0).reason, wire::pb::REASON_TOO_MANY_LINKS);
}

TEST_F(Bounded, NoMoreLinksThanAllowed) {
    connect(Limits{.links = 2});
    Station b(io);
    b.dial(1, address);
    ASSERT_TRUE(run_until(io, [&] { return b.ups.size() == 1; }));
    b.dial(2, address);
    ASSERT_TRUE(run_until(io, [&] { return b.downs.size() == 1; }));
    EXPECT_EQ(b.downs[0].link, LinkId{2});
    EXPECT_EQ(b.downs[0].reason, wire::pb::REASON_TOO_MANY_LINKS);
    b.perform(wire::CloseLink{LinkId{1}, wire::pb::REASON_SHUTDOWN, ""});
    ASSERT_TRUE(run_until(io, [&] { return !a->downs.empty(); }));
    run_for(io, 200ms);
    b.dial(3, address);  // one has become free
    EXPECT_TRUE(run_until(io, [&] { return b.ups.size() == 2; }));
}

TEST_F(Bounded, TooManyMessagesInTheQueueEndTheLink) {
    connect(Limits{.queued_messages = 10});
    block();
    for (std::uint64_t i = 0; i < 10; ++i) {
        a->send(link, cancel(i));
    }
    for (std::uint64_t i = 0; i < 50; ++i) {
        a->send(link, set_view(i));  // the first of them is one too many
    }
    EXPECT_TRUE(a->downs.empty()) << "not from inside perform()";
    expect_down(wire::pb::REASON_QUEUE_FULL);
}

TEST_F(Bounded, TooManyBytesInTheQueueEndTheLink) {
    connect(Limits{.queued_bytes = 4 << 20});
    block();
    for (int i = 0; i < 3; ++i) {
        a->send(link, windows(1, 1 << 20));
    }
    run_for(io, 100ms);
    EXPECT_TRUE(a->downs.empty());
    a->send(link, windows(1, 1 << 20));
    expect_down(wire::pb::REASON_QUEUE_FULL);
}

TEST_F(Bounded, AMachineThatClosesAnOverflowedLinkHearsNoMoreOfIt) {
    connect(Limits{.queued_messages = 1});
    block();
    a->send(link, cancel(1));
    a->send(link, cancel(2));
    a->perform(wire::CloseLink{link, wire::pb::REASON_SHUTDOWN, ""});
    run_for(io, 300ms);
    EXPECT_TRUE(a->downs.empty());
}

TEST_F(Bounded, APeerThatDoesNotReadStalls) {
    connect(Limits{.stall = 500ms});
    a->send(link, windows(0, 64 << 20));
    expect_down(wire::pb::REASON_STALLED);
}

TEST_F(Bounded, APeerThatReadsSlowlyDoesNot) {
    Raw& raw = connect(Limits{.stall = 1000ms});
    a->send(link, windows(0, 64 << 20));
    const auto end = std::chrono::steady_clock::now() + 3s;
    std::vector<std::byte> some(4 << 20);
    while (std::chrono::steady_clock::now() < end) {
        boost::system::error_code ignored;
        raw.socket().non_blocking(true);
        raw.socket().read_some(asio::buffer(some.data(), 512 << 10), ignored);
        run_for(io, 50ms);
    }
    EXPECT_TRUE(a->downs.empty());
}

TEST_F(Bounded, HeartbeatsKeepAnIdleLinkAlive) {
    const Limits limits{.heartbeat = 200ms, .silence = 1000ms};
    Station b(io, secret_of(), limits);
    a.emplace(io, secret_of(), limits);
    b.dial(1, a->listen());
    ASSERT_TRUE(run_until(io, [&] { return !a->ups.empty() && !b.ups.empty(); }));
    const std::uint64_t before = b.hub.bytes_received();
    run_for(io, 3s);
    EXPECT_TRUE(a->downs.empty());
    EXPECT_TRUE(b.downs.empty());
    EXPECT_TRUE(a->received.empty());
    EXPECT_GT(b.hub.bytes_received(), before);
}

TEST_F(Bounded, ASilentPeerIsPingedAndThenGivenUp) {
    Raw& raw = connect(Limits{.heartbeat = 100ms, .silence = 600ms});
    EXPECT_TRUE(raw.next<wire::pb::Ping>());
    expect_down(wire::pb::REASON_TIMED_OUT);
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_TIMED_OUT);
}

TEST_F(Bounded, PingsAreAnswered) {
    Raw& raw = connect({});
    wire::pb::Ping ping;
    for (std::uint64_t token = 1; token <= 3; ++token) {
        ping.set_token(token);
        ASSERT_TRUE(raw.write(wire::message(ping)));
        EXPECT_EQ(raw.next<wire::pb::Pong>().value().token(), token);
    }
}

TEST_F(Bounded, AFloodOfPingsFillsNoQueue) {
    Raw& raw = connect(Limits{.queued_messages = 4});
    wire::pb::Ping ping;
    std::vector<std::byte> flood;
    for (std::uint64_t token = 1; token <= 20000; ++token) {
        ping.set_token(token);
        const auto bytes = bytes_of(wire::message(ping));
        flood.insert(flood.end(), bytes.begin(), bytes.end());
    }
    ASSERT_TRUE(raw.write(flood));
    std::uint64_t last = 0;
    while (last < 20000) {
        const auto pong = raw.next<wire::pb::Pong>();
        ASSERT_TRUE(pong);
        EXPECT_GT(pong->token(), last);
        last = pong->token();
    }
    EXPECT_TRUE(a->downs.empty());
}

TEST_F(Bounded, AMessageOnItsWayIsLife) {
    Raw& raw = connect(Limits{.silence = 700ms});
    const std::vector<std::byte> message = bytes_of(windows(1, 2000));
    for (std::size_t i = 0; i < message.size(); i += 100) {
        ASSERT_TRUE(raw.write(std::span(message).subspan(i, std::min<std::size_t>(100, message.size() - i))));
        run_for(io, 100ms);
    }
    ASSERT_TRUE(run_until(io, [&] { return !a->received.empty(); }));
    EXPECT_TRUE(a->downs.empty());
}

TEST_F(Bounded, ClosingWaitsForASlowPeerOnlySoLong) {
    connect(Limits{.drain = 300ms});
    const std::size_t before = open_descriptors();
    a->send(link, windows(0, 64 << 20));
    a->perform(wire::CloseLink{link, wire::pb::REASON_SHUTDOWN, ""});
    EXPECT_TRUE(run_until(io, [&] { return open_descriptors() < before; }));
    EXPECT_TRUE(a->downs.empty());
}

TEST_F(Bounded, ShuttingDownWaitsForASlowPeerOnlySoLong) {
    connect({});
    a->send(link, windows(0, 64 << 20));
    bool done = false;
    a->hub.shut_down(300ms, [&] { done = true; });
    EXPECT_TRUE(run_until(io, [&] { return done; }));
    EXPECT_TRUE(a->downs.empty());
    io.restart();
    io.run_for(30s);
    EXPECT_TRUE(io.stopped()) << "a hub that has shut down leaves nothing to do";
}

TEST_F(Bounded, LinksThatComeAndGoLeaveNothingBehind) {
    a.emplace(io);
    address = a->listen();
    Station b(io);
    const std::size_t before = open_descriptors();
    for (std::uint64_t i = 1; i <= 300; ++i) {
        b.dial(i, address);
        ASSERT_TRUE(run_until(io, [&] { return a->ups.size() == i && b.ups.size() == i; }));
        b.perform(wire::CloseLink{LinkId{i}, wire::pb::REASON_SHUTDOWN, ""});
        ASSERT_TRUE(run_until(io, [&] { return a->downs.size() == i; }));
    }
    EXPECT_TRUE(run_until(io, [&] { return open_descriptors() == before; }));
}

}  // namespace
}  // namespace shearwater::link::test
