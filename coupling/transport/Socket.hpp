// SPDX-License-Identifier: BSD-3-Clause
/// One ZeroMQ socket of a session: DEALER on the client, ROUTER on the server.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "transport/Address.hpp"
#include "transport/Clock.hpp"
#include "transport/Frames.hpp"
#include "transport/IpcPath.hpp"

namespace gimdem::coupling::transport
{

/// Frames and who sent them.
struct Parcel
{
    std::string sender;  ///< routing id; empty on the client, which knows only its server
    Frames frames;
};

/// Hides routing ids and the connection monitor. Not thread-safe: the I/O thread owns it.
class Socket
{
public:
    /// Connects in the background, again and again until a server appears.
    static Socket connect(std::string const& endpoint);
    /// Binds at once, or Fault::endpoint.
    static Socket bind(std::string const& endpoint);

    Socket(Socket&&) = default;
    Socket& operator=(Socket&&) = delete;
    ~Socket();

    /// The address, with the port that the system chose.
    std::string const& endpoint() const { return endpoint_; }
    Role role() const { return role_; }

    /// Never blocks. False: there is no connection to that receiver any more.
    bool send(std::string const& receiver, Frames& frames);
    /// Never blocks. Empty: nothing has arrived.
    std::optional<Parcel> receive();
    /// Has a connection broken since the last call? On a server, any connection of any client.
    bool connection_broke();

    /// Sleeps until something arrives, the descriptor becomes readable, or it is that time.
    void wait(int descriptor, Time until);

    /// Gives unsent bytes that long to leave.
    void close(Clock::duration linger) noexcept;

private:
    Socket(Role role, Address const& address);
    void watch_connections();

    Role role_;
    bool greeted_ = false;  ///< ZeroMQ's own handshake has succeeded once
    std::string endpoint_;
    std::unique_ptr<IpcPath> path_;  ///< server over ipc: outlives the sockets
    zmq::context_t context_;
    zmq::socket_t socket_;
    zmq::socket_t monitor_;
};

}  // namespace gimdem::coupling::transport
