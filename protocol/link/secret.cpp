#include "protocol/link/secret.h"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/base/check.h"

namespace shearwater::link {
namespace {

constexpr std::size_t shortest = 16;
constexpr std::size_t longest = 4096;

void fill_randomly(std::span<std::byte> bytes) {
    const int done =
        RAND_bytes(reinterpret_cast<unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
    base::check(done == 1, "the system gives random bytes");
}

class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) {
            ::close(fd_);
        }
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }

  private:
    int fd_;
};

base::Result<std::string> read_private(const std::string& file) {
    const std::string operation = "read the secret in " + file;
    const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (opened.get() < 0 || ::fstat(opened.get(), &status) != 0) {
        return base::error(errno == ENOENT ? base::Code::not_found : base::Code::io, operation,
                           std::strerror(errno));
    }
    if (!S_ISREG(status.st_mode)) {
        return base::error(base::Code::invalid_argument, operation, "it is not a plain file");
    }
    if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
        return base::error(base::Code::refused, operation, "others can read or write it: chmod 600 it");
    }
    std::string text(longest + 1, '\0');
    const ssize_t size = ::read(opened.get(), text.data(), text.size());
    if (size < 0) {
        return base::error(base::Code::io, operation, std::strerror(errno));
    }
    text.resize(static_cast<std::size_t>(size));
    return text;
}

std::string_view without_edges(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blank);
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

}  // namespace

Secret::Secret(std::string text) : text_(std::move(text)) {}

Secret Secret::random() {
    constexpr std::string_view digits = "0123456789abcdef";
    std::array<std::byte, 32> bytes{};
    fill_randomly(bytes);
    std::string text;
    for (const std::byte b : bytes) {
        text += digits[std::to_integer<std::size_t>(b >> 4)];
        text += digits[std::to_integer<std::size_t>(b & std::byte{15})];
    }
    return Secret(std::move(text));
}

base::Result<Secret> Secret::find(const std::string& file) {
    if (!file.empty()) {
        const auto text = read_private(file);
        return text ? from_text(*text) : base::Result<Secret>(text.error());
    }
    const char* text = std::getenv(std::string(variable).c_str());
    if (text == nullptr) {
        return base::error(base::Code::not_found, "find the secret",
                           "name a file that holds it, or set " + std::string(variable));
    }
    return from_text(text);
}

base::Result<Secret> Secret::from_text(std::string_view text) {
    const std::string_view core = without_edges(text);
    if (core.size() < shortest || core.size() > longest) {
        return base::error(base::Code::invalid_argument, "take the secret",
                           "it has " + std::to_string(core.size()) + " characters, " +
                               std::to_string(shortest) + " to " + std::to_string(longest) + " are wanted");
    }
    return Secret(std::string(core));
}

Secret::Proof Secret::prove(std::string_view label, std::span<const std::byte> nonce_a,
                            std::span<const std::byte> nonce_b) const {
    // Each part goes in behind its length, so that no two different inputs run into the same bytes.
    std::vector<std::byte> text;
    const auto append = [&](std::span<const std::byte> part) {
        base::check(part.size() < 256, "a part of a proof is short");
        text.push_back(static_cast<std::byte>(part.size()));
        text.insert(text.end(), part.begin(), part.end());
    };
    append(std::as_bytes(std::span(label)));
    append(nonce_a);
    append(nonce_b);

    Proof proof{};
    unsigned int size = 0;
    const unsigned char* done = HMAC(EVP_sha256(), text_.data(), static_cast<int>(text_.size()),
                                     reinterpret_cast<const unsigned char*>(text.data()), text.size(),
                                     reinterpret_cast<unsigned char*>(proof.data()), &size);
    base::check(done != nullptr && size == proof.size(), "HMAC-SHA-256 is there and gives 32 bytes");
    return proof;
}

bool same(std::span<const std::byte> a, std::span<const std::byte> b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::array<std::byte, 16> random_nonce() {
    std::array<std::byte, 16> nonce{};
    fill_randomly(nonce);
    return nonce;
}

}  // namespace shearwater::link
