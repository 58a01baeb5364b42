// SPDX-License-Identifier: BSD-3-Clause
/// The real server and clients with keys, at an address that other machines could use.
#include <gtest/gtest.h>

#include <filesystem>

#include "KeyFolder.hpp"
#include "OwnAddress.hpp"
#include "ServerProcess.hpp"

namespace gimdem::test
{
namespace
{

SmallCase keyed_case(KeyFolder const& keys)
{
    SmallCase settings;
    settings.coupling = "keys = \"" + keys.path().string() + "\"\n";
    return settings;
}

TEST(Security, LetsAClientWithAKnownKeyInAndTurnsOthersAway)
{
    KeyFolder const keys;
    KeyFolder const others;
    std::filesystem::copy_file(keys / "server.public", others / "server.public",
                               std::filesystem::copy_options::overwrite_existing);
    TemporaryFolder const folder;
    ServerProcess server("tcp://" + own_address() + ":*", keyed_case(keys));

    Process stranger({GIMDEM_SCRIPTED_CLIENT, server.endpoint(), "40", "5", others.path()}, folder / "stranger.txt");
    EXPECT_EQ(stranger.wait(soon), 1) << stranger.output();
    EXPECT_THAT(stranger.output(), testing::HasSubstr("has turned us away"));

    Process client({GIMDEM_SCRIPTED_CLIENT, server.endpoint(), "40", "5", keys.path()}, folder / "client.txt");
    EXPECT_EQ(client.wait(soon), 0) << client.output();
    server.expect_end(0, "turned away a client at " + own_address() + " with the unknown key ");
}

TEST(Security, RefusesToBindOtherAddressesWithoutKeys)
{
    ServerProcess server("tcp://0.0.0.0:5570");
    EXPECT_EQ(server.process().wait(soon), 1);
    EXPECT_THAT(server.process().output(), testing::HasSubstr("make keys with ./gimdem keys"));
}

TEST(Security, RefusesKeysThatOthersCanRead)
{
    KeyFolder const keys;
    std::filesystem::permissions(keys / "server.secret", std::filesystem::perms::others_read,
                                 std::filesystem::perm_options::add);
    ServerProcess server(any_tcp_endpoint(), keyed_case(keys));
    EXPECT_EQ(server.process().wait(soon), 1);
    EXPECT_THAT(server.process().output(), testing::HasSubstr("can be read by other users"));
}

}  // namespace
}  // namespace gimdem::test
