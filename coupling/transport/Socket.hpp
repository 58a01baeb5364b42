// SPDX-License-Identifier: BSD-3-Clause
/// One ZeroMQ socket of a session: DEALER on the client, ROUTER on the server.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transport/Address.hpp"
#include "transport/Clock.hpp"
#include "transport/Frames.hpp"
#include "transport/Gatekeeper.hpp"
#include "transport/IpcPath.hpp"
#include "transport/Keys.hpp"

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
    static Socket connect(std::string const& endpoint, std::optional<ClientKeys> const& keys = std::nullopt);
    /// Binds at once, or Fault::endpoint.
    static Socket bind(std::string const& endpoint, std::optional<ServerKeys> const& keys = std::nullopt);

    Socket(Socket&&) = default;
    Socket& operator=(Socket&&) = delete;
    ~Socket();

    /// The address, with the port that the system chose.
    std::string const& endpoint() const { return endpoint_; }
    Role role() const { return role_; }

    /// Never blocks. False: there is no connection to that receiver any more, or it reads nothing.
    bool send(std::string const& receiver, Frames& frames);
    /// Never blocks. Empty: nothing has arrived.
    std::optional<Parcel> receive();
    /// Has a connection broken since the last call? On a server, any connection of any client.
    bool connection_broke();
    /// Client: the server is there and does not let our key in.
    bool was_refused() const { return refused_; }
    /// What the owner may like to tell its user since the last call: who was turned away, or why nothing comes.
    std::vector<std::string> take_notes();

    /// Sleeps until something arrives, the descriptor becomes readable, or it is that time.
    void wait(int descriptor, Time until);

    /// Gives unsent bytes that long to leave.
    void close(Clock::duration linger) noexcept;

private:
    Socket(Role role, Address const& address);
    void watch_connections();
    void protect(ClientKeys const& keys);
    void protect(ServerKeys const& keys);
    void note_broken_handshake();

    Role role_;
    bool greeted_ = false;  ///< ZeroMQ's own handshake has succeeded once
    bool refused_ = false;
    std::string note_;  ///< client: why nothing comes
    std::string endpoint_;
    std::unique_ptr<IpcPath> path_;  ///< server over ipc: outlives the sockets
    zmq::context_t context_;
    zmq::socket_t socket_;
    zmq::socket_t monitor_;
    std::unique_ptr<Gatekeeper> gatekeeper_;  ///< server with keys
};

}  // namespace gimdem::coupling::transport
