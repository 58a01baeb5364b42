// SPDX-License-Identifier: BSD-3-Clause
#include "message/Message.hpp"

#include <cmath>
#include <cstdio>

namespace gimdem::coupling::message
{
namespace
{

/// Length of the valid UTF-8 sequence that starts at i, or 0.
std::size_t utf8_length(std::string const& text, std::size_t i)
{
    auto const byte = [&text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    unsigned char const lead = byte(i);
    if (lead < 0x80) return 1;
    std::size_t const length = lead >= 0xC2 && lead < 0xE0   ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || i + length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(i + k) & 0xC0) != 0x80) return 0;
    // Overlong forms, surrogates, and what lies beyond the last code point.
    unsigned char const second = byte(i + 1);
    bool const valid = !(lead == 0xE0 && second < 0xA0) && !(lead == 0xED && second > 0x9F) &&
                       !(lead == 0xF0 && second < 0x90) && !(lead == 0xF4 && second > 0x8F);
    return valid ? length : 0;
}

}  // namespace

std::string kind_name(Kind kind)
{
    switch (kind)
    {
        case Kind::kHello:
            return "Hello";
        case Kind::kWelcome:
            return "Welcome";
        case Kind::kMesh:
            return "Mesh";
        case Kind::kMeshAccepted:
            return "MeshAccepted";
        case Kind::kFluidState:
            return "FluidState";
        case Kind::kSolidState:
            return "SolidState";
        case Kind::kHeartbeat:
            return "Heartbeat";
        case Kind::kError:
            return "Error";
        case Kind::kGoodbye:
            return "Goodbye";
        case Kind::kCheckpoint:
            return "Checkpoint";
        case Kind::kCheckpointSaved:
            return "CheckpointSaved";
        case Kind::kFluidWanted:
            return "FluidWanted";
        case Kind::kStatusRequest:
            return "StatusRequest";
        case Kind::kStatus:
            return "Status";
        case Kind::KIND_NOT_SET:
            break;
    }
    return "message of no known kind";
}

std::string describe(Message const& message)
{
    std::string const name = kind_name(message.kind());
    bool const of_step = message.kind() == Kind::kFluidState || message.kind() == Kind::kSolidState;
    return of_step ? name + " of step " + std::to_string(message.envelope.step()) : name;
}

std::string printable(std::string const& text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();)
    {
        std::size_t const length = utf8_length(text, i);
        if (result.size() + length > max_text_bytes) return result + " ...";
        result += length > 0 ? text.substr(i, length) : "?";
        i += length > 0 ? length : 1;
    }
    return result;
}

std::string number_text(double value)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.12g", value);
    return text;
}

void refuse(std::string const& problem)
{
    throw CouplingError(Fault::protocol, problem);
}

void check_name(std::string const& name, char const* whose)
{
    if (name.empty()) refuse(std::string(whose) + " is empty");
    if (name.size() > max_name_bytes)
        refuse(std::string(whose) + " has " + std::to_string(name.size()) + " bytes (at most " +
               std::to_string(max_name_bytes) + ")");
}

void check_number(double value, double least, char const* whose)
{
    if (!std::isfinite(value) || value < least)
        refuse(std::string(whose) + " is " + number_text(value) + " (it must be finite and at least " +
               number_text(least) + ")");
}

}  // namespace gimdem::coupling::message
