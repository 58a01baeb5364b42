// SPDX-License-Identifier: BSD-3-Clause
/// Hello and Welcome.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gimdem/coupling/Client.hpp"
#include "gimdem/coupling/Types.hpp"
#include "message/Message.hpp"

namespace gimdem::coupling::message
{

struct Hello
{
    std::string name;
    FluidProperties fluid = {};
    std::vector<std::string> wants = {};
    std::optional<Schedule> schedule;
    double timeout = 0;  ///< of the client [s]
    std::optional<ResumePoint> resume = {};
    bool iterates = false;
    Rank rank = {};
    Encodings encodings = {};  ///< that the client can use
};

/// What cannot be true of a rank, in words.
std::optional<std::string> find_rank_fault(Rank const& rank);

Message pack(Hello const& hello);
Message pack(Welcome const& welcome);

/// Fault::protocol if anything in it is missing, not finite, or unknown.
Hello unpack_hello(Message const& message);
Welcome unpack_welcome(Message const& message);

}  // namespace gimdem::coupling::message
