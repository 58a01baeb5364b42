// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Address.hpp"

#include <sys/un.h>
#include <algorithm>
#include <cctype>

#include "gimdem/coupling/Error.hpp"

namespace gimdem::coupling::transport
{
namespace
{

[[noreturn]] void refuse(std::string const& endpoint, std::string const& why)
{
    throw CouplingError(Fault::endpoint, "endpoint \"" + endpoint + "\" " + why);
}

bool starts_with(std::string const& text, std::string const& start)
{
    return text.rfind(start, 0) == 0;
}

bool is_port(std::string const& text)
{
    bool const digits = !text.empty() && text.size() <= 5 &&
                        std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    return digits && std::stoi(text) >= 1 && std::stoi(text) <= 65535;
}

/// 127.a.b.c with three numbers from 0 to 255.
bool is_loopback_v4(std::string const& host)
{
    int dots = 0;
    std::string number;
    for (char const c : host + ".")
    {
        if (c != '.' && std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
        if (c != '.')
        {
            number += c;
            continue;
        }
        if (number.empty() || number.size() > 3 || std::stoi(number) > 255) return false;
        number.clear();
        ++dots;
    }
    return dots == 4 && starts_with(host, "127.");
}

Address parse_ipc(std::string const& endpoint)
{
    std::string const path = endpoint.substr(std::string("ipc://").size());
    if (path.empty() || path.front() == '*')
        refuse(endpoint, "names no file (client and server must agree on one); write ipc:///path/of/socket");
    std::size_t constexpr longest = sizeof(sockaddr_un::sun_path) - 1;
    if (path.size() > longest)
        refuse(endpoint, "is too long (the system allows " + std::to_string(longest) +
                             " characters for a socket file); choose a shorter path, for example below /tmp");
    return {endpoint, path, false};
}

/// A name or number of a host as users write it, "[...]" for IPv6; "*" is every address of the machine.
bool is_host(std::string const& text, Role role)
{
    if (text == "*") return role == Role::server;
    bool const ipv6 = text.size() > 2 && text.front() == '[' && text.back() == ']';
    std::string const inner = ipv6 ? text.substr(1, text.size() - 2) : text;
    return !inner.empty() && std::all_of(inner.begin(), inner.end(),
                                         [&](unsigned char c) {
                                             return std::isalnum(c) != 0 || c == '.' || c == '-' || (ipv6 && c == ':');
                                         });
}

void check_host(std::string const& endpoint, std::string const& host, Role role, Protection protection)
{
    if (host == "[::1]" || is_loopback_v4(host)) return;
    if (protection == Protection::none)
        refuse(endpoint,
               "is not on this machine (only ipc:// and the loopback addresses 127.x.x.x, localhost and [::1] are "
               "allowed without keys: other machines could read and forge messages); use ipc:// or tcp://127.0.0.1, "
               "or make keys with ./gimdem keys DIR and give both sides theirs, see docs/security.md");
    if (!is_host(host, role)) refuse(endpoint, "has no valid host; write tcp://host:port");
}

Address parse_tcp(std::string const& endpoint, Role role, Protection protection)
{
    std::string const rest = endpoint.substr(std::string("tcp://").size());
    std::size_t const colon = rest.rfind(':');
    if (colon == std::string::npos) refuse(endpoint, "has no port; write tcp://127.0.0.1:port");
    std::string host = rest.substr(0, colon);
    std::string const port = rest.substr(colon + 1);

    if (host == "localhost") host = "127.0.0.1";
    check_host(endpoint, host, role, protection);
    if (!is_port(port) && !(port == "*" && role == Role::server))
        refuse(endpoint, "has no valid port (a number from 1 to 65535" +
                             std::string(role == Role::server ? ", or * for any free one" : "") +
                             "); write tcp://127.0.0.1:port");
    return {"tcp://" + host + ":" + port, "", host.front() == '['};
}

}  // namespace

Address parse_address(std::string const& endpoint, Role role, Protection protection)
{
    if (starts_with(endpoint, "ipc://")) return parse_ipc(endpoint);
    if (starts_with(endpoint, "tcp://")) return parse_tcp(endpoint, role, protection);
    refuse(endpoint, "has an unknown transport; write ipc:///path/of/socket or tcp://127.0.0.1:port");
}

}  // namespace gimdem::coupling::transport
