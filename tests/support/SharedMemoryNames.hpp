// SPDX-License-Identifier: BSD-3-Clause
/// Which shared memory segments of a process still have a name.
#pragma once

#include <unistd.h>
#include <filesystem>
#include <string>
#include <vector>

namespace gimdem::test
{

/// Linux shows the names of POSIX shared memory in this folder.
inline std::filesystem::path const shared_memory_folder = "/dev/shm";

/// The names that a process has left; empty if it left none.
inline std::vector<std::string> shared_memory_names(pid_t process = ::getpid())
{
    std::string const prefix = "gimdem-" + std::to_string(process) + "-";
    std::vector<std::string> names;
    for (auto const& file : std::filesystem::directory_iterator(shared_memory_folder))
    {
        std::string const name = file.path().filename();
        if (name.rfind(prefix, 0) == 0) names.push_back(name);
    }
    return names;
}

}  // namespace gimdem::test
