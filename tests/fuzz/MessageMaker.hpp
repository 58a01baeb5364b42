// SPDX-License-Identifier: BSD-3-Clause
/// Messages that are nearly right: what the input says nothing about is as docs/protocol.md wants it.
#pragma once

#include <cstdint>
#include <optional>

#include "Bytes.hpp"
#include "RawPeer.hpp"
#include "message/Message.hpp"

namespace gimdem::fuzz
{

/// What a right message would tell.
struct Truth
{
    std::uint64_t session = 1;
    std::int64_t step = 1;   ///< the one that is due
    double time = 0;         ///< of that step [s]
    double dt = 1e-3;        ///< [s]
    std::int32_t cells = 2;  ///< of the mesh
};

/// A message of that kind (`Envelope`'s field number of it, 0: none), with the mistakes that the input asks for.
test::RawMessage make_message(unsigned kind, Truth const& truth, Bytes& input);

/// Any kind, any mistake.
test::RawMessage make_message(Truth const& truth, Bytes& input);

/// As it arrives: the frames, some of them cut, doubled, left out or made longer if the input asks for it.
coupling::transport::Frames frames_of(test::RawMessage const& message, Bytes& input);

}  // namespace gimdem::fuzz
