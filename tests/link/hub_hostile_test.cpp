// Peers that are broken, foreign or ill-meaning. Each test ends with the hub serving a good one.

#include <fstream>

#include "tests/link/support.h"

namespace shearwater::link::test {
namespace {

std::vector<std::byte> header(std::uint16_t version, std::uint16_t type, std::uint32_t body,
                              std::uint64_t payload) {
    std::vector<std::byte> bytes{std::byte{'S'}, std::byte{'W'}, std::byte{'T'}, std::byte{'R'}};
    const auto put = [&](std::uint64_t value, int count) {
        for (int i = 0; i < count; ++i) {
            bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
        }
    };
    put(version, 2);
    put(type, 2);
    put(body, 4);
    put(payload, 8);
    return bytes;
}

std::vector<std::byte> text(std::string_view s) {
    const auto bytes = std::as_bytes(std::span(s));
    return {bytes.begin(), bytes.end()};
}

template <class T>
std::uint16_t number_of() {
    return wire::type_of(wire::Body(T()));
}

std::size_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t total = 0;
    std::size_t resident = 0;
    statm >> total >> resident;
    return resident * 4096;
}

struct Hostile : testing::Test {
    explicit Hostile(const Limits& limits = {}) : a(io, secret_of(), limits), address(a.listen()) {}

    void TearDown() override {
        const std::size_t ups = a.ups.size();
        Station good(io);
        good.dial(1, address);
        EXPECT_TRUE(run_until(io, [&] { return !good.ups.empty() && a.ups.size() == ups + 1; }))
            << "the hub no longer serves a good peer";
    }

    // What an unfinished peer is told after it sent `bytes`, which the hub has to name in its own way too.
    void expect_refusal(const std::vector<std::byte>& bytes, wire::pb::Reason reason) {
        const std::size_t before = a.refused.size();
        Raw raw(io, address);
        ASSERT_TRUE(raw.next<wire::pb::Challenge>());
        ASSERT_TRUE(raw.write(bytes));
        const auto goodbye = raw.next<wire::pb::Goodbye>();
        ASSERT_TRUE(goodbye);
        EXPECT_EQ(goodbye->reason(), reason);
        ASSERT_TRUE(run_until(io, [&] { return a.refused.size() == before + 1; }));
        EXPECT_EQ(a.refused.back().reason, reason);
        EXPECT_EQ(a.refused.back().peer_host, "127.0.0.1");
        EXPECT_TRUE(a.ups.empty());
    }

    // The same on a link that is up.
    void expect_end(const std::vector<std::byte>& bytes, wire::pb::Reason reason) {
        const std::size_t before = a.downs.size();
        Raw raw(io, address);
        ASSERT_TRUE(raw.shake_hands());
        raw.write(bytes);
        const auto goodbye = raw.next<wire::pb::Goodbye>();
        ASSERT_TRUE(goodbye);
        EXPECT_EQ(goodbye->reason(), reason);
        ASSERT_TRUE(run_until(io, [&] { return a.downs.size() == before + 1; }));
        EXPECT_EQ(a.downs.back().reason, reason);
        EXPECT_FALSE(a.downs.back().text.empty());
        EXPECT_TRUE(a.received.empty());
    }

    asio::io_context io;
    Station a;
    wire::Address address;
};

TEST_F(Hostile, AWrongSecretIsNamedOnBothSides) {
    Station b(io, secret_of("quite another secret, of some length"));
    b.dial(1, address);
    ASSERT_TRUE(run_until(io, [&] { return !b.downs.empty() && !a.refused.empty(); }));
    EXPECT_EQ(b.downs[0].reason, wire::pb::REASON_BAD_SECRET);
    EXPECT_EQ(a.refused[0].reason, wire::pb::REASON_BAD_SECRET);
    EXPECT_TRUE(a.ups.empty());
    EXPECT_TRUE(b.ups.empty());
}

TEST_F(Hostile, AHelloOfVersionsWeDoNotSpeak) {
    Raw raw(io, address);
    wire::pb::Hello hello = raw.hello();
    hello.set_version_min(wire::protocol_version + 1);
    hello.set_version_max(wire::protocol_version + 5);
    ASSERT_TRUE(raw.write(wire::message(hello)));
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_BAD_VERSION);
}

