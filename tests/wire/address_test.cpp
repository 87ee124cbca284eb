#include <gtest/gtest.h>

#include "protocol/wire/events.h"

namespace shearwater::wire {
namespace {

TEST(Address, IsReadInEveryForm) {
    EXPECT_EQ(parse_address("node7", 9000).value(), (Address{"node7", 9000}));
    EXPECT_EQ(parse_address("node7:80", 9000).value(), (Address{"node7", 80}));
    EXPECT_EQ(parse_address("127.0.0.1:0", 9000).value(), (Address{"127.0.0.1", 0}));
    EXPECT_EQ(parse_address("127.0.0.1:65535", 9000).value(), (Address{"127.0.0.1", 65535}));
    EXPECT_EQ(parse_address("[::1]:80", 9000).value(), (Address{"::1", 80}));
    EXPECT_EQ(parse_address("[::1]", 9000).value(), (Address{"::1", 9000}));
    EXPECT_EQ(parse_address("::1", 9000).value(), (Address{"::1", 9000}));
    EXPECT_EQ(parse_address("fe80::1%eth0", 9000).value(), (Address{"fe80::1%eth0", 9000}));
}

TEST(Address, IsWrittenAsItIsRead) {
    for (const Address& address : {Address{"node7", 80}, Address{"::1", 9000}, Address{"10.1.2.3", 1}}) {
        EXPECT_EQ(parse_address(to_string(address), 0).value(), address);
    }
    EXPECT_EQ(to_string({"::1", 80}), "[::1]:80");
}

TEST(Address, IsRefusedByName) {
    for (const char* text :
         {"", ":", ":80", "host:", "host:65536", "host:-1", "host:8o", "host: 80", "[::1", "[::1]80", "[]:80",
          "[::1]:", "a b:80", "host/x:80", "h\x01st:80", "host:99999999999999999999"}) {
        const auto address = parse_address(text, 9000);
        ASSERT_FALSE(address) << text;
        EXPECT_EQ(address.error().code, base::Code::invalid_argument);
        EXPECT_NE(address.error().message().find("address '"), std::string::npos);
    }
    EXPECT_FALSE(parse_address(std::string(300, 'a'), 1));
}

}  // namespace
}  // namespace shearwater::wire
