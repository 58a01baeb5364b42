// SPDX-License-Identifier: BSD-3-Clause
/// The parts of one message on the wire.
#pragma once

#include <unistd.h>
#include <cstddef>
#include <vector>

#include <zmq.hpp>

namespace gimdem::coupling::transport
{

/// Bytes that ZeroMQ owns: filled once, then moved, never copied.
using Frame = zmq::message_t;
using Frames = std::vector<Frame>;

/// The largest frame that is sent or accepted [byte].
inline constexpr std::size_t max_frame_bytes = std::size_t{4} << 30;
/// The most frames in one message.
inline constexpr std::size_t max_frames = 32;

/// What a mesh may take at most: half of the machine's memory [byte].
inline std::size_t half_of_memory()
{
    return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 2 * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

inline std::size_t byte_count(Frames const& frames)
{
    std::size_t sum = 0;
    for (Frame const& frame : frames)
        sum += frame.size();
    return sum;
}

}  // namespace gimdem::coupling::transport
