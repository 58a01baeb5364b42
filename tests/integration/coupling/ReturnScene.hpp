// SPDX-License-Identifier: BSD-3-Clause
/// What runs have in common whose client is lost and comes back.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "ServerProcess.hpp"

namespace gimdem::test
{

inline double constexpr return_dt = 1e-4;  ///< coupling step [s]
inline int constexpr return_steps = 60;    ///< of the whole run

inline std::string bytes_of(std::filesystem::path const& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A server that waits so long [s] for a lost client.
inline SmallCase with_grace(std::string const& seconds, double timeout = patient)
{
    SmallCase settings;
    settings.timeout = timeout;
    settings.more = "sample_interval = 5e-4\n";
    settings.arguments = {"--grace-time", seconds};
    return settings;
}

}  // namespace gimdem::test