TEST_F(Hostile, AHelloOfNoRole) {
    Raw raw(io, address);
    wire::pb::Hello hello = raw.hello();
    hello.set_role(static_cast<wire::pb::Role>(77));
    ASSERT_TRUE(raw.write(wire::message(hello)));
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_INVALID);
}

TEST_F(Hostile, AnOldHelloIsOfNoUse) {
    Raw first(io, address);
    const wire::pb::Hello overheard = first.hello();
    Raw second(io, address);
    ASSERT_TRUE(second.write(wire::message(overheard)));
    EXPECT_EQ(second.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_BAD_SECRET);
}

TEST_F(Hostile, GarbageBeforeTheHello) {
    expect_refusal(text("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"), wire::pb::REASON_BAD_MAGIC);
    expect_refusal(std::vector<std::byte>(100000, std::byte{0xFF}), wire::pb::REASON_BAD_MAGIC);
    expect_refusal(header(1, 60000, 0, 0), wire::pb::REASON_BAD_TYPE);
    expect_refusal(header(0, number_of<wire::pb::Hello>(), 0, 0), wire::pb::REASON_BAD_VERSION);
    expect_refusal(header(1, number_of<wire::pb::Hello>(), 65537, 0), wire::pb::REASON_TOO_LARGE);
    expect_refusal(header(1, number_of<wire::pb::Hello>(), 10, 1), wire::pb::REASON_TOO_LARGE);
    expect_refusal(header(1, number_of<wire::pb::Windows>(), 100, 1 << 30), wire::pb::REASON_BAD_TYPE);
    expect_refusal(header(1, number_of<wire::pb::Cancel>(), 0, 0), wire::pb::REASON_BAD_TYPE);
    std::vector<std::byte> broken = header(1, number_of<wire::pb::Hello>(), 3, 0);
    broken.insert(broken.end(), 3, std::byte{0xFF});
    expect_refusal(broken, wire::pb::REASON_MALFORMED);
}

TEST_F(Hostile, GarbageOnAnOpenLink) {
    expect_end(text("hello? is anybody there, at all?"), wire::pb::REASON_BAD_MAGIC);
    expect_end(header(wire::protocol_version + 1, number_of<wire::pb::Cancel>(), 0, 0),
               wire::pb::REASON_BAD_VERSION);
    expect_end(header(wire::handshake_version, number_of<wire::pb::Cancel>(), 0, 0),
               wire::pb::REASON_BAD_VERSION);
    expect_end(header(wire::protocol_version, 7, 0, 0), wire::pb::REASON_BAD_TYPE);
    expect_end(header(wire::protocol_version, number_of<wire::pb::Hello>(), 0, 0), wire::pb::REASON_BAD_TYPE);
    expect_end(header(wire::protocol_version, number_of<wire::pb::Cancel>(), 0xFFFFFFFFU, 0),
               wire::pb::REASON_TOO_LARGE);
    expect_end(header(wire::protocol_version, number_of<wire::pb::Windows>(), 0, ~std::uint64_t{0}),
               wire::pb::REASON_TOO_LARGE);
    std::vector<std::byte> broken = header(wire::protocol_version, number_of<wire::pb::Cancel>(), 3, 0);
    broken.insert(broken.end(), 3, std::byte{0xFF});
    expect_end(broken, wire::pb::REASON_MALFORMED);
}

TEST_F(Hostile, TheReasonReachesAPeerThatIsStillTalking) {
    Raw raw(io, address);
    ASSERT_TRUE(raw.shake_hands());
    raw.write(header(wire::protocol_version, number_of<wire::pb::Frame>(), 0, std::uint64_t{1} << 40));
    raw.write(std::vector<std::byte>(20 << 20));
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_TOO_LARGE);
}

