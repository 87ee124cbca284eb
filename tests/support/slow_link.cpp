#include "tests/support/slow_link.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/asio/write.hpp>
#include <deque>
#include <vector>

namespace shearwater::test {

namespace asio = boost::asio;
using asio::ip::tcp;
using Clock = std::chrono::steady_clock;

namespace {

constexpr auto awaiting = asio::as_tuple(asio::use_awaitable);
constexpr std::size_t packet = 4096;
constexpr std::size_t router_bytes = std::size_t{1} << 16;

// One direction of a connection.
class Lane : public std::enable_shared_from_this<Lane> {
  public:
    Lane(std::shared_ptr<tcp::socket> from, std::shared_ptr<tcp::socket> to, const LinkShape& shape)
        : from_(std::move(from)), to_(std::move(to)), shape_(shape), changed_(from_->get_executor()) {
        room_ = router_bytes + static_cast<std::size_t>(shape.bytes_per_second * shape.one_way.count());
    }

    void start() {
        asio::co_spawn(from_->get_executor(), take(), asio::detached);
        asio::co_spawn(from_->get_executor(), give(), asio::detached);
    }

  private:
    struct Packet {
        Clock::time_point arrives;
        std::vector<std::byte> bytes;
    };

    asio::awaitable<void> take() {
        const auto self = shared_from_this();
        Clock::time_point free = Clock::now();  // the link is, for another byte
        while (!ended_) {
            if (held_ >= room_) {
                co_await wait();
                continue;
            }
            std::vector<std::byte> bytes(packet);
            const auto [error, size] = co_await from_->async_read_some(asio::buffer(bytes), awaiting);
            if (error) {
                break;
            }
            bytes.resize(size);
            const std::chrono::duration<double> passing(static_cast<double>(size) / shape_.bytes_per_second);
            free = std::max(free, Clock::now()) + std::chrono::duration_cast<Clock::duration>(passing);
            held_ += size;
            packets_.push_back(
                {free + std::chrono::duration_cast<Clock::duration>(shape_.one_way), std::move(bytes)});
            changed_.cancel();
        }
        ended_ = true;
        changed_.cancel();
    }

    asio::awaitable<void> give() {
        const auto self = shared_from_this();
        asio::steady_timer due(from_->get_executor());
        while (!ended_ || !packets_.empty()) {
            if (packets_.empty()) {
                co_await wait();
                continue;
            }
            due.expires_at(packets_.front().arrives);
            co_await due.async_wait(awaiting);
            const Packet next = std::move(packets_.front());
            packets_.pop_front();
            const auto [error, size] = co_await asio::async_write(*to_, asio::buffer(next.bytes), awaiting);
            held_ -= next.bytes.size();
            changed_.cancel();
            if (error) {
                break;
            }
        }
        boost::system::error_code ignored;
        from_->close(ignored);
        to_->close(ignored);
        ended_ = true;
        changed_.cancel();
    }

    asio::awaitable<void> wait() {
        changed_.expires_at(Clock::time_point::max());
        co_await changed_.async_wait(awaiting);
    }

    std::shared_ptr<tcp::socket> from_, to_;
    LinkShape shape_;
    asio::steady_timer changed_;
    std::deque<Packet> packets_;
    std::size_t held_ = 0;
    std::size_t room_;
    bool ended_ = false;
};

}  // namespace

struct SlowLink::Carrier {
    Carrier(asio::io_context& io, const wire::Address& server_in, const LinkShape& shape_in)
        : acceptor(io, tcp::endpoint(asio::ip::address_v4::loopback(), 0)),
          server(asio::ip::make_address(server_in.host), server_in.port),
          shape(shape_in) {}

    asio::awaitable<void> accept() {
        for (;;) {
            auto client = std::make_shared<tcp::socket>(acceptor.get_executor());
            const auto [error] = co_await acceptor.async_accept(*client, awaiting);
            if (error) {
                co_return;
            }
            auto to_server = std::make_shared<tcp::socket>(acceptor.get_executor());
            const auto [refused] = co_await to_server->async_connect(server, awaiting);
            if (refused) {
                continue;
            }
            boost::system::error_code ignored;
            for (const auto& socket : {client, to_server}) {
                socket->set_option(tcp::no_delay(true), ignored);
                // What kernels hold would hide what the link is.
                socket->set_option(tcp::socket::receive_buffer_size(1 << 16), ignored);
            }
            std::make_shared<Lane>(client, to_server, shape)->start();
            std::make_shared<Lane>(to_server, client, shape)->start();
        }
    }

    tcp::acceptor acceptor;
    tcp::endpoint server;
    LinkShape shape;
};

SlowLink::SlowLink(const wire::Address& server, const LinkShape& shape)
    : carrier_(std::make_unique<Carrier>(io_, server, shape)),
      address_{"127.0.0.1", carrier_->acceptor.local_endpoint().port()} {
    asio::co_spawn(io_, carrier_->accept(), asio::detached);
    thread_ = std::jthread([this] { io_.run(); });
}

SlowLink::~SlowLink() {
    io_.stop();
    thread_.join();
}

}  // namespace shearwater::test
