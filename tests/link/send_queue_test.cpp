#include "protocol/link/send_queue.h"

#include "tests/link/support.h"

namespace shearwater::link::test {
namespace {

wire::Message pong(std::uint64_t token) {
    wire::pb::Pong body;
    body.set_token(token);
    return wire::message(std::move(body));
}

// The queue's messages as they would be written, header and body.
std::vector<std::vector<std::byte>> drained(SendQueue& queue) {
    std::vector<std::vector<std::byte>> heads;
    while (!queue.empty()) {
        for (const Outgoing& outgoing : queue.pop()) {
            heads.push_back(outgoing.head);
        }
    }
    return heads;
}

std::vector<std::byte> head(const wire::Message& message) {
    return wire::encode_head(message, 1);
}

TEST(SendQueue, KeepsOrderAndCountsBytes) {
    SendQueue queue{Limits{}};
    EXPECT_TRUE(queue.push(cancel(1), 1));
    EXPECT_TRUE(queue.push(windows(2, 1000), 1));
    EXPECT_TRUE(queue.push(cancel(3), 1));
    EXPECT_EQ(queue.messages(), 3U);
    EXPECT_EQ(queue.bytes(), 2 * head(cancel(1)).size() + head(windows(2, 1000)).size() + 1000);
    EXPECT_EQ(drained(queue), (std::vector{head(cancel(1)), head(windows(2, 1000)), head(cancel(3))}));
    EXPECT_EQ(queue.bytes(), 0U);
    EXPECT_TRUE(queue.empty());
}

TEST(SendQueue, SharesAPayload) {
    SendQueue queue{Limits{}};
    const wire::Message message = windows(1, 1000);
    EXPECT_TRUE(queue.push(message, 1));
    EXPECT_EQ(queue.pop().at(0).payload.get(), message.payload.get());
}

TEST(SendQueue, GivesSmallMessagesTogetherAndLargeOnesOneByOne) {
    SendQueue queue{Limits{}};
    constexpr std::size_t large = 100000;
    for (std::uint64_t i = 0; i < 40; ++i) {
        EXPECT_TRUE(queue.push(i == 2 || i == 4 ? windows(i, large) : cancel(i), 1));
    }
    EXPECT_EQ(queue.pop().size(), 4U) << "up to the second large one";
    EXPECT_EQ(queue.pop().size(), 16U);
    EXPECT_EQ(queue.messages(), 20U);
    EXPECT_EQ(queue.bytes(), 20 * head(cancel(30)).size());
    EXPECT_EQ(queue.pop().size(), 16U);
    EXPECT_EQ(queue.pop().size(), 4U);
    EXPECT_TRUE(queue.pop().empty());
}

TEST(SendQueue, OfViewsAndPongsOnlyTheNewestWaits) {
    SendQueue queue{Limits{}};
    for (const wire::Message& m :
         {set_view(1), cancel(1), pong(1), set_view(2), cancel(2), pong(2), set_view(3)}) {
        EXPECT_TRUE(queue.push(m, 1));
    }
    EXPECT_EQ(drained(queue),
              (std::vector{head(cancel(1)), head(cancel(2)), head(pong(2)), head(set_view(3))}));
    EXPECT_EQ(queue.bytes(), 0U);
}

TEST(SendQueue, IsBoundedInMessages) {
    SendQueue queue{Limits{.queued_messages = 3}};
    for (std::uint64_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(queue.push(i == 1 ? set_view(i) : cancel(i), 1));
    }
    EXPECT_FALSE(queue.push(cancel(9), 1));
    EXPECT_TRUE(queue.push(set_view(4), 1)) << "it takes an older one's place";
    EXPECT_EQ(queue.messages(), 3U);
    queue.push_last(cancel(10), 1);
    EXPECT_EQ(queue.messages(), 4U);
}

TEST(SendQueue, IsBoundedInBytes) {
    SendQueue queue{Limits{.queued_bytes = 1000}};
    EXPECT_TRUE(queue.push(windows(1, 5000), 1)) << "one alone may be of any size";
    EXPECT_FALSE(queue.push(cancel(1), 1));
    queue.clear();
    EXPECT_EQ(queue.bytes(), 0U);
    EXPECT_TRUE(queue.push(windows(1, 900), 1));
    EXPECT_FALSE(queue.push(windows(1, 100), 1));
    EXPECT_TRUE(queue.push(cancel(1), 1));
}

}  // namespace
}  // namespace shearwater::link::test
