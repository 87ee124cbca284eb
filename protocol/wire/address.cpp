#include <charconv>

#include "protocol/wire/events.h"

namespace shearwater::wire {
namespace {

constexpr std::size_t longest_host = 253;

bool is_host(std::string_view host) {
    constexpr std::string_view letters =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:%";
    return !host.empty() && host.size() <= longest_host && host.find_first_not_of(letters) == host.npos;
}

}  // namespace

std::string to_string(const Address& address) {
    const std::string port = ":" + std::to_string(address.port);
    return address.host.find(':') == std::string::npos ? address.host + port
                                                       : "[" + address.host + "]" + port;
}

std::string to_string(const Route& route) {
    if (route.command.empty()) {
        return to_string(route.address);
    }
    std::string words;
    for (const std::string& word : route.command) {
        words += (words.empty() ? "" : " ") + word;
    }
    return base::printable(words, 120);
}

base::Result<Address> parse_address(std::string_view text, std::uint16_t default_port) {
    const auto refuse = [&](const char* why) {
        return base::error(base::Code::invalid_argument, "address '" + base::printable(text) + "'", why);
    };
    std::string_view host = text;
    std::string_view port;
    bool has_port = false;
    if (text.starts_with('[')) {
        const std::size_t close = text.find(']');
        if (close == text.npos || (close + 1 < text.size() && text[close + 1] != ':')) {
            return refuse("it should read [HOST]:PORT");
        }
        host = text.substr(1, close - 1);
        has_port = close + 1 < text.size();
        port = has_port ? text.substr(close + 2) : port;
    } else if (const std::size_t colon = text.find(':'); colon != text.npos && colon == text.rfind(':')) {
        host = text.substr(0, colon);
        has_port = true;
        port = text.substr(colon + 1);
    }
    if (!is_host(host)) {
        return refuse("the host is missing or not a host's name");
    }
    Address address{.host = std::string(host), .port = default_port};
    if (has_port) {
        const auto [end, failed] = std::from_chars(port.data(), port.data() + port.size(), address.port);
        if (failed != std::errc{} || end != port.data() + port.size()) {
            return refuse("the port is not a number from 0 to 65535");
        }
    }
    return address;
}

}  // namespace shearwater::wire
