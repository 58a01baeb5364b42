// SPDX-License-Identifier: BSD-3-Clause
/// Addresses that no other test uses.
#pragma once

#include <unistd.h>
#include <atomic>
#include <filesystem>
#include <string>

namespace gimdem::test
{

/// "ipc://" of a socket file in the folder for temporary files.
inline std::string unused_ipc_endpoint()
{
    static std::atomic<int> count{0};
    auto const file = "gimdem-test-" + std::to_string(::getpid()) + "-" + std::to_string(++count) + ".socket";
    return "ipc://" + (std::filesystem::temp_directory_path() / file).string();
}

/// A tcp endpoint that takes any free port.
inline std::string any_tcp_endpoint()
{
    return "tcp://127.0.0.1:*";
}

/// The socket file of an ipc endpoint.
inline std::string file_of(std::string const& endpoint)
{
    return endpoint.substr(std::string("ipc://").size());
}

}  // namespace gimdem::test
