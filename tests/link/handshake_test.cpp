#include "protocol/link/handshake.h"

#include <gtest/gtest.h>

namespace shearwater::link {
namespace {

TEST(CommonVersion, IsTheHighestThatBothSpeak) {
    EXPECT_EQ(common_version({1, 1}, {1, 1}).value(), 1);
    EXPECT_EQ(common_version({1, 3}, {2, 5}).value(), 3);
    EXPECT_EQ(common_version({2, 5}, {1, 3}).value(), 3);
    EXPECT_EQ(common_version({1, 9}, {4, 4}).value(), 4);
    for (const VersionRange theirs :
         {VersionRange{4, 9}, VersionRange{0, 0}, VersionRange{3, 2}, VersionRange{5, 2}}) {
        EXPECT_EQ(common_version({1, 3}, theirs).has_value(), false) << theirs.min << " to " << theirs.max;
    }
    EXPECT_EQ(common_version({2, 3}, {4, 5}).error().reason, pb::REASON_BAD_VERSION);
}

struct Handshake : testing::Test {
    Secret secret = Secret::from_text("a secret for handshakes").value();
    Secret other = Secret::from_text("another secret for them").value();
    Nonce a = random_nonce();
    Nonce d = random_nonce();
    pb::Challenge challenge = challenge_with(a);
    pb::Hello hello = answer(challenge, secret, pb::ROLE_CHILD, "na\nme", d).value();
};

TEST_F(Handshake, SucceedsBetweenThoseWhoShareTheSecret) {
    const Admission admission = admit(hello, a, secret).value();
    EXPECT_EQ(admission.peer.role, pb::ROLE_CHILD);
    EXPECT_EQ(admission.peer.name, "na?me");
    EXPECT_EQ(admission.version, wire::protocol_version);
    EXPECT_EQ(verify(admission.welcome, challenge, d, secret).value(), wire::protocol_version);
}

TEST_F(Handshake, FailsWithoutTheSecretOnEitherSide) {
    EXPECT_EQ(admit(hello, a, other).error().reason, pb::REASON_BAD_SECRET);
    const pb::Hello strange = answer(challenge, other, pb::ROLE_CHILD, "", d).value();
    const Admission by_other = admit(strange, a, other).value();
    EXPECT_EQ(verify(by_other.welcome, challenge, d, secret).error().reason, pb::REASON_BAD_SECRET);
}

TEST_F(Handshake, EveryAlteredByteOfAProofIsNoticed) {
    const pb::Welcome welcome = admit(hello, a, secret).value().welcome;
    for (std::size_t i = 0; i < hello.proof().size(); ++i) {
        pb::Hello altered = hello;
        (*altered.mutable_proof())[i] ^= 1;
        EXPECT_EQ(admit(altered, a, secret).error().reason, pb::REASON_BAD_SECRET);
        pb::Welcome answered = welcome;
        (*answered.mutable_proof())[i] ^= 1;
        EXPECT_EQ(verify(answered, challenge, d, secret).error().reason, pb::REASON_BAD_SECRET);
    }
    hello.clear_proof();
    EXPECT_EQ(admit(hello, a, secret).error().reason, pb::REASON_BAD_SECRET);
}

TEST_F(Handshake, NoncesAreOfOneLength) {
    for (const std::size_t size : {std::size_t{0}, std::size_t{15}, std::size_t{17}, std::size_t{4000}}) {
        challenge.set_nonce(std::string(size, 'x'));
        EXPECT_EQ(answer(challenge, secret, pb::ROLE_CHILD, "", d).error().reason, pb::REASON_INVALID);
        hello.set_nonce(std::string(size, 'x'));
        EXPECT_EQ(admit(hello, a, secret).error().reason, pb::REASON_INVALID);
    }
}

TEST_F(Handshake, RolesAreKnown) {
    for (const int role : {0, 5, -1, 1000}) {
        hello.set_role(static_cast<pb::Role>(role));
        EXPECT_EQ(admit(hello, a, secret).error().reason, pb::REASON_INVALID) << role;
    }
}

TEST_F(Handshake, VersionsMeet) {
    for (const std::uint32_t theirs : {wire::oldest_version - 1, wire::protocol_version + 1}) {
        challenge.set_version_min(theirs);
        challenge.set_version_max(theirs);
        EXPECT_EQ(answer(challenge, secret, pb::ROLE_CHILD, "", d).error().reason, pb::REASON_BAD_VERSION);
        hello.set_version_min(theirs);
        hello.set_version_max(theirs);
        EXPECT_EQ(admit(hello, a, secret).error().reason, pb::REASON_BAD_VERSION);
    }
}

}  // namespace
}  // namespace shearwater::link
