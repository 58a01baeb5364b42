// SPDX-License-Identifier: BSD-3-Clause
/// LZ4 of shuffled bytes: neighbouring cells have alike exponents, so like bytes side by side repeat.
#pragma once

#include <cstddef>
#include <vector>

#include "message/Message.hpp"
#include "transport/Frames.hpp"

namespace gimdem::coupling::message
{

/// The first bytes of all numbers, then all second bytes, ...: `size` bytes each. from and to: count * size bytes.
void shuffle_bytes(unsigned char const* from, std::size_t count, std::size_t size, unsigned char* to);
void unshuffle_bytes(unsigned char const* from, std::size_t count, std::size_t size, unsigned char* to);

/// The compressed bytes of a frame of numbers of so many bytes each; an empty frame if they would not be fewer.
transport::Frame compress(transport::Frame const& numbers, std::size_t number_bytes);

/// The bytes that the header promises, and never more. Fault::protocol if the frame does not hold exactly them.
void decompress(v1::ArrayHeader const& header, transport::Frame const& frame, std::vector<unsigned char>& to);

}  // namespace gimdem::coupling::message
