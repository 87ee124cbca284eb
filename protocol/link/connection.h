#pragma once
// One link: a socket, one coroutine that reads it and one that writes it.
//
//   opening --handshake--> up --goodbye, fault--> closing --drained, deadline--> over
//      \-----------------------fault----------------^

#include <array>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <optional>

#include "protocol/link/child_program.h"
#include "protocol/link/handshake.h"
#include "protocol/link/limits.h"
#include "protocol/link/send_queue.h"
#include "protocol/wire/events.h"

namespace shearwater::link {

// TCP, or any other stream that has a descriptor.
using Socket = boost::asio::generic::stream_protocol::socket;
template <class T>
using Awaitable = boost::asio::awaitable<T>;

class Connection;

// Who has the links, and what they share.
class Owner {
  public:
    Owner(Secret secret_, std::string name_, const Limits& limits_)
        : limits(limits_), secret(std::move(secret_)), name(std::move(name_)) {}
    virtual ~Owner() = default;
    Owner(const Owner&) = delete;
    Owner& operator=(const Owner&) = delete;

    virtual void on_up(const std::shared_ptr<Connection>& connection, const Peer& peer) = 0;
    // `arriving`: from the first byte of its payload to the last.
    virtual void on_message(const std::shared_ptr<Connection>& connection, wire::Message message,
                            std::chrono::duration<double> arriving) = 0;
    // It has ended by a fault or by the peer's goodbye, perhaps from inside one of its functions.
    virtual void on_end(const std::shared_ptr<Connection>& connection, const wire::Fault& fault) = 0;
    // Nothing more comes of it.
    virtual void on_over(const std::shared_ptr<Connection>& connection) = 0;

    const Limits limits;
    const Secret secret;
    const std::string name;
    Clock clock;
    std::uint64_t bytes_sent = 0;
    std::uint64_t bytes_received = 0;
};

class Connection : public std::enable_shared_from_this<Connection> {
  public:
    Connection(boost::asio::io_context& io, std::shared_ptr<Owner> owner);
    // Starts the coroutines; they keep the connection. Once, one of the two.
    void accept(Socket socket, std::string peer_host);
    void dial(wire::LinkId link, wire::Route route, pb::Role role);

    // Queues a message; does nothing on a link that is not up. A full queue ends the link.
    void send(const wire::Message& message);
    // Says goodbye after what is queued. on_end does not follow, on_over does.
    void close(pb::Reason reason, std::string_view text, std::chrono::milliseconds drain);
    // Ends it by a fault, as if the peer had made it.
    void refuse(const wire::Fault& fault) { finish(fault); }
    // Ends it at once, without a word to anyone but on_over.
    void cut();
    // Cuts it and forgets the owner.
    void drop();
    // Looks at the deadlines; to be called some ten times a second.
    void check_deadlines();

    bool opening() const { return phase_ == Phase::opening; }
    bool accepted() const { return !dialled_; }
    Clock::Time opened() const { return opened_; }
    const std::string& peer_host() const { return peer_host_; }

    wire::LinkId link{};  // of an accepted one: once it is up

  private:
    enum class Phase { opening, up, closing, over };

    void start();
    static Awaitable<void> read_side(std::shared_ptr<Connection> self);
    static Awaitable<void> write_side(std::shared_ptr<Connection> self);

    Awaitable<wire::Parsed<void>> connect();
    Awaitable<wire::Parsed<void>> connect_through_command();
    Awaitable<wire::Parsed<void>> connect_to(boost::asio::generic::stream_protocol::endpoint endpoint);
    Awaitable<wire::Parsed<Peer>> shake_hands();
    Awaitable<wire::Parsed<Peer>> shake_hands_accepting();
    Awaitable<wire::Parsed<Peer>> shake_hands_dialling();
    Awaitable<void> read_messages();
    Awaitable<void> discard();
    void handle(wire::Message message);

    // A message of the type that is expected, or of any that an open link carries. A goodbye is a fault.
    Awaitable<wire::Parsed<wire::Message>> read_message(std::optional<std::uint16_t> expected);
    template <class T>
    Awaitable<wire::Parsed<T>> expect();
    wire::Parsed<wire::Header> accept_header(std::span<const std::byte, wire::header_bytes> bytes,
                                             std::optional<std::uint16_t> expected) const;
    // `size` bytes, taking up memory as they arrive.
    Awaitable<wire::Parsed<base::Buffer>> read_bytes(std::uint64_t size);
    Awaitable<bool> read_into(std::span<std::byte> to);
    std::size_t take_ahead(std::span<std::byte> to);
    Awaitable<bool> write(std::span<const Outgoing> batch);

    void queue(const wire::Message& message);
    void finish(const wire::Fault& fault);
    void say_goodbye(pb::Reason reason, std::string_view text);
    void check_open_link(Clock::Time now);
    wire::Fault lost() const;

    boost::asio::io_context& io_;
    std::shared_ptr<Owner> owner_;  // null: dropped
    Limits limits_;
    Socket socket_;
    boost::asio::steady_timer wake_;  // for the writer: cancelled when there is something to do
    SendQueue queue_;

    std::array<std::byte, 16384> ahead_room_;
    std::span<const std::byte> ahead_;  // what came behind what was asked for last

    Phase phase_ = Phase::opening;
    bool dialled_ = false;
    bool connected_ = false;
    bool broken_ = false;     // reading or writing failed
    bool peer_left_ = false;  // it said goodbye
    bool writing_ = false;
    std::uint16_t version_ = wire::handshake_version;
    std::string broken_text_;

    wire::Route route_;                    // dialled
    std::shared_ptr<ChildProgram> child_;  // where that is a command
    pb::Role role_ = pb::ROLE_UNKNOWN;
    std::string peer_host_;
    std::uint64_t pings_ = 0;

    Clock::Time opened_;
    Clock::Time heard_;                         // last byte in
    std::chrono::duration<double> arriving_{};  // of the last message's payload
    Clock::Time spoke_;                         // last byte out
    Clock::Time write_broke_;
    Clock::Time close_by_;
};

}  // namespace shearwater::link
