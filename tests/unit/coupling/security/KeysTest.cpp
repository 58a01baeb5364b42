// SPDX-License-Identifier: BSD-3-Clause
#include "gimdem/coupling/Keys.hpp"

#include <sys/stat.h>
#include <fstream>
#include <string>

#include "Faults.hpp"
#include "KeyFolder.hpp"
#include "transport/Keys.hpp"

namespace gimdem::coupling::transport
{
namespace
{

namespace fs = std::filesystem;
using test::KeyFolder;

unsigned mode_of(fs::path const& file)
{
    struct stat status = {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status.st_mode & 0777u;
}

TEST(Keys, AreFilesThatOnlyTheirOwnerReads)
{
    KeyFolder const keys;

    for (char const* file : {"server.secret", "server.public", "client.secret", "clients/client.public"})
        EXPECT_EQ(mode_of(keys / file), 0600u) << file;
    EXPECT_EQ(mode_of(keys.path()), 0700u);
}

TEST(Keys, OfTheTwoSidesFitTogether)
{
    KeyFolder const keys;

    ServerKeys const server = read_server_keys(keys.path());
    ClientKeys const client = read_client_keys(keys.path());
    EXPECT_EQ(client.server, server.own.public_key);
    EXPECT_EQ(server.clients, std::vector<std::string>{client.own.public_key});
    EXPECT_NE(server.own.secret_key, client.own.secret_key);
}

TEST(Keys, AreNeverOverwritten)
{
    KeyFolder const keys;
    std::string const before = read_server_keys(keys.path()).own.secret_key;

    EXPECT_FAULT(make_keys(keys.path()), Fault::user, "holds keys already");
    EXPECT_EQ(read_server_keys(keys.path()).own.secret_key, before);
    for (char const* file : {"server.secret", "server.public", "client.secret"})
        fs::remove(keys / file);
    EXPECT_FAULT(make_keys(keys.path()), Fault::user, "holds keys already (clients;");
}

TEST(Keys, OfClientsAreTheFilesCalledPublic)
{
    KeyFolder const keys;
    std::ofstream(keys / "clients/README") << "whom we trust, and since when";
    EXPECT_EQ(read_server_keys(keys.path()).clients.size(), 1u);
}

TEST(Keys, ThatOthersReadAreRefused)
{
    KeyFolder const keys;
    for (fs::perms const others : {fs::perms::group_read, fs::perms::others_read, fs::perms::others_exec})
    {
        fs::permissions(keys / "server.secret", fs::perms::owner_read | fs::perms::owner_write | others);
        EXPECT_FAULT(read_server_keys(keys.path()), Fault::user, "can be read by other users");
        EXPECT_FAULT(read_server_keys(keys.path()), Fault::user, "chmod 600 ");
    }
    read_client_keys(keys.path());  // its own files are as they should be
}

TEST(Keys, OfThoseWeTrustThatOthersWriteAreRefused)
{
    KeyFolder const keys;
    auto const owner_only = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions(keys / "server.public", owner_only | fs::perms::group_read | fs::perms::others_read);
    read_client_keys(keys.path());  // a public key may be read
    fs::permissions(keys / "server.public", owner_only | fs::perms::others_write);
    EXPECT_FAULT(read_client_keys(keys.path()), Fault::user, "can be written by other users");
    fs::permissions(keys / "server.public", owner_only | fs::perms::group_write);
    EXPECT_FAULT(read_client_keys(keys.path()), Fault::user, "can be written by other users");
    fs::permissions(keys / "clients", fs::perms::all);
    EXPECT_FAULT(read_server_keys(keys.path()), Fault::user, "can be written by other users");
}

TEST(Keys, ThatAreNoneAreRefused)
{
    KeyFolder const keys;
    KeyFolder const others;
    fs::remove(keys / "clients/client.public");
    EXPECT_FAULT(read_server_keys(keys.path()), Fault::user, "holds no client's key");

    std::string const text = "public = \"" + read_client_keys(keys.path()).own.public_key + "\"\nsecret = \"" +
                             read_client_keys(others.path()).own.secret_key + "\"\n";
    std::ofstream(keys / "client.secret") << "# a pair that is none\n" << text;
    EXPECT_FAULT(read_client_keys(keys.path()), Fault::user, "does not belong to its secret key");

    std::ofstream(keys / "client.secret") << text.substr(0, 40);
    EXPECT_FAULT(read_client_keys(keys.path()), Fault::user, "has no line public = ");
    fs::remove(keys / "client.secret");
    EXPECT_FAULT(read_client_keys(keys.path()), Fault::user, "cannot be opened");
}

}  // namespace
}  // namespace gimdem::coupling::transport
