// SPDX-License-Identifier: BSD-3-Clause
/// Checks of what a program passes to Client and Server.
#pragma once

#include <cmath>
#include <string>

#include "message/Message.hpp"

namespace gimdem::coupling::session
{

inline void require_name(std::string const& name, char const* option)
{
    if (name.empty() || name.size() > message::max_name_bytes)
        throw CouplingError(Fault::user, std::string(option) +
                                             " is empty or too long (the peer's messages show it); "
                                             "give the program's name and version");
}

/// seconds must be a number, and at least so much [s].
inline void require_seconds(double seconds, double least, char const* option)
{
    if (std::isnan(seconds) || seconds < least)
        throw CouplingError(Fault::user, std::string(option) + " is " + message::number_text(seconds) +
                                             " s (at least " + message::number_text(least) +
                                             " s); choose a longer time");
}

}  // namespace gimdem::coupling::session
