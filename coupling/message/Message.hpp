// SPDX-License-Identifier: BSD-3-Clause
/// A message between pack and send, or between receive and unpack.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gimdem/coupling/CellRuns.hpp"
#include "gimdem/coupling/Error.hpp"
#include "gimdem/coupling/Span.hpp"
#include "gimdem/v1/session.pb.h"
#include "transport/Frames.hpp"

namespace gimdem::coupling::message
{

using Kind = v1::Envelope::KindCase;

/// Numbers that are still to be copied into their frame.
struct Unfilled
{
    std::size_t array;                             ///< position among the arrays
    Span<double const> values;                     ///< of all cells
    bool is_shared;                                ///< the frame lies in memory that the peer reads
    std::optional<CellRuns> cells = std::nullopt;  ///< the cells whose rows travel; absent: all
    bool compress = false;                         ///< the frame is to be compressed
};

/// The envelope, and the frames of the arrays that it describes.
struct Message
{
    v1::Envelope envelope;
    transport::Frames arrays;
    std::vector<Unfilled> unfilled;  ///< until fill()
    /// Of so many arrays at the front, what became of them while the rest was packed: they have neither NaN nor
    /// infinity, and those that are not used in place lie in a FieldStore.
    std::vector<Span<double const>> taken_in = {};

    Kind kind() const { return envelope.kind_case(); }
};

/// "Hello", "FluidState", ... as docs/protocol.md writes it.
std::string kind_name(Kind kind);

/// kind_name, with the step where the message belongs to one: "FluidState of step 3".
std::string describe(Message const& message);

/// Text that protobuf accepts: invalid UTF-8 becomes '?', and what is beyond max_text_bytes is cut.
std::string printable(std::string const& text);

inline constexpr std::size_t max_text_bytes = 8192;  ///< of a reason
inline constexpr std::size_t max_name_bytes = 256;   ///< of a name
inline constexpr int max_pass = 10000;               ///< of a step that is repeated
inline constexpr double min_timeout = 0.1;           ///< a peer needs this much to show that it lives [s]

/// A number as people write it: "0.5", "1e-300", "nan".
std::string number_text(double value);

/// What a peer sent cannot be used: Fault::protocol.
[[noreturn]] void refuse(std::string const& problem);

/// A name off the wire must not be empty or unreasonably long.
void check_name(std::string const& name, char const* whose);
/// A number off the wire must be finite, and at least so much.
void check_number(double value, double least, char const* whose);

}  // namespace gimdem::coupling::message
