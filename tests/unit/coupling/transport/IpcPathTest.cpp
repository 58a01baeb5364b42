// SPDX-License-Identifier: BSD-3-Clause
#include "transport/IpcPath.hpp"

#include <gtest/gtest.h>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>

#include "Endpoint.hpp"
#include "Faults.hpp"

namespace gimdem::coupling::transport
{
namespace
{

std::string unused_path()
{
    return test::file_of(test::unused_ipc_endpoint());
}

/// Binds a plain socket there, as a program that knows nothing of our lock would.
int bind_plain_socket(std::string const& path)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof(address.sun_path) - 1);
    int const socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    EXPECT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(::listen(socket, 1), 0);
    return socket;
}

TEST(IpcPath, BelongsToOneHolderAtATime)
{
    auto const path = unused_path();
    {
        IpcPath const first(path);
        EXPECT_FAULT(IpcPath(path), Fault::endpoint, "is in use");
    }
    EXPECT_NO_THROW(IpcPath{path});
}

TEST(IpcPath, LeavesNoFile)
{
    auto const path = unused_path();
    {
        IpcPath const holder(path);
        std::ofstream(path) << "stands for the socket";
        EXPECT_TRUE(std::filesystem::exists(path + ".lock"));
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_FALSE(std::filesystem::exists(path + ".lock"));
}

TEST(IpcPath, OfADeadServerIsTakenOver)
{
    auto const path = unused_path();
    ::close(bind_plain_socket(path));
    std::ofstream(path + ".lock") << "";
    ASSERT_TRUE(std::filesystem::exists(path));

    EXPECT_NO_THROW(IpcPath{path});
}

TEST(IpcPath, OfALiveSocketWithoutALockIsRefused)
{
    auto const path = unused_path();
    int const live = bind_plain_socket(path);

    EXPECT_FAULT(IpcPath(path), Fault::endpoint, "is in use");
    EXPECT_TRUE(std::filesystem::exists(path)) << "a live server's socket was removed";
    EXPECT_FALSE(std::filesystem::exists(path + ".lock"));
    ::close(live);
    ::unlink(path.c_str());
}

TEST(IpcPath, DoesNotTouchAFileThatIsNoSocket)
{
    auto const path = unused_path();
    std::ofstream(path) << "precious";

    EXPECT_FAULT(IpcPath(path), Fault::endpoint, "not a socket");
    EXPECT_EQ(std::filesystem::file_size(path), 8u);
    std::filesystem::remove(path);
}

TEST(IpcPath, NeedsAFolder)
{
    EXPECT_FAULT(IpcPath("/no/such/folder/socket"), Fault::endpoint, "a folder that exists and is writable");
}

}  // namespace
}  // namespace gimdem::coupling::transport
