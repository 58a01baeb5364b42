// SPDX-License-Identifier: BSD-3-Clause
/// The addresses that a session may use.
#pragma once

#include <string>

namespace gimdem::coupling::transport
{

/// Who asks for the address: only a server may leave the port open ("*").
enum class Role
{
    client,
    server
};

/// An address that passed the security rule: a local socket file, or a tcp port of this machine.
struct Address
{
    std::string text;  ///< as ZeroMQ wants it
    std::string path;  ///< the socket file; empty for tcp
    bool ipv6 = false;

    bool is_ipc() const { return !path.empty(); }
};

/// Reads "ipc:///path/socket" or "tcp://127.0.0.1:port". Anything that another machine could reach is
/// Fault::endpoint: messages are neither encrypted nor authenticated.
Address parse_address(std::string const& endpoint, Role role);

}  // namespace gimdem::coupling::transport
