#include "protocol/link/secret.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace shearwater::link {
namespace {

std::string hex(std::span<const std::byte> bytes) {
    std::string text;
    for (const std::byte b : bytes) {
        constexpr std::string_view digits = "0123456789abcdef";
        text += digits[std::to_integer<std::size_t>(b) / 16];
        text += digits[std::to_integer<std::size_t>(b) % 16];
    }
    return text;
}

struct SecretFile : testing::Test {
    void SetUp() override {
        char name[] = "/tmp/shearwater-secret-XXXXXX";
        const int fd = ::mkstemp(name);
        ASSERT_GE(fd, 0);
        ::close(fd);
        path = name;
        ::unsetenv(std::string(Secret::variable).c_str());
    }
    void TearDown() override { ::unlink(path.c_str()); }
    void write(std::string_view text, mode_t mode) {
        std::ofstream(path) << text;
        ::chmod(path.c_str(), mode);
    }
    std::string path;
};

TEST_F(SecretFile, IsTakenWithoutItsLineEnd) {
    write("0123456789abcdef0123\r\n", 0600);
    EXPECT_EQ(Secret::find(path).value().text(), "0123456789abcdef0123");
    ::chmod(path.c_str(), 0400);
    EXPECT_TRUE(Secret::find(path));
}

TEST_F(SecretFile, MustBeItsOwnersAlone) {
    for (const mode_t mode : {0640U, 0604U, 0620U, 0601U, 0644U}) {
        write("0123456789abcdef0123", mode);
        const auto secret = Secret::find(path);
        ASSERT_FALSE(secret) << mode;
        EXPECT_EQ(secret.error().code, base::Code::refused);
        EXPECT_EQ(secret.error().message().find("0123456789"), std::string::npos)
            << "an error tells the secret";
    }
}

TEST_F(SecretFile, MustBeThereAndOfSomeLength) {
    EXPECT_EQ(Secret::find(path + "-not-there").error().code, base::Code::not_found);
    EXPECT_EQ(Secret::find("/tmp").error().code, base::Code::invalid_argument);
    write("too short\n", 0600);
    EXPECT_EQ(Secret::find(path).error().code, base::Code::invalid_argument);
    write(std::string(5000, 'x'), 0600);
    EXPECT_EQ(Secret::find(path).error().code, base::Code::invalid_argument);
}

TEST_F(SecretFile, ElseItIsTheEnvironments) {
    EXPECT_EQ(Secret::find("").error().code, base::Code::not_found);
    ::setenv(std::string(Secret::variable).c_str(), "from the environment", 1);
    EXPECT_EQ(Secret::find("").value().text(), "from the environment");
    ::setenv(std::string(Secret::variable).c_str(), "short", 1);
    EXPECT_EQ(Secret::find("").error().code, base::Code::invalid_argument);
    ::unsetenv(std::string(Secret::variable).c_str());
}

TEST(Secret, RandomOnesDiffer) {
    const Secret a = Secret::random();
    const Secret b = Secret::random();
    EXPECT_EQ(a.text().size(), 64U);
    EXPECT_EQ(a.text().find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_NE(a.text(), b.text());
    EXPECT_TRUE(Secret::from_text(a.text()));
    EXPECT_NE(random_nonce(), random_nonce());
}

TEST(Secret, AProofDependsOnAllThatGoesIntoIt) {
    const Secret secret = Secret::from_text("0123456789abcdef").value();
    const std::array<std::byte, 16> a{std::byte{1}};
    const std::array<std::byte, 16> b{std::byte{2}};
    const Secret::Proof proof = secret.prove("dial", a, b);
    EXPECT_EQ(proof, secret.prove("dial", a, b));
    EXPECT_NE(proof, secret.prove("accept", a, b));
    EXPECT_NE(proof, secret.prove("dial", b, a));
    EXPECT_NE(proof, secret.prove("dial", a, a));
    EXPECT_NE(proof, Secret::from_text("0123456789abcdeF").value().prove("dial", a, b));
    EXPECT_NE(secret.prove("ab", std::as_bytes(std::span("c", 1)), a),
              secret.prove("a", std::as_bytes(std::span("bc", 2)), a));
}

// HMAC-SHA-256 of 04 "dial" 10 01.. 10 02.., reckoned with another program.
TEST(Secret, AProofIsTheOneOfTheFirstVersion) {
    const Secret secret = Secret::from_text("0123456789abcdef").value();
    const std::array<std::byte, 16> a{std::byte{1}};
    const std::array<std::byte, 16> b{std::byte{2}};
    EXPECT_EQ(hex(secret.prove("dial", a, b)),
              "0f33b6906aba756e82346796887efb5f75ee83341299f8101ffc8cc300aa1896");
}

TEST(Secret, SameComparesAllBytes) {
    std::array<std::byte, 32> a{};
    std::array<std::byte, 32> b{};
    EXPECT_TRUE(same(a, b));
    EXPECT_FALSE(same(a, std::span(b).first(31)));
    for (std::size_t i = 0; i < a.size(); ++i) {
        b[i] = std::byte{128};
        EXPECT_FALSE(same(a, b)) << i;
        b[i] = std::byte{0};
    }
}

}  // namespace
}  // namespace shearwater::link
