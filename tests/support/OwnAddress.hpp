// SPDX-License-Identifier: BSD-3-Clause
/// An address of this machine that other machines could use.
#pragma once

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <array>
#include <string>

namespace gimdem::test
{

/// The first IPv4 address that is not of the loopback; 127.0.0.1 where the machine has no network.
inline std::string own_address()
{
    std::string result = "127.0.0.1";
    ifaddrs* first = nullptr;
    if (::getifaddrs(&first) != 0) return result;
    for (ifaddrs const* each = first; each; each = each->ifa_next)
    {
        bool const usable = each->ifa_addr && each->ifa_addr->sa_family == AF_INET && (each->ifa_flags & IFF_UP) != 0 &&
                            (each->ifa_flags & IFF_LOOPBACK) == 0;
        std::array<char, INET_ADDRSTRLEN> text{};
        if (!usable) continue;
        auto const* const address = reinterpret_cast<sockaddr_in const*>(each->ifa_addr);
        if (::inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size())) result = text.data();
    }
    ::freeifaddrs(first);
    return result;
}

}  // namespace gimdem::test
