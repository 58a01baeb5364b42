// SPDX-License-Identifier: BSD-3-Clause
/// What the system tells of a process.
#pragma once

#include <unistd.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace gimdem::test
{

/// Memory that is the process's own: without what it shares with others [byte].
inline double own_memory(pid_t process = ::getpid())
{
    std::ifstream file("/proc/" + std::to_string(process) + "/statm");
    double size = 0, resident = 0, shared = 0;
    file >> size >> resident >> shared;
    return (resident - shared) * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

inline double file_descriptors(pid_t process = ::getpid())
{
    std::error_code gone;
    std::filesystem::directory_iterator const files("/proc/" + std::to_string(process) + "/fd", gone);
    return gone ? 0 : static_cast<double>(std::distance(files, {}));
}

}  // namespace gimdem::test
