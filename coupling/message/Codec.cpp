// SPDX-License-Identifier: BSD-3-Clause
#include "message/Codec.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <google/protobuf/stubs/common.h>
#if GOOGLE_PROTOBUF_VERSION < 4000000
#include <google/protobuf/stubs/logging.h>
#endif

#include "gimdem/coupling/Types.hpp"
#include "message/Arrays.hpp"
#include "message/SharedArrays.hpp"

namespace gimdem::coupling::message
{
namespace
{

/// Patches are the only long list in an envelope; a mebibyte holds thousands of them.
std::size_t constexpr max_envelope_bytes = std::size_t{1} << 20;

/// Reads without the chatter of protobuf: what is wrong, our caller tells in one message.
bool read_quietly(v1::Envelope& envelope, transport::Frame const& frame)
{
#if GOOGLE_PROTOBUF_VERSION < 4000000
    google::protobuf::LogSilencer const silence;
#endif
    return frame.size() <= max_envelope_bytes && envelope.ParseFromArray(frame.data(), static_cast<int>(frame.size()));
}

std::string version_text(unsigned major, unsigned minor)
{
    return std::to_string(major) + "." + std::to_string(minor);
}

void check_version(v1::Envelope const& envelope)
{
    if (envelope.protocol_major() == static_cast<unsigned>(protocol_major)) return;
    std::string const reason = envelope.has_error() ? "; it said: " + envelope.error().reason() : "";
    throw CouplingError(Fault::version, "the peer speaks protocol " +
                                            version_text(envelope.protocol_major(), envelope.protocol_minor()) +
                                            " and this side speaks " + version_text(protocol_major, protocol_minor) +
                                            " (the first number must be the same); update the older side" + reason);
}

void check_array(v1::ArrayHeader const& header, transport::Frame& frame)
{
    auto const who = [&] { return "array \"" + header.name() + "\""; };
    std::size_t const size = element_size(header.type());
    if (size == 0) refuse(who() + " has an unknown element type");
    if (header.components() < 1 || header.components() > max_components)
        refuse(who() + " has " + std::to_string(header.components()) + " components (1 to " +
               std::to_string(max_components) + ")");

    std::size_t const row_bytes = size * header.components();
    bool const fits = header.count() <= transport::max_frame_bytes / row_bytes;
    if (fits && header.compression() != v1::COMPRESSION_NONE && !header.shared())
        return;                                            // its bytes are checked where the number of cells is known
    if (fits && header.shared() && frame.empty()) return;  // its place is checked where the memory is known
    if (!fits || header.shared() || header.count() * row_bytes != frame.size())
        refuse(who() + " has " + std::to_string(frame.size()) + " bytes, but its header promises " +
               std::to_string(header.count()) + " rows of " + std::to_string(row_bytes) +
               " bytes (a truncated or padded frame)");
    align(frame, size);
}

void check_array_of_mesh(v1::ArrayHeader const& header)
{
    std::string const who = "array \"" + header.name() + "\" of a Mesh";
    if (header.shared()) refuse(who + " in shared memory (only fields may lie there)");
    if (!header.dense() || header.compression() != v1::COMPRESSION_NONE)
        refuse(who + " is sparse or compressed (only fields may be)");
}

void check_arrays(Message& message)
{
    auto const& headers = message.envelope.arrays();
    if (static_cast<std::size_t>(headers.size()) != message.arrays.size())
        refuse(describe(message) + " has " + std::to_string(message.arrays.size()) +
               " array frames, but its envelope describes " + std::to_string(headers.size()));

    for (int k = 0; k < headers.size(); ++k)
    {
        check_name(headers[k].name(), "the name of an array");
        auto const is_same = [&](v1::ArrayHeader const& other) { return other.name() == headers[k].name(); };
        if (std::any_of(headers.begin(), headers.begin() + k, is_same))
            refuse("array \"" + headers[k].name() + "\" comes twice");
        if (message.kind() == Kind::kMesh) check_array_of_mesh(headers[k]);
        if (headers[k].shared() && headers[k].compression() != v1::COMPRESSION_NONE)
            refuse("array \"" + headers[k].name() + "\" is compressed and in shared memory (only frames may be)");
        check_array(headers[k], message.arrays[static_cast<std::size_t>(k)]);
    }
}

/// The same limits that the receiver has, so that our own caller hears of them first.
void check_before_sending(Message const& message)
{
    if (message.envelope.ByteSizeLong() > max_envelope_bytes)
        throw CouplingError(Fault::user, describe(message) +
                                             " is too large (an envelope holds 1 MiB); use fewer patches, "
                                             "monitors or shorter names");
    for (int k = 0; k < message.envelope.arrays_size(); ++k)
        if (message.arrays[static_cast<std::size_t>(k)].size() > transport::max_frame_bytes)
            throw CouplingError(Fault::user, "array \"" + message.envelope.arrays(k).name() +
                                                 "\" is too large (a frame holds 4 GiB); use a smaller mesh");
}

bool may_have_arrays(Kind kind)
{
    return kind == Kind::kMesh || kind == Kind::kFluidState || kind == Kind::kSolidState;
}

void read_envelope(transport::Frame const& frame, Message& message)
{
    if (frame.size() > max_envelope_bytes)
        refuse("an envelope of " + std::to_string(frame.size()) + " bytes (too large)");
    if (!read_quietly(message.envelope, frame))
        refuse("an envelope of " + std::to_string(frame.size()) + " bytes that cannot be read");
}

/// Only steps are repeated, and none without end.
void check_iteration(Message const& message)
{
    auto const pass = message.envelope.iteration();
    bool const is_step = message.kind() == Kind::kFluidState || message.kind() == Kind::kSolidState;
    if (pass < 0 || pass > max_pass || (pass > 0 && !is_step))
        refuse(kind_name(message.kind()) + " with iteration " + std::to_string(pass) +
               " (a FluidState or SolidState has 0 to " + std::to_string(max_pass) + ", any other message 0)");
}

/// All that does not depend on the state of the session.
void check(Message& message)
{
    check_version(message.envelope);
    if (message.kind() == Kind::KIND_NOT_SET) refuse("an envelope without a message in it");
    check_iteration(message);
    if (!may_have_arrays(message.kind()) && !message.arrays.empty())
        refuse(kind_name(message.kind()) + " with array frames (it has none)");
    check_arrays(message);
}

}  // namespace

transport::Frame encode_envelope(Message& message)
{
    message.envelope.set_protocol_major(protocol_major);
    message.envelope.set_protocol_minor(protocol_minor);
    check_before_sending(message);
    transport::Frame frame(message.envelope.ByteSizeLong());
    message.envelope.SerializeToArray(frame.data(), static_cast<int>(frame.size()));
    return frame;
}

transport::Frames encode(Message message)
{
    transport::Frames frames;
    frames.reserve(1 + message.arrays.size());
    frames.push_back(encode_envelope(message));
    for (std::size_t k = 0; k < message.arrays.size(); ++k)
    {
        bool const shared = message.envelope.arrays(static_cast<int>(k)).shared();
        frames.push_back(shared ? transport::Frame() : std::move(message.arrays[k]));
    }
    return frames;
}

Kind peek_kind(transport::Frame const& envelope)
{
    v1::Envelope read;
    return read_quietly(read, envelope) ? read.kind_case() : Kind::KIND_NOT_SET;
}

Message decode(transport::Frames frames)
{
    if (frames.empty()) refuse("a message without an envelope");
    if (frames.size() > transport::max_frames)
        refuse("a message of more than " + std::to_string(transport::max_frames) + " frames");

    Message message;
    read_envelope(frames.front(), message);
    for (std::size_t k = 1; k < frames.size(); ++k)
        message.arrays.push_back(std::move(frames[k]));
    check(message);
    return message;
}

Message decode_posted(transport::Frame const& envelope)
{
    Message message;
    read_envelope(envelope, message);
    check_version(message.envelope);
    if (!may_be_posted(message))
        refuse(describe(message) + " in a mailbox (only fields in shared memory may be there)");
    auto const count = static_cast<std::size_t>(message.envelope.arrays_size());
    if (count >= transport::max_frames)
        refuse("a message of more than " + std::to_string(transport::max_frames) + " frames");
    message.arrays.resize(count);
    check(message);
    return message;
}

}  // namespace gimdem::coupling::message
