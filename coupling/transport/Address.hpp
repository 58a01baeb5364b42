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

/// An address that passed the security rule: a local socket file, or a tcp port of this machine; with keys any port.
struct Address
{
    std::string text;  ///< as ZeroMQ wants it
    std::string path;  ///< the socket file; empty for tcp
    bool ipv6 = false;

    bool is_ipc() const { return !path.empty(); }
};

/// Whether the two sides know each other by keys, and encrypt what they say.
enum class Protection
{
    none,
    keys
};

/// Reads "ipc:///path/socket" or "tcp://127.0.0.1:port". Anything that another machine could reach is
/// Fault::endpoint, unless keys protect it.
Address parse_address(std::string const& endpoint, Role role, Protection protection = Protection::none);

}  // namespace gimdem::coupling::transport
