// SPDX-License-Identifier: BSD-3-Clause
/// Checks of what a program passes to Client and Server.
#pragma once

#include <cmath>
#include <string>

#include "message/Greeting.hpp"
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

inline void require_rank(Rank const& rank)
{
    if (auto const fault = message::find_rank_fault(rank))
        throw CouplingError(Fault::user, "ClientOptions.rank: " + *fault + "; check the call");
}

/// How a rank calls itself: "solver, rank 1 of 2".
inline std::string name_of_rank(std::string const& name, Rank const& rank)
{
    if (rank.count == 1) return name;
    return name + ", rank " + std::to_string(rank.number) + " of " + std::to_string(rank.count);
}

}  // namespace gimdem::coupling::session
