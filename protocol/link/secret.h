#pragma once
// The secret that every process of one tree shares, and the proofs of it that a hello carries.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "common/base/result.h"

namespace shearwater::link {

class Secret {
  public:
    static constexpr std::string_view variable = "SHEARWATER_SECRET";

    static Secret random();  // 32 bytes, as 64 hexadecimal digits
    // From a file that only its owner can read (mode 0600 or stricter), else from the environment.
    // At least 16 characters.
    static base::Result<Secret> find(const std::string& file);
    static base::Result<Secret> from_text(std::string_view text);

    const std::string& text() const { return text_; }  // to hand to a child's environment

    using Proof = std::array<std::byte, 32>;
    // HMAC-SHA-256 over `label` and both nonces: a proof of one direction is of no use in the other.
    Proof prove(std::string_view label, std::span<const std::byte> nonce_a,
                std::span<const std::byte> nonce_b) const;

  private:
    explicit Secret(std::string text);
    std::string text_;
};

// In constant time.
bool same(std::span<const std::byte> a, std::span<const std::byte> b);
std::array<std::byte, 16> random_nonce();

}  // namespace shearwater::link
