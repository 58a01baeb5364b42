// SPDX-License-Identifier: BSD-3-Clause
#include "transport/Address.hpp"

#include <gtest/gtest.h>

#include <string>

#include "Faults.hpp"

namespace gimdem::coupling::transport
{
namespace
{

TEST(Address, OfThisMachineIsAllowed)
{
    EXPECT_EQ(parse_address("ipc:///tmp/a.socket", Role::client).path, "/tmp/a.socket");
    EXPECT_EQ(parse_address("ipc://relative.socket", Role::server).path, "relative.socket");
    EXPECT_EQ(parse_address("tcp://127.0.0.1:5555", Role::client).text, "tcp://127.0.0.1:5555");
    EXPECT_EQ(parse_address("tcp://127.20.30.40:1", Role::server).text, "tcp://127.20.30.40:1");
    EXPECT_EQ(parse_address("tcp://localhost:65535", Role::client).text, "tcp://127.0.0.1:65535");
    EXPECT_TRUE(parse_address("tcp://[::1]:5555", Role::client).ipv6);
    EXPECT_FALSE(parse_address("tcp://127.0.0.1:*", Role::server).is_ipc());
}

TEST(Address, ThatOthersCouldReachIsRefusedForWantOfKeys)
{
    for (char const* endpoint : {"tcp://0.0.0.0:5555", "tcp://*:5555", "tcp://192.168.1.2:5555", "tcp://eth0:5555",
                                 "tcp://example.org:5555", "tcp://[::]:5555", "tcp://128.0.0.1:5555",
                                 "tcp://127.0.0.1.example.org:5555", "tcp://127.0.0:5555", "tcp://127.0.0.256:5555"})
    {
        EXPECT_FAULT(parse_address(endpoint, Role::server), Fault::endpoint, "allowed without keys");
        EXPECT_FAULT(parse_address(endpoint, Role::client), Fault::endpoint, endpoint);
    }
}

TEST(Address, OfAnyMachineIsAllowedWithKeys)
{
    EXPECT_EQ(parse_address("tcp://192.168.1.2:5555", Role::client, Protection::keys).text, "tcp://192.168.1.2:5555");
    EXPECT_EQ(parse_address("tcp://example.org:5555", Role::client, Protection::keys).text, "tcp://example.org:5555");
    EXPECT_EQ(parse_address("tcp://*:5555", Role::server, Protection::keys).text, "tcp://*:5555");
    EXPECT_TRUE(parse_address("tcp://[fd00::2]:5555", Role::client, Protection::keys).ipv6);
    for (char const* endpoint :
         {"tcp://*:5555", "tcp://:5555", "tcp://a b:5555", "tcp://eth0;x:5555", "tcp://a/b:5555"})
        EXPECT_FAULT(parse_address(endpoint, Role::client, Protection::keys), Fault::endpoint, "valid host");
}

TEST(Address, ThatMakesNoSenseIsRefusedWithAHint)
{
    struct Case
    {
        std::string endpoint;
        std::string hint;
    };
    for (auto const& [endpoint, hint] :
         {Case{"", "unknown transport"}, Case{"udp://127.0.0.1:5555", "unknown transport"},
          Case{"ipc://", "names no file"}, Case{"ipc://*", "names no file"},
          Case{"ipc://" + std::string(200, 'x'), "too long"}, Case{"tcp://127.0.0.1", "has no port"},
          Case{"tcp://127.0.0.1:", "valid port"}, Case{"tcp://127.0.0.1:0", "valid port"},
          Case{"tcp://127.0.0.1:65536", "valid port"}, Case{"tcp://127.0.0.1:55x5", "valid port"}})
        EXPECT_FAULT(parse_address(endpoint, Role::server), Fault::endpoint, hint);
    EXPECT_FAULT(parse_address("tcp://127.0.0.1:*", Role::client), Fault::endpoint, "valid port");
}

}  // namespace
}  // namespace gimdem::coupling::transport