TEST_F(Hostile, AClaimedLengthTakesNoMemoryUntilItsBytesArrive) {
    const std::size_t before = resident_bytes();
    std::list<Raw> claimers;
    for (int i = 0; i < 20; ++i) {
        Raw& raw = claimers.emplace_back(io, address);
        ASSERT_TRUE(raw.shake_hands());
        ASSERT_TRUE(raw.write(
            header(wire::protocol_version, number_of<wire::pb::Windows>(), 0, std::uint64_t{1} << 30)));
        ASSERT_TRUE(raw.write(std::vector<std::byte>(1000)));
    }
    run_for(io, 100ms);
    EXPECT_LT(resident_bytes(), before + (std::size_t{200} << 20));
    EXPECT_TRUE(a.downs.empty());
    claimers.clear();
    ASSERT_TRUE(run_until(io, [&] { return a.downs.size() == 20; }));
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_LOST);
    EXPECT_TRUE(a.received.empty());
}

TEST_F(Hostile, AConversationCutAtEveryByte) {
    const std::vector<std::byte> second = bytes_of(cancel(77));
    const std::vector<std::byte> third = bytes_of(windows(78, 40));
    std::size_t length = 1;
    for (std::size_t cut = 0; cut <= length; ++cut) {
        a.ups.clear();
        a.downs.clear();
        a.received.clear();
        a.refused.clear();
        std::optional<Raw> raw(std::in_place, io, address);
        std::vector<std::byte> conversation = bytes_of(wire::message(raw->hello()));
        const std::size_t hello = conversation.size();
        conversation.insert(conversation.end(), second.begin(), second.end());
        conversation.insert(conversation.end(), third.begin(), third.end());
        length = conversation.size();
        ASSERT_TRUE(raw->write(std::span(conversation).first(cut)));
        if (cut >= hello) {
            ASSERT_TRUE(raw->next<wire::pb::Welcome>());
        }
        raw.reset();
        ASSERT_TRUE(run_until(io, [&] { return a.downs.size() + a.refused.size() == 1; })) << cut;
        EXPECT_EQ(a.ups.size(), cut >= hello ? 1U : 0U) << cut;
        EXPECT_EQ(a.downs.size(), a.ups.size()) << cut;
        const std::size_t whole = cut == length ? 2 : cut >= hello + second.size() ? 1 : 0;
        EXPECT_EQ(a.received.size(), whole) << cut;
        EXPECT_EQ(a.downs.empty() ? a.refused[0].reason : a.downs[0].reason, wire::pb::REASON_LOST) << cut;
    }
    EXPECT_GT(length, 150U);
}

TEST_F(Hostile, APeerThatVanishesMidPayload) {
    Raw raw(io, address);
    ASSERT_TRUE(raw.shake_hands());
    const std::vector<std::byte> message = bytes_of(windows(1, 4 << 20));
    ASSERT_TRUE(raw.write(std::span(message).first(message.size() / 2)));
    raw.socket().set_option(tcp::socket::linger(true, 0));  // a reset, not an end
    raw.socket().close();
    ASSERT_TRUE(run_until(io, [&] { return !a.downs.empty(); }));
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_LOST);
    EXPECT_TRUE(a.received.empty());
}

TEST_F(Hostile, AGoodbyeOfAReasonNobodyKnows) {
    Raw raw(io, address);
    ASSERT_TRUE(raw.shake_hands());
    wire::pb::Goodbye goodbye;
    goodbye.set_reason(static_cast<wire::pb::Reason>(12345));
    goodbye.set_text("\x1b[31mred");
    ASSERT_TRUE(raw.write(wire::message(goodbye)));
    ASSERT_TRUE(run_until(io, [&] { return !a.downs.empty(); }));
    EXPECT_EQ(a.downs[0].reason, wire::pb::REASON_NONE);
    EXPECT_EQ(a.downs[0].text, "?[31mred");
}

