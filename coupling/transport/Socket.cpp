// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Socket.hpp"

#include <sys/stat.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <utility>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::transport
{
namespace
{

/// Room for a whole step of a small case in the system's buffers, where the system allows it [byte].
int constexpr system_buffer = 4 << 20;

/// Messages of one peer that wait in ZeroMQ: the answers and heartbeats of a time-out, and a few that nobody has read.
int constexpr most_unsent = 64;
int constexpr most_unread = 16;

char const* const monitor_address = "inproc://monitor";
int constexpr failed_handshake =
    ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

[[noreturn]] void refuse(Address const& address, char const* action, zmq::error_t const& error)
{
    std::string const why =
        error.num() == EADDRINUSE
            ? "is in use (another program is bound to it); stop that program or choose another endpoint"
            : std::string("cannot be ") + action + " (" + error.what() + "); choose another endpoint";
    throw CouplingError(Fault::endpoint, "endpoint \"" + address.text + "\" " + why);
}

/// Milliseconds for a poll, rounded up so that it does not wake just too early.
std::chrono::milliseconds poll_time(Time until)
{
    return std::max(std::chrono::milliseconds(0), std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()));
}

}  // namespace

Socket::Socket(Role role, Address const& address)
    : role_(role),
      endpoint_(address.text),
      path_(role == Role::server && address.is_ipc() ? std::make_unique<IpcPath>(address.path) : nullptr),
      context_(1),
      socket_(context_, role == Role::server ? zmq::socket_type::router : zmq::socket_type::dealer),
      monitor_(context_, zmq::socket_type::pair)
{
    // Nothing waits in ZeroMQ for long: the other side reads at once, and the protocol allows few messages in flight.
    // Whoever sends more than it may is read as fast as we look at it, and whoever does not read is sent no more.
    socket_.set(zmq::sockopt::sndhwm, most_unsent);
    socket_.set(zmq::sockopt::rcvhwm, most_unread);
    socket_.set(zmq::sockopt::sndbuf, system_buffer);
    socket_.set(zmq::sockopt::rcvbuf, system_buffer);
    socket_.set(zmq::sockopt::linger, 0);
    socket_.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(max_frame_bytes));
    socket_.set(zmq::sockopt::ipv6, address.ipv6);
    if (role == Role::server) socket_.set(zmq::sockopt::router_mandatory, true);
    if (role == Role::client) socket_.set(zmq::sockopt::reconnect_ivl, 20);
    watch_connections();
}

Socket::~Socket()
{
    if (socket_.handle() != nullptr) close(Clock::duration::zero());
}

Socket Socket::connect(std::string const& endpoint, std::optional<ClientKeys> const& keys)
{
    Address const address = parse_address(endpoint, Role::client, keys ? Protection::keys : Protection::none);
    Socket socket(Role::client, address);
    if (keys) socket.protect(*keys);
    try
    {
        socket.socket_.connect(address.text);
    }
    catch (zmq::error_t const& error)
    {
        refuse(address, "reached", error);
    }
    return socket;
}

Socket Socket::bind(std::string const& endpoint, std::optional<ServerKeys> const& keys)
{
    Address const address = parse_address(endpoint, Role::server, keys ? Protection::keys : Protection::none);
    Socket socket(Role::server, address);
    if (keys) socket.protect(*keys);
    try
    {
        socket.socket_.bind(address.text);
        if (address.is_ipc()) ::chmod(address.path.c_str(), S_IRUSR | S_IWUSR);  // its user alone may connect
    }
    catch (zmq::error_t const& error)
    {
        refuse(address, "bound", error);
    }
    socket.endpoint_ = socket.socket_.get(zmq::sockopt::last_endpoint);
    return socket;
}

void Socket::watch_connections()
{
    int constexpr events = ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED | failed_handshake;
    if (zmq_socket_monitor(socket_.handle(), monitor_address, events) != 0) throw zmq::error_t();
    monitor_.connect(monitor_address);
}

void Socket::protect(ClientKeys const& keys)
{
    socket_.set(zmq::sockopt::curve_serverkey, keys.server);
    socket_.set(zmq::sockopt::curve_publickey, keys.own.public_key);
    socket_.set(zmq::sockopt::curve_secretkey, keys.own.secret_key);
}

