// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Socket.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::transport
{
namespace
{

/// Room for a whole step of a small case in the system's buffers, where the system allows it [byte].
int constexpr system_buffer = 4 << 20;

char const* const monitor_address = "inproc://monitor";

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
    socket_.set(zmq::sockopt::sndhwm, 0);
    socket_.set(zmq::sockopt::rcvhwm, 0);
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

Socket Socket::connect(std::string const& endpoint)
{
    Address const address = parse_address(endpoint, Role::client);
    Socket socket(Role::client, address);
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

Socket Socket::bind(std::string const& endpoint)
{
    Address const address = parse_address(endpoint, Role::server);
    Socket socket(Role::server, address);
    try
    {
        socket.socket_.bind(address.text);
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
    if (zmq_socket_monitor(socket_.handle(), monitor_address, ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED) !=
        0)
        throw zmq::error_t();
    monitor_.connect(monitor_address);
}

bool Socket::send(std::string const& receiver, Frames& frames)
{
    try
    {
        if (role_ == Role::server)
            socket_.send(zmq::buffer(receiver), zmq::send_flags::sndmore | zmq::send_flags::dontwait);
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
        // Before the handshake it is not a server of ours; ZeroMQ tries again.
        if (event == ZMQ_EVENT_DISCONNECTED) broke = broke || greeted_;
    }
    return broke;
}

void Socket::wait(int descriptor, Time until)
{
    std::array<zmq::pollitem_t, 3> items{{{socket_.handle(), 0, ZMQ_POLLIN, 0},
                                          {monitor_.handle(), 0, ZMQ_POLLIN, 0},
                                          {nullptr, descriptor, ZMQ_POLLIN, 0}}};
    try
    {
        zmq::poll(items.data(), items.size(), poll_time(until));
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
    context_.close();
}

}  // namespace gimdem::coupling::transport