// ---- peers that are dialled ----

struct HostileListener : testing::Test {
    // Dials a raw listener and gives the link's other end.
    Raw dialled() {
        const tcp::endpoint at = acceptor.local_endpoint();
        a.dial(1, {at.address().to_string(), at.port()});
        std::optional<boost::system::error_code> done;
        tcp::socket socket(io);
        acceptor.async_accept(socket, [&](boost::system::error_code error) { done = error; });
        EXPECT_TRUE(run_until(io, [&] { return done.has_value(); }));
        return {io, std::move(socket)};
    }
    void expect_down(wire::pb::Reason reason) {
        ASSERT_TRUE(run_until(io, [&] { return !a.downs.empty(); }));
        EXPECT_EQ(a.downs[0].link, LinkId{1});
        EXPECT_EQ(a.downs[0].reason, reason) << a.downs[0].text;
        EXPECT_TRUE(a.ups.empty());
        EXPECT_TRUE(a.refused.empty());
    }

    asio::io_context io;
    Limits limits{.handshake = 400ms};
    Station a{io, secret_of(), limits};
    tcp::acceptor acceptor{io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)};
};

TEST_F(HostileListener, SaysNothing) {
    Raw raw = dialled();
    expect_down(wire::pb::REASON_TIMED_OUT);
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_TIMED_OUT);
}

TEST_F(HostileListener, SpeaksAnotherProtocol) {
    Raw raw = dialled();
    raw.write(text("SSH-2.0-OpenSSH_9.2p1 Debian-2\r\n"));
    expect_down(wire::pb::REASON_BAD_MAGIC);
}

TEST_F(HostileListener, ClosesAtOnce) {
    dialled().socket().close();
    expect_down(wire::pb::REASON_LOST);
}

TEST_F(HostileListener, SpeaksOnlyVersionsToCome) {
    Raw raw = dialled();
    wire::pb::Challenge challenge = challenge_with(random_nonce());
    challenge.set_version_min(wire::protocol_version + 1);
    challenge.set_version_max(wire::protocol_version + 3);
    raw.write(wire::message(challenge));
    expect_down(wire::pb::REASON_BAD_VERSION);
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_BAD_VERSION);
}

TEST_F(HostileListener, DoesNotKnowTheSecret) {
    Raw raw = dialled();
    const Nonce nonce = random_nonce();
    raw.write(wire::message(challenge_with(nonce)));
    const wire::pb::Hello hello = raw.next<wire::pb::Hello>().value();
    wire::pb::Welcome welcome;
    welcome.set_version(1);
    welcome.set_proof(hello.proof());  // the dialling side's own, sent back
    raw.write(wire::message(welcome));
    expect_down(wire::pb::REASON_BAD_SECRET);
    EXPECT_EQ(raw.next<wire::pb::Goodbye>().value().reason(), wire::pb::REASON_BAD_SECRET);
}

TEST_F(HostileListener, PicksAVersionNobodyOffered) {
    Raw raw = dialled();
    const Nonce nonce = random_nonce();
    raw.write(wire::message(challenge_with(nonce)));
    wire::pb::Welcome welcome =
        admit(raw.next<wire::pb::Hello>().value(), nonce, secret_of()).value().welcome;
    welcome.set_version(0);
    raw.write(wire::message(welcome));
    expect_down(wire::pb::REASON_BAD_VERSION);
}

TEST_F(HostileListener, RefusesWithItsOwnReason) {
    Raw raw = dialled();
    wire::pb::Goodbye goodbye;
    goodbye.set_reason(wire::pb::REASON_TOO_MANY_LINKS);
    raw.write(bytes_of(wire::message(goodbye), wire::handshake_version));
    expect_down(wire::pb::REASON_TOO_MANY_LINKS);
}

}  // namespace
}  // namespace shearwater::link::test