void Socket::protect(ServerKeys const& keys)
{
    gatekeeper_ = std::make_unique<Gatekeeper>(context_, keys.clients);
    socket_.set(zmq::sockopt::curve_server, true);
    socket_.set(zmq::sockopt::curve_secretkey, keys.own.secret_key);
    socket_.set(zmq::sockopt::zap_domain, std::string("gimdem"));
}

void Socket::note_broken_handshake()
{
    if (role_ == Role::client)
        note_ =
            "a program answers there and breaks off the handshake: the keys of the two sides do not fit, or one has "
            "none";
    else if (gatekeeper_)
        gatekeeper_->note("a connection came without a key, or with another server's public key, and was closed");
}

std::vector<std::string> Socket::take_notes()
{
    if (gatekeeper_) return gatekeeper_->take_notes();
    return note_.empty() ? std::vector<std::string>() : std::vector<std::string>{std::exchange(note_, "")};
}

bool Socket::send(std::string const& receiver, Frames& frames)
{
    try
    {
        auto constexpr address = zmq::send_flags::sndmore | zmq::send_flags::dontwait;
        if (role_ == Role::server && !socket_.send(zmq::buffer(receiver), address)) return false;
        for (std::size_t k = 0; k < frames.size(); ++k)
        {
            auto const more = k + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none;
            if (!socket_.send(frames[k], more | zmq::send_flags::dontwait)) return false;
        }
        return true;
    }
    catch (zmq::error_t const& error)
    {
        if (error.num() == EHOSTUNREACH) return false;
        throw;
    }
}

std::optional<Parcel> Socket::receive()
{
    Parcel parcel;
    Frame frame;
    if (!socket_.recv(frame, zmq::recv_flags::dontwait)) return std::nullopt;
    if (role_ == Role::server)
        parcel.sender = frame.to_string();
    else
        parcel.frames.push_back(std::move(frame));

    while (socket_.get(zmq::sockopt::rcvmore))
    {
        Frame next;
        static_cast<void>(socket_.recv(next, zmq::recv_flags::none));  // all parts arrive together
        // One frame too many is kept, so that the reader sees that there were too many.
        if (parcel.frames.size() <= max_frames) parcel.frames.push_back(std::move(next));
    }
    return parcel;
}

bool Socket::connection_broke()
{
    bool broke = false;
    Frame frame;
    Frame address;
    while (monitor_.recv(frame, zmq::recv_flags::dontwait))
    {
        static_cast<void>(monitor_.recv(address, zmq::recv_flags::none));
        std::uint16_t event = 0;
        std::memcpy(&event, frame.data(), sizeof(event));
        if (event == ZMQ_EVENT_HANDSHAKE_SUCCEEDED) greeted_ = true;
        if (event == ZMQ_EVENT_HANDSHAKE_FAILED_AUTH) refused_ = role_ == Role::client;
        // A server also sees connections that were only opened and closed: somebody looked whether it is there.
        int const failure = role_ == Role::server ? ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL : failed_handshake;
        if ((event & failure) != 0) note_broken_handshake();
        // Before the handshake it is not a server of ours; ZeroMQ tries again.
        if (event == ZMQ_EVENT_DISCONNECTED) broke = broke || greeted_;
    }
    return broke;
}

void Socket::wait(int descriptor, Time until)
{
    std::array<zmq::pollitem_t, 4> items{{{socket_.handle(), 0, ZMQ_POLLIN, 0},
                                          {monitor_.handle(), 0, ZMQ_POLLIN, 0},
                                          {nullptr, descriptor, ZMQ_POLLIN, 0},
                                          {gatekeeper_ ? gatekeeper_->handle() : nullptr, descriptor, ZMQ_POLLIN, 0}}};
    try
    {
        zmq::poll(items.data(), gatekeeper_ ? 4 : 3, poll_time(until));
        if (gatekeeper_) gatekeeper_->serve();
    }
    catch (zmq::error_t const& error)
    {
        if (error.num() != EINTR) throw;  // stopped and continued
    }
}

void Socket::close(Clock::duration linger) noexcept
{
    auto const milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(linger).count();
    try
    {
        socket_.set(zmq::sockopt::linger, static_cast<int>(milliseconds));
        monitor_.set(zmq::sockopt::linger, 0);
    }
    catch (zmq::error_t const&)
    {
        // The default set at construction, not to linger, stays.
    }
    zmq_socket_monitor(socket_.handle(), nullptr, 0);
    socket_.close();
    monitor_.close();
    gatekeeper_.reset();
    context_.close();
}

}  // namespace gimdem::coupling::transport
